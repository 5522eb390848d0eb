#include "kernel/deform/system/ordered_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernel/deform/patch/row_accumulator.h"
#include "kernel/deform/system/firm_factor.h"

namespace lissom {
namespace {

// Smaller systems are prepared in a tenth of a second; vertices with more neighbours fill the rows
// of a region, of which a handle there would hold most.
constexpr std::size_t kMinOrdered = 10'000;
constexpr Index kMaxNeighbors = 32;
// Beyond, the memory that is kept for the next system would be more than a gigabyte.
constexpr std::size_t kMaxOrdered = 400'000;
// Vertices for each flat one. Moves along a flat part and off it are not coupled, which a pattern
// that holds for all handles does not know.
constexpr std::size_t kMinCurved = 20;

// Breadth-first walks over the rings.
class Walk {
  public:
    explicit Walk(const Rings& rings) : rings_(rings), seen_by_(at(rings.size()), kNoIndex) {}

    // The vertices within `reach` rings of `start`, the nearest first.
    const std::vector<Index>& around(Index start, Index reach) {
        found_.assign(1, start);
        seen_by_[at(start)] = start;
        std::size_t first = 0;
        for (Index ring = 0; ring < reach; ++ring) {
            const std::size_t last = found_.size();
            for (; first < last; ++first) {
                for (const Index n : rings_.ring(found_[first])) {
                    if (std::exchange(seen_by_[at(n)], start) != start) found_.push_back(n);
                }
            }
        }
        return found_;
    }

  private:
    const Rings& rings_;
    // The start of the last walk that has come to each vertex.
    std::vector<Index> seen_by_;
    std::vector<Index> found_;
};

}  // namespace

RegionOrder RegionOrder::of(const WorkingPatch& work, const Rings& rings, Index end, Index reach) {
    RegionOrder order;
    const bool has_own_patch = work.patch.vertex_count > work.patch.surface_count ||
                               work.patch.real_count > work.patch.mesh_count();
    const std::size_t flat = work.patch.normal_points.size();
    if (has_own_patch || kMinCurved * flat > at(work.patch.real_count)) return order;
    for (Index i = 0; i < end; ++i) {
        if (rings.count(i) > kMaxNeighbors) return {};
        if (work.patch.in_region[at(i)] && rings.count(i) > 0) order.vertices.push_back(i);
    }
    if (order.vertices.size() < kMinOrdered || order.vertices.size() > kMaxOrdered) return {};
    order.rings = rings;
    order.reach = reach;
    return order;
}

bool RegionOrder::is_same(const RegionOrder& other) const {
    return reach == other.reach && vertices == other.vertices && rings.begin == other.rings.begin &&
           rings.neighbor == other.rings.neighbor;
}

SymmetricMatrix RegionOrder::pattern(const Context& context) const {
    std::vector<Index> row_of(at(rings.size()), kNoIndex);
    for (std::size_t r = 0; r < vertices.size(); ++r) row_of[at(vertices[r])] = index_of(r);
    const auto count = count_of(vertices);
    const Index grain = assembly_grain(count);
    // The entries of each row before its diagonal, in no order, and it.
    struct Part {
        std::vector<Index> begin{0}, before;
    };
    std::vector<Part> parts(at((count + grain - 1) / grain));
    SymmetricMatrix pattern;
    pattern.begin.assign(at(count) + 1, 0);
    context.parallel_for(0, count, grain, [&](Index begin, Index end) {
        Part& part = parts[at(begin / grain)];
        Walk walk(rings);
        for (Index r = begin; r < end; ++r) {
            context.checkpoint();
            for (const Index v : walk.around(vertices[at(r)], reach)) {
                const Index other = row_of[at(v)];
                if (other >= r) ++pattern.begin[at(r) + 1];
                if (other != kNoIndex && other <= r) part.before.push_back(other);
            }
            part.begin.push_back(count_of(part.before));
        }
    });
    std::partial_sum(pattern.begin.begin(), pattern.begin.end(), pattern.begin.begin());
    // Rows come in their order into every column.
    std::vector<Index> next(pattern.begin.begin(), pattern.begin.end() - 1);
    pattern.row.resize(at(pattern.begin.back()));
    for (Index r = 0; r < count; ++r) {
        const Part& part = parts[at(r / grain)];
        const Index n = r % grain;
        for (Index e = part.begin[at(n)]; e < part.begin[at(n) + 1]; ++e) {
            pattern.row[at(next[at(part.before[at(e)])]++)] = r;
        }
    }
    pattern.value.assign(pattern.row.size(), 1.0);
    return pattern;
}

std::size_t RegionOrder::bytes() const {
    return (rings.begin.size() + rings.neighbor.size() + vertices.size()) * sizeof(Index);
}

FactorStats OrderedSystem::stats() const {
    FactorStats stats = system_.stats();
    if (!is_analysed_) stats.analyze_seconds = 0.0;
    return stats;
}

bool OrderedSystem::factor(SymmetricMatrix& matrix, const std::vector<Index>& free,
                           RegionOrder order, const Context& context) {
    if (!order.serves(free.size())) {
        system_ = {};
        order_ = {};
        charge_ = {};
        system_.analyze(matrix, context);
        is_analysed_ = true;
        return factor_firmly(matrix, [&] { system_.factor(matrix, context); });
    }
    is_analysed_ = !order_.is_same(order);
    if (is_analysed_) {
        system_ = {};
        charge_ = {};
        charge_ = context.charge(order.bytes(), "the order of a linear system");
        order_ = std::move(order);
        system_.analyze(order_.pattern(context), context);
    }
    std::vector<Index> part;
    part.reserve(free.size());
    auto place = order_.vertices.begin();
    for (const Index v : free) {
        place = std::lower_bound(place, order_.vertices.end(), v);
        part.push_back(index_of(place - order_.vertices.begin()));
    }
    return factor_firmly(matrix, [&] { system_.factor_part(matrix, part, context); });
}

}  // namespace lissom
