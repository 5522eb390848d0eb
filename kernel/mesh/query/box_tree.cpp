#include "kernel/mesh/query/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

constexpr Index kLeafSize = 4;
constexpr int kBins = 16;
// Below this depth nodes are halved, so that no path is longer than kStackSize.
constexpr int kMaximumFreeDepth = 48;

// The boxes of items, by the places of their centers along one axis.
class Bins {
  public:
    void add(int bin, const Box& box) {
        box_[bin] = united(box_[bin], box);
        ++count_[bin];
    }

    // Returns the first bin of the second part, or 0 if no cut divides the items.
    int cheapest_cut(Index total) const {
        std::array<double, kBins> cost{};
        Box left, right;
        for (int b = 1, n = 0; b < kBins; ++b) {
            left = united(left, box_[b - 1]);
            n += count_[b - 1];
            cost[b] = half_surface(left) * n;
        }
        int best = 0;
        for (int b = kBins - 1, n = 0; b > 0; --b) {
            right = united(right, box_[b]);
            n += count_[b];
            cost[b] += half_surface(right) * n;
            const bool divides = n > 0 && n < total;
            if (divides && (best == 0 || cost[b] < cost[best])) best = b;
        }
        return best;
    }

  private:
    std::array<Box, kBins> box_;
    std::array<Index, kBins> count_{};
};

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes, const Context& context) {
    if (boxes.empty()) return;
    build(boxes, context);
    double sum = 0.0;
    for (const Node& node : nodes_) sum += cost_of(node);
    set_cost(sum);
    built_cost_ = cost_;
}

void BoxTree::build(std::span<const Box> boxes, const Context& context) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);

    std::vector<std::pair<Index, int>> open{{0, 0}};
    nodes_.push_back({{}, 0, count_of(order_)});
    for (std::size_t steps = 0; !open.empty(); ++steps) {
        if (steps % 4096 == 0) context.checkpoint();
        const auto [here, depth] = open.back();
        open.pop_back();
        Node node = nodes_[at(here)];
        for (const Index item : items(node)) node.box = united(node.box, boxes[at(item)]);
        nodes_[at(here)].box = node.box;
        if (node.count <= kLeafSize) continue;
        const Index middle = split(node, boxes, depth >= kMaximumFreeDepth);
        const Index children = count_of(nodes_);
        nodes_.push_back({{}, node.first, middle - node.first});
        nodes_.push_back({{}, middle, node.first + node.count - middle});
        nodes_[at(here)].first = children;
        nodes_[at(here)].count = 0;
        open.emplace_back(children, depth + 1);
        open.emplace_back(children + 1, depth + 1);
    }
}

// Divides the items of a node by the surface area heuristic over bins of box centers, or in two
// halves if that finds nothing or `halve` is set. Returns the start of the second part.
Index BoxTree::split(const Node& node, std::span<const Box> boxes, bool halve) {
    const auto begin = order_.begin() + node.first, end = begin + node.count;
    Box centers;
    for (auto i = begin; i != end; ++i) centers.extend(boxes[at(*i)].center());
    int axis = 0;
    const double extent = (centers.max - centers.min).maxCoeff(&axis);
    // Distances of coordinates near the greatest number are infinite, and their ratios no number.
    const auto bin_of = [&](Index item) {
        const double where = (boxes[at(item)].center()[axis] - centers.min[axis]) / extent * kBins;
        return where >= kBins ? kBins - 1 : where > 0.0 ? static_cast<int>(where) : 0;
    };
    if (extent > 0.0 && !halve) {
        Bins bins;
        for (auto i = begin; i != end; ++i) bins.add(bin_of(*i), boxes[at(*i)]);
        const int best = bins.cheapest_cut(node.count);
        if (best > 0) {
            const auto middle =
                std::stable_partition(begin, end, [&](Index item) { return bin_of(item) < best; });
            return node.first + index_of(middle - begin);
        }
    }
    const auto middle = begin + node.count / 2;
    std::nth_element(begin, middle, end, [&](Index a, Index b) {
        const double at_a = boxes[at(a)].center()[axis], at_b = boxes[at(b)].center()[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    return node.first + node.count / 2;
}

void BoxTree::set_cost(double sum) {
    const double whole = half_surface(bounds());
    cost_ = whole > 0.0 ? sum / whole : 0.0;
}

std::size_t BoxTree::memory_bytes() const {
    return order_.size() * sizeof(Index) + nodes_.size() * sizeof(Node);
}

}  // namespace lissom
