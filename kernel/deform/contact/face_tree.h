/// A hierarchy of boxes over the faces of a mesh, for the search for faces that meet in one shape
/// after another; private to kernel/deform.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/contact/local_shape.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Boxes of faces in single precision, with room for its rounding. The hierarchy is halved along
/// the longest side of one shape; its boxes are fitted to any shape of the mesh.
class FaceTree {
  public:
    /// A node over `count` leaves from `leaf` on. Its children follow it: the first, which has the
    /// greater half of the leaves, and then the other.
    struct Place {
        Index node = 0, leaf = 0, count = 0;

        bool is_leaf() const { return count == 1; }
        Place first() const { return {node + 1, leaf, (count + 1) / 2}; }
        Place second() const {
            const Index half = (count + 1) / 2;
            return {node + 2 * half, leaf + half, count - half};
        }
    };
    /// A search among the faces of two nodes, or within one.
    struct Task {
        Place a, b;
    };

    /// A hierarchy for `shape`, whose boxes are not fitted yet. Errors: cancelled.
    FaceTree(const Topology& topology, std::span<const Vec3> shape, const Context& context);

    /// Fits the boxes to a shape. Errors: cancelled.
    void fit(const LocalShape& shape, const Context& context);
    /// Leaves out pairs of faces of one part; kNoIndex is none.
    void set_parts(std::span<const Index> part_of_face);
    /// Leaves out pairs of faces with a common vertex, one of whose leaves has only vertices with a
    /// flag.
    void set_plain(std::span<const char> flag_of_vertex, const Context& context);

    /// Returns searches that find all pairs together, for threads to share.
    std::vector<Task> tasks() const;
    /// Calls visit(i, j) for pairs of slots whose boxes overlap.
    template <typename Visit>
    void visit(const Task& task, const Visit& visit) const {
        if (task.a.node == task.b.node) {
            visit_within(task.a, visit);
        } else {
            visit_between(task.a, task.b, visit);  // they may meet
        }
    }

    Index face(Index slot) const { return face_[at(slot)]; }
    std::span<const Index> corners(Index slot) const {
        return {corner_.data() + corner_begin_[at(slot)],
                corner_.data() + corner_begin_[at(slot) + 1]};
    }
    std::size_t memory_bytes() const;

  private:
    static constexpr Index kLeafSize = 4;
    // The bits 4 i + j with i < j.
    static constexpr std::uint32_t kUpperPairs = 0x08CEU;
    struct Bounds {
        LocalPoint min, max;
    };
    // Boxes of four faces, one coordinate after another.
    struct LeafBoxes {
        std::array<Eigen::Array4f, 3> min, max;
    };
    // Another leaf, and a bit 4 i + j if face i has a common vertex with its face j.
    struct Neighbor {
        Index leaf;
        std::uint32_t pairs;
    };

    void order(Index begin, Index end, std::span<const Vec3> centers);
    void take_corners(const Topology& topology);
    void take_neighbors(const Topology& topology);
    void add_neighbors(const Topology& topology, Index leaf, std::span<const Index> slot_of_face,
                       std::vector<Neighbor>& found) const;
    void fit_leaf(const Place& place, const LocalShape& shape, float margin);
    void fit_below(const Place& place, const LocalShape& shape, float margin);
    Index set_part_below(const Place& place, std::span<const Index> part_of_face);
    Index slots_of(Index leaf) const;
    void unite(const Place& place);
    std::vector<std::vector<Place>> upper_levels() const;
    Place root() const { return {0, 0, count_of(leaf_boxes_)}; }

    bool share_part(const Place& a, const Place& b) const {
        return part_[at(a.node)] != kNoIndex && part_[at(a.node)] == part_[at(b.node)];
    }
    bool overlap(const Place& a, const Place& b) const {
        const Bounds &p = bounds_[at(a.node)], &q = bounds_[at(b.node)];
        return negative_lanes((p.min - q.max).max(q.min - p.max)) == 0xFU;
    }
    bool may_meet(const Place& a, const Place& b) const {
        return !share_part(a, b) && overlap(a, b);
    }

