/// Strands grow in lanes, one beside the other, so that most of the work is vector instructions
/// over lanes; loops over lanes are written for compilers to vectorise. A lane goes from point to
/// point of its strand: at each turn of the loop it reads the field at its next point and is either
/// pushed out of the head, and reads again, or goes there. Rare events (a push, a tie, the end of a
/// strand) are handled for single lanes. Files that include this are compiled without contraction
/// to fused instructions: then every processor gives the same strands. Private to kernel/hair;
/// growth_lanes.h says for which processor this is compiled.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/lane_field.h"
#include "kernel/hair/growth/lane_lists.h"
#include "kernel/hair/growth/lane_strands.h"
#include "kernel/hair/growth/lane_ties.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// A strand is pushed out of the head this often a segment, as distances between grid points are
// interpolated.
inline constexpr std::int32_t kPushes = 3;

// A strand so little below its floor, in steps, is not pushed: it would have to look again.
inline constexpr float kMinPush = 0.02f;

// The first point after a root, or the code of the reason for an earlier end, else 0.
struct FirstSegment {
    Eigen::Vector3f to;
    std::int32_t end;
};

class LaneGrower {
  public:
    LaneGrower(const QuadGrid& grid, const GrowthRules& rules, std::span<const StrandSeed> seeds,
               StrandBatch& batch)
        : lists_(rules, batch), field_(grid), rules_(rules), seeds_(seeds) {
        batch.strands.assign(seeds.size(), {});
        first_.resize(seeds.size());
    }

    void run() {
        LaneStrands strands{};
        for (std::size_t i = 0; i < seeds_.size(); i += kLanes) find_first_segments(i);
        for (int k = 0; k < kLanes; ++k) begin_strand(k, strands);
        while (growing_count_ > 0) {
            const LanePlaces places = field_.locate(strands.to);
            const Reading here = field_.read(places);
            const Ints low = push_out(places, here, strands);
            Segments next = next_segments(strands, strands.growing & no(low));
            meet_ties(rules_, here, strands, next);
            end_at_length(strands, next);
            for (const CutRule& cut : rules_.cuts) meet_cut(rules_, cut, strands, next);
            const Floats speed = root(dot(here.vector, here.vector));
            const Steps steps = steps_of(rules_, strands, next, places.inside, speed);
            strands.segments = lists_.put_points(next.to, strands.segments, steps.take);
            advance(rules_, field_, places, here, speed, next, steps.take, strands);
            if (any(steps.end)) end_lanes(steps.end, strands);
        }
    }

  private:
    // Pushes the next points that are too low outward; returns their strands.
    LISSOM_INLINE Ints push_out(const LanePlaces& places, const Reading& here,
                                LaneStrands& strands) const {
        const Floats missing = missing_height(rules_, strands, here.distance, strands.grown);
        const Ints low = strands.growing & places.inside & (missing > all(kMinPush)) &
                         (strands.pushes < all(kPushes));
        if (any(low)) strands.to = pushed(strands.to, low, missing, field_.gradients(places));
        strands.pushes = strands.pushes - low;
        return low;
    }

    // Chooses the first points after the roots of the seeds from `first` on, one a lane.
    LISSOM_INLINE void find_first_segments(std::size_t first) {
        const std::size_t count = std::min<std::size_t>(kLanes, seeds_.size() - first);
        Floats3 to{}, normal{};
        Floats length{};
        for (std::size_t k = 0; k < count; ++k) {
            const StrandSeed& seed = seeds_[first + k];
            set(to, index_of(k), seed.at);
            set(normal, index_of(k), seed.normal);
            length[index_of(k)] = seed.length;
        }
        const LanePlaces places = field_.locate(to);
        const Floats3 v = field_.read(places).vector;
        const Floats inward = all(rules_.outward) * least(all(0.0f), dot(v, normal));
        const Floats3 lifted = sum(v, scaled(normal, all(rules_.lift) - inward));
        const Floats speed = root(dot(lifted, lifted));
        const Floats scale = least(full_step(rules_, speed), length / speed);
        to = sum(to, scaled(lifted, scale));
        const Ints end = ends_of_roots(root(dot(v, v)), speed, places.inside, length);
        for (std::size_t k = 0; k < count; ++k) {
            const int lane = index_of(k);
            first_[first + k] = {get(to, lane), end[lane]};
        }
    }

    // Returns the code of each strand's end at its root, or 0; the last condition that holds
    // counts.
    LISSOM_INLINE Ints ends_of_roots(const Floats& speed, const Floats& lifted_speed,
                                     const Ints& inside, const Floats& length) const {
        Ints end = all(0);
        mark(end, no(lifted_speed > all(0.0f)), StrandEnd::slow);
        mark(end, no(speed > all(rules_.min_speed)), StrandEnd::slow);
        mark(end, no(inside), StrandEnd::left_grid);
        mark(end, no(length > all(rules_.min_move)), StrandEnd::length);
        return end;
    }

    void end_lanes(const Ints& end, LaneStrands& strands) {
        for (unsigned lanes = bits_of(end); lanes != 0; lanes &= lanes - 1) {
            const int k = std::countr_zero(lanes);
            close(k, end[k], strands);
            --growing_count_;
            begin_strand(k, strands);
        }
    }

    void close(int k, std::int32_t end, const LaneStrands& strands) {
        lists_.close(k, seed_of_[k], strands.segments[k], strands.tie[k],
                     static_cast<StrandEnd>(end - 1));
    }

    // Gives lane k the next seed that can grow; others are strands of their roots alone.
    void begin_strand(int k, LaneStrands& strands) {
        strands.growing[k] = 0;
        while (next_ < seeds_.size()) {
            seed_of_[k] = next_;
            start(k, seeds_[next_], strands);
            const FirstSegment& first = first_[next_++];
            if (first.end == 0) {
                set(strands.to, k, first.to);
                strands.growing[k] = -1;
                ++growing_count_;
                return;
            }
            close(k, first.end, strands);
        }
        // The lane runs on, and its points are overwritten.
        strands.segments[k] = 0;
        set(strands.at, k, Eigen::Vector3f::Zero());
        set(strands.to, k, Eigen::Vector3f::Zero());
    }

    void start(int k, const StrandSeed& seed, LaneStrands& strands) {
        set(strands.at, k, seed.at);
        strands.grown[k] = 0.0f;
        strands.length[k] = seed.length;
        strands.floor[k] = seed.floor;
        strands.cut[k] = seed.cut;
        strands.tail[k] = seed.tail;
        strands.segments[k] = strands.pushes[k] = 0;
        strands.tie[k] = kNoIndex;
        lists_.put_root(k, seed.at);
    }

    LaneLists lists_;
    LaneField field_;
    const GrowthRules& rules_;
    std::span<const StrandSeed> seeds_;
    std::vector<FirstSegment> first_;
    // The seed of each lane's strand, and the first that no lane has.
    std::array<std::size_t, kLanes> seed_of_{};
    std::size_t next_ = 0;
    int growing_count_ = 0;
};

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
