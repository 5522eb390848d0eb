#include "kernel/deform/contact/face_tree.h"

#include <algorithm>
#include <numeric>

namespace lissom {
namespace {

// Boxes grow by this share of the extent, more than points are rounded by and than
// self_intersections takes for touching.
constexpr float kBoxMargin = 2.5e-7F;
constexpr float kLeastMargin = 1e-30F;
// Missing faces lie beyond all others.
constexpr float kNowhere = 1e30F;
constexpr Index kLeafGrain = 4096;
constexpr std::size_t kMostPieces = 64, kMostTasks = 256;

Vec3 center_of_face(std::span<const Index> corners, std::span<const Vec3> shape) {
    Box box;
    for (const Index v : corners) box.extend(shape[at(v)]);
    return box.center();
}

}  // namespace

FaceTree::FaceTree(const Topology& topology, std::span<const Vec3> shape, const Context& context)
    : face_(at(topology.face_count())) {
    std::iota(face_.begin(), face_.end(), 0);
    std::vector<Vec3> centers;
    centers.reserve(face_.size());
    for (Index f = 0; f < topology.face_count(); ++f) {
        centers.push_back(center_of_face(topology.face(f), shape));
    }
    context.checkpoint();
    order(0, count_of(face_), centers);
    context.checkpoint();
    take_corners(topology);
    take_neighbors(topology);
    context.checkpoint();
    const std::size_t leaves = (face_.size() + kLeafSize - 1) / kLeafSize;
    leaf_boxes_.resize(leaves);
    is_plain_.assign(leaves, 0);
    bounds_.resize(leaves > 0 ? 2 * leaves - 1 : 0);
    part_.assign(bounds_.size(), kNoIndex);
}

// The greater half goes first, in whole leaves.
void FaceTree::order(Index begin, Index end, std::span<const Vec3> centers) {
    const Index leaves = (end - begin + kLeafSize - 1) / kLeafSize;
    if (leaves < 2) return;
    Box box;
    for (Index i = begin; i < end; ++i) box.extend(centers[at(face_[at(i)])]);
    int axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    const Index middle = begin + kLeafSize * ((leaves + 1) / 2);
    std::nth_element(face_.begin() + begin, face_.begin() + middle, face_.begin() + end,
                     [&](Index f, Index g) {
                         const double x = centers[at(f)][axis], y = centers[at(g)][axis];
                         return x != y ? x < y : f < g;
                     });
    order(begin, middle, centers);
    order(middle, end, centers);
}

void FaceTree::take_corners(const Topology& topology) {
    corner_begin_.reserve(face_.size() + 1);
    corner_.reserve(at(topology.corner_count()));
    corner_begin_.push_back(0);
    for (const Index f : face_) {
        const auto corners = topology.face(f);
        corner_.insert(corner_.end(), corners.begin(), corners.end());
        corner_begin_.push_back(count_of(corner_));
    }
}

// Of each pair of leaves, visits come with the lower one first.
void FaceTree::add_neighbors(const Topology& topology, Index leaf,
                             std::span<const Index> slot_of_face,
                             std::vector<Neighbor>& found) const {
    found.clear();
    for (Index i = 0; i < slots_of(leaf); ++i) {
        for (const Index v : corners(kLeafSize * leaf + i)) {
            for (const Index f : topology.faces_around(v)) {
                const Index slot = slot_of_face[at(f)], other = slot / kLeafSize;
                if (other < leaf) continue;
                const std::uint32_t bit = 1U << (kLeafSize * i + slot % kLeafSize);
                const auto known = std::find_if(found.begin(), found.end(),
                                                [&](const Neighbor& n) { return n.leaf == other; });
                if (known == found.end()) {
                    found.push_back({other, bit});
                } else {
                    known->pairs |= bit;
                }
            }
        }
    }
}

void FaceTree::take_neighbors(const Topology& topology) {
    std::vector<Index> slot_of_face(face_.size());
    for (std::size_t slot = 0; slot < face_.size(); ++slot) {
        slot_of_face[at(face_[slot])] = index_of(slot);
    }
    std::vector<Neighbor> found;
    neighbor_begin_.assign(1, 0);
    for (Index leaf = 0; kLeafSize * leaf < count_of(face_); ++leaf) {
        add_neighbors(topology, leaf, slot_of_face, found);
        neighbor_.insert(neighbor_.end(), found.begin(), found.end());
        neighbor_begin_.push_back(count_of(neighbor_));
    }
}

void FaceTree::set_plain(std::span<const char> flag_of_vertex, const Context& context) {
    context.parallel_for(0, count_of(leaf_boxes_), kLeafGrain, [&](Index begin, Index end) {
        for (Index leaf = begin; leaf < end; ++leaf) {
            const Index first = corner_begin_[at(kLeafSize * leaf)];
            const Index last = corner_begin_[at(kLeafSize * leaf + slots_of(leaf))];
            char plain = 1;
            for (Index c = first; c < last; ++c) plain &= flag_of_vertex[at(corner_[at(c)])];
            is_plain_[at(leaf)] = plain;
        }
    });
}

Index FaceTree::slots_of(Index leaf) const {
    return std::min(kLeafSize, count_of(face_) - kLeafSize * leaf);
}

void FaceTree::fit_leaf(const Place& place, const LocalShape& shape, float margin) {
    LeafBoxes& boxes = leaf_boxes_[at(place.leaf)];
    Bounds all{LocalPoint::Constant(kNowhere), LocalPoint::Constant(-kNowhere)};
    for (Index i = 0; i < kLeafSize; ++i) {
        Bounds own{LocalPoint::Constant(kNowhere), LocalPoint::Constant(-kNowhere)};
        if (i < slots_of(place.leaf)) {
            for (const Index v : corners(kLeafSize * place.leaf + i)) {
                own.min = own.min.min(shape.points[at(v)]);
                own.max = own.max.max(shape.points[at(v)]);
            }
            own.min -= margin;
            own.max += margin;
        }
        all.min = all.min.min(own.min);
        all.max = all.max.max(own.max);
        for (int k = 0; k < 3; ++k) {
            boxes.min[at(k)][i] = own.min[k];
            boxes.max[at(k)][i] = own.max[k];
        }
    }
    bounds_[at(place.node)] = all;
}

void FaceTree::fit_below(const Place& place, const LocalShape& shape, float margin) {
    if (place.is_leaf()) {
        fit_leaf(place, shape, margin);
        return;
    }
    fit_below(place.first(), shape, margin);
    fit_below(place.second(), shape, margin);
    unite(place);
}

void FaceTree::unite(const Place& place) {
    const Bounds &a = bounds_[at(place.first().node)], &b = bounds_[at(place.second().node)];
    bounds_[at(place.node)] = {a.min.min(b.min), a.max.max(b.max)};
}

// The levels down to one whose nodes are enough to share, or have one leaf each.
std::vector<std::vector<FaceTree::Place>> FaceTree::upper_levels() const {
    std::vector<std::vector<Place>> levels = {{root()}};
    const auto is_leaf = [](const Place& place) { return place.is_leaf(); };
    while (levels.back().size() < kMostPieces &&
           std::none_of(levels.back().begin(), levels.back().end(), is_leaf)) {
        std::vector<Place> next;
        for (const Place& place : levels.back()) {
            next.push_back(place.first());
            next.push_back(place.second());
        }
        levels.push_back(std::move(next));
    }
    return levels;
}

void FaceTree::fit(const LocalShape& shape, const Context& context) {
    if (face_.empty()) return;
    const float margin = std::max(kBoxMargin * shape.extent, kLeastMargin);
    std::vector<std::vector<Place>> levels = upper_levels();
    const std::vector<Place>& lowest = levels.back();
    context.parallel_for(0, count_of(lowest), 1, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) fit_below(lowest[at(i)], shape, margin);
    });
    while (levels.size() > 1) {
        levels.pop_back();
        for (const Place& place : levels.back()) unite(place);
    }
}