    template <typename Visit>
    void visit_within(const Place& place, const Visit& visit) const {
        if (share_part(place, place)) return;
        if (place.is_leaf()) {
            visit_leaves(place.leaf, place.leaf, visit);
            return;
        }
        visit_within(place.first(), visit);
        visit_within(place.second(), visit);
        if (may_meet(place.first(), place.second())) {
            visit_between(place.first(), place.second(), visit);
        }
    }

    // Nodes that may meet.
    template <typename Visit>
    void visit_between(const Place& a, const Place& b, const Visit& visit) const {
        if (a.is_leaf() && b.is_leaf()) {
            visit_leaves(a.leaf, b.leaf, visit);
            return;
        }
        const bool splits_a = !a.is_leaf(), splits_b = !b.is_leaf();
        const std::array<Place, 2> of_a = {splits_a ? a.first() : a, splits_a ? a.second() : a};
        const std::array<Place, 2> of_b = {splits_b ? b.first() : b, splits_b ? b.second() : b};
        for (std::size_t i = 0; i < (splits_a ? 2U : 1U); ++i) {
            for (std::size_t j = 0; j < (splits_b ? 2U : 1U); ++j) {
                if (may_meet(of_a[i], of_b[j])) visit_between(of_a[i], of_b[j], visit);
            }
        }
    }

    // The bits of pairs of faces of two leaves with a common vertex that are left out.
    std::uint32_t left_out(Index a, Index b) const {
        if (!is_plain_[at(a)] && !is_plain_[at(b)]) return 0;
        for (Index n = neighbor_begin_[at(a)]; n < neighbor_begin_[at(a) + 1]; ++n) {
            if (neighbor_[at(n)].leaf == b) return neighbor_[at(n)].pairs;
        }
        return 0;
    }

    template <typename Visit>
    void visit_leaves(Index a, Index b, const Visit& visit) const {
        std::uint32_t meeting = pairs_that_meet(leaf_boxes_[at(a)], leaf_boxes_[at(b)]);
        if (a == b) meeting &= kUpperPairs;
        if (meeting != 0) meeting &= ~left_out(a, b);
        for (; meeting != 0; meeting &= meeting - 1) {
            const Index pair = std::countr_zero(meeting);
            visit(kLeafSize * a + pair / kLeafSize, kLeafSize * b + pair % kLeafSize);
        }
    }

    // Bit 4 i + j if the box of face i of p overlaps that of face j of q.
    static std::uint32_t pairs_that_meet(const LeafBoxes& p, const LeafBoxes& q) {
        std::uint32_t bits = 0;
        for (Index i = 0; i < kLeafSize; ++i) bits |= lanes_that_meet(p, i, q) << (kLeafSize * i);
        return bits;
    }

    // The faces of q, as bits, whose boxes overlap that of face i of p.
    static std::uint32_t lanes_that_meet(const LeafBoxes& p, Index i, const LeafBoxes& q) {
        Eigen::Array4f gap = q.min[0] - p.max[0][i];
        gap = gap.max(p.min[0][i] - q.max[0]);
        gap = gap.max(p.min[1][i] - q.max[1]).max(q.min[1] - p.max[1][i]);
        gap = gap.max(p.min[2][i] - q.max[2]).max(q.min[2] - p.max[2][i]);
        return negative_lanes(gap);
    }

    static std::uint32_t negative_lanes(const Eigen::Array4f& numbers) {
#if defined(__GNUC__) && defined(__SSE2__)
        using Four = float __attribute__((vector_size(16)));
        const Four four = {numbers[0], numbers[1], numbers[2], numbers[3]};
        return static_cast<std::uint32_t>(__builtin_ia32_movmskps(four));
#else
        std::uint32_t bits = 0;
        for (Index j = 0; j < 4; ++j) bits |= numbers[j] < 0.0F ? 1U << j : 0U;
        return bits;
#endif
    }

    // By slot: four to a leaf, the last leaf may have fewer.
    std::vector<Index> face_, corner_begin_, corner_;
    // By leaf. A pair of leaves stands at the first of them.
    std::vector<LeafBoxes> leaf_boxes_;
    std::vector<Index> neighbor_begin_;
    std::vector<Neighbor> neighbor_;
    std::vector<char> is_plain_;
    // By node.
    std::vector<Bounds> bounds_;
    std::vector<Index> part_;
};

}  // namespace lissom
