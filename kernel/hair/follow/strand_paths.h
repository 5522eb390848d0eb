/// Paths of strands in the space that moves with a head; private to kernel/hair.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/follow/motion_field.h"
#include "kernel/hair/follow/path_loops.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

class SkinBinding;

/// Strands in groups that lie beside each other: the motions of a group are found once, at knots
/// along its first strand, and each of its points moves by those next to it.
class StrandPaths {
  public:
    /// `roots`: the triangle of each strand's root, kNoIndex for none. `ramp`: length from the root
    /// over which the skin's rotation passes over to the motion of the space. Errors: memory_limit.
    StrandPaths(const Strands& strands, std::span<const Triangle> roots, double ramp,
                const HeadMotion& head, const Context& context);

    /// Points at which motions are asked for, x y z each.
    std::span<const float> knots() const {
        return {knots_.empty() ? nullptr : knots_.front().data(), 3 * knots_.size()};
    }
    Index group_count() const { return count_of(groups_); }
    /// Strands have places, beside each other for those of a group: those of a group, from the
    /// first to before the last, and the strand at one.
    std::pair<std::size_t, std::size_t> group(Index g) const {
        const Group& group = groups_[at(g)];
        return {group.first, group.first + group.count};
    }
    Index strand(std::size_t place) const { return order_[place]; }
    /// Returns the place of its coordinates among those of all strands.
    std::size_t made(std::size_t place) const { return made_[place]; }
    /// Lengths from the root to each point at rest; its last is 0 if the strand has no length or is
    /// not finite.
    std::span<const float> arcs(std::size_t place) const {
        return std::span(arcs_).subspan(first_[place], first_[place + 1] - first_[place]);
    }

    /// Blocks of strands that move side by side: the places of one, and the number of its rows.
    std::size_t block_count() const { return blocks_.size(); }
    std::pair<std::size_t, std::size_t> block(std::size_t b) const {
        return {blocks_[b].place, blocks_[b].place + at(blocks_[b].count)};
    }
    int row_count(std::size_t block) const { return blocks_[block].rows; }

    /// Room for one thread.
    struct Room {
        std::vector<MotionField::Node, Eigen::aligned_allocator<MotionField::Node>> knots;
        std::vector<PathRow> steps;
    };
    /// Writes the points of a group's strands: with the length at rest times the factor of `head`,
    /// and those that are bound over the skin. Strands without length, or that are not finite, keep
    /// their shape, and their root follows.
    void move(Index group, const HeadMotion& head, const MotionField& field,
              const SkinBinding& binding, std::span<float> points, Room& room) const;

    std::size_t memory_bytes() const;

  private:
    struct Group {
        std::size_t first = 0, count = 0, first_knot = 0, knots = 0;
        /// Knots in one metre along the strand.
        float per_metre = 0.0f;
        /// Its blocks of kPathLanes strands, and their rows; none if it is not whole.
        std::size_t first_block = 0, first_row = 0;
        /// Whether its first strand has a length, and a finite root.
        bool is_whole = false, has_root = false;
    };

    /// Place of a root on the head: vertices, kNoIndex for none, and weights; and the offset from
    /// it at rest.
    struct RootPlace {
        Triangle vertices{kNoIndex, kNoIndex, kNoIndex};
        Eigen::Vector3f weights = Eigen::Vector3f::Zero(), offset = weights;
    };

    void sort(const Strands& strands);
    void copy(const Strands& strands, const Context& context);
    void root(const Strands& strands, std::span<const Triangle> roots, const HeadMotion& head);
    void divide();
    void reserve_rows();
    void add_group(std::size_t first);
    bool joins(std::size_t place, const Group& group) const;
    bool is_whole(std::size_t place) const { return arcs(place).back() > 0.0f; }
    StrandView rest(std::size_t place) const {
        return {points_.data() + 3 * first_[place], 3, index_of(first_[place + 1] - first_[place])};
    }
    Eigen::Vector3f at_arc(std::size_t place, float arc) const;
    Eigen::Matrix3f turn_of(std::size_t place, const HeadMotion& head) const;
    Eigen::Vector3f moved_root(std::size_t place, const Eigen::Matrix3f& turn,
                               const HeadMotion& head, const MotionField& field,
                               const Room& room) const;
    void add_block(std::size_t first, std::size_t count, const Group& group);
    void move_whole(const Group& group, const Eigen::Matrix3f& turn, const HeadMotion& head,
                    const MotionField& field, const SkinBinding& binding, std::span<float> points,
                    Room& room) const;
    void move_broken(std::size_t place, const Eigen::Matrix3f& turn, const HeadMotion& head,
                     const MotionField& field, std::span<float> points, const Room& room) const;

    float ramp_;
    /// The strand at each place, and where its points begin: here, and in all strands.
    std::vector<Index> order_;
    std::vector<std::size_t> first_, made_;
    std::vector<float> points_, arcs_;
    std::vector<RootPlace> roots_;
    std::vector<Group> groups_;
    std::vector<Eigen::Vector3f> knots_;
    std::vector<PathStrands> blocks_;
    std::vector<PathRow> rows_;
    std::vector<PathRange> ranges_;
    MemoryCharge charge_;
};

}  // namespace lissom