Index FaceTree::set_part_below(const Place& place, std::span<const Index> part_of_face) {
    Index common = kNoIndex;
    if (place.is_leaf()) {
        common = part_of_face[at(face(kLeafSize * place.leaf))];
        for (Index i = 1; i < slots_of(place.leaf); ++i) {
            if (part_of_face[at(face(kLeafSize * place.leaf + i))] != common) common = kNoIndex;
        }
    } else {
        const Index a = set_part_below(place.first(), part_of_face);
        const Index b = set_part_below(place.second(), part_of_face);
        common = a == b ? a : kNoIndex;
    }
    part_[at(place.node)] = common;
    return common;
}

void FaceTree::set_parts(std::span<const Index> part_of_face) {
    if (!face_.empty()) set_part_below(root(), part_of_face);
}

std::vector<FaceTree::Task> FaceTree::tasks() const {
    if (face_.empty()) return {};
    std::vector<Task> level = {{root(), root()}};
    const auto add = [&](std::vector<Task>& list, const Place& a, const Place& b) {
        if (may_meet(a, b)) list.push_back({a, b});
    };
    while (level.size() < kMostTasks) {
        std::vector<Task> next;
        bool has_split = false;
        for (const Task& task : level) {
            if (task.a.is_leaf() || task.b.is_leaf()) {
                next.push_back(task);
                continue;
            }
            has_split = true;
            add(next, task.a.first(), task.b.first());
            add(next, task.a.first(), task.b.second());
            add(next, task.a.second(), task.b.second());
            if (task.a.node != task.b.node) add(next, task.a.second(), task.b.first());
        }
        level = std::move(next);
        if (!has_split) break;
    }
    return level;
}

std::size_t FaceTree::memory_bytes() const {
    return (face_.size() + corner_begin_.size() + corner_.size() + part_.size()) * sizeof(Index) +
           neighbor_.size() * sizeof(Neighbor) + leaf_boxes_.size() * sizeof(LeafBoxes) +
           bounds_.size() * sizeof(Bounds);
}

}  // namespace lissom
