/// Ties: strands that enter a tail, and their way in it; private to kernel/hair. Included as
/// growth_lanes.h is, and compiled for the same processor.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/lane_field.h"
#include "kernel/hair/growth/lane_strands.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// Hair in a tail comes nearer to its place there by this share a step of the grid, by less at
// first, up to so many steps behind the tie; so many steps over the head it does not go down to it.
inline constexpr float kSettling = 0.3f, kSettlingBegin = 3.0f, kSettlingRoom = 0.5f;

// The share of `ragged` that is missing at the tip of a strand, by its chance: half of it at
// random, half by the square of its distance from the spine, so that a tail ends as a brush does,
// not as a cone.
inline float missing_share(float chance) {
    const float other = 64.0f * chance - std::floor(64.0f * chance);
    return 0.5f * (std::sqrt(other) + chance);
}

// Catches strands that pass the plane of a tie or of a gate behind it, that share of the segment
// on, within its radius.
inline void pass_gate(const TieRule& tie, const TailGate& gate, std::size_t number,
                      const Segments& next, const Ints& passes, const Floats& share,
                      LaneStrands& strands) {
    LaneTails& tails = strands.tails;
    for (int k = 0; k < kLanes; ++k) {
        if (!passes[k]) continue;
        const Eigen::Vector3f off = get(strands.at, k) + share[k] * get(next.way, k) - gate.center;
        if (off.squaredNorm() > gate.square_radius) continue;
        strands.tie[k] = index_of(number);
        tails.plane[k] = gate.plane;
        const float angle = static_cast<float>(kPi) * strands.cut[k];
        const float far = std::sqrt(strands.tail[k]);
        tails.right[k] = far * std::cos(angle);
        tails.above[k] = far * std::sin(angle);
        if (!tie.measures) continue;
        tails.length[k] = tie.tail_length * (1.0f - tie.ragged * missing_share(strands.tail[k]));
        strands.length[k] = strands.grown[k] + share[k] * next.length[k] +
                            std::max(tails.length[k] - gate.behind, 0.0f);
    }
}

LISSOM_INLINE void meet_gate(const TieRule& tie, const TailGate& gate, std::size_t number,
                             const Segments& next, LaneStrands& strands) {
    const Floats3 direction = all(gate.direction), center = all(gate.center);
    const Floats before = dot(direction, difference(strands.at, center)),
                 after = dot(direction, difference(next.to, center));
    const Ints passes =
        (before < all(0.0f)) & no(after < all(0.0f)) & (strands.tie < all(0)) & next.go;
    if (!any(passes)) return;
    pass_gate(tie, gate, number, next, passes, before / (before - after), strands);
}

// The final length of a strand by the planes that it passes: in the bend of a tail the way is
// longer outside.
inline void pass_planes(const TieRule& tie, const Segments& next, int k, LaneStrands& strands) {
    LaneTails& tails = strands.tails;
    for (std::size_t i = tails.plane[k]; i < tie.planes.size(); ++i) {
        const TailPlane& plane = tie.planes[i];
        if (plane.behind >= tails.length[k]) return;
        const float after = plane.direction.dot(get(next.to, k) - plane.center);
        if (after < 0.0f) return;
        const float before = plane.direction.dot(get(strands.at, k) - plane.center);
        const float share = before < 0.0f ? before / (before - after) : 0.0f;
        strands.length[k] =
            strands.grown[k] + share * next.length[k] + (tails.length[k] - plane.behind);
        tails.plane[k] = index_of(i) + 1;
    }
}

// Draws a strand towards its own place in the cross section of a tail, unless that leads into the
// head.
inline void settle(const GrowthRules& rules, const TieRule& tie, const LaneStrands& strands,
                   const Reading& here, int k, Segments& next) {
    const LaneTails& tails = strands.tails;
    if (at(tails.plane[k]) >= tie.planes.size()) return;
    const TailPlane& plane = tie.planes[at(tails.plane[k])];
    if (!(plane.side.squaredNorm() > 0.0f)) return;
    const Eigen::Vector3f to = get(next.to, k), from = to - plane.center;
    const Eigen::Vector3f off = from - from.dot(plane.direction) * plane.direction;
    const Eigen::Vector3f place = tails.right[k] * plane.side + tails.above[k] * plane.up;
    const float share =
        std::min(1.0f, kSettling * next.length[k]) * std::min(1.0f, plane.behind / kSettlingBegin);
    const Eigen::Vector3f by = share * (place - off);
    const float sinks = get(here.slope, k).dot(by);
    const float height = (here.distance[k] + sinks) * rules.inverse_step;
    if (rules.avoid && sinks < 0.0f && height < strands.floor[k] + kSettlingRoom) return;
    set(next.to, k, to + by);
    const Eigen::Vector3f way = get(next.to, k) - get(strands.at, k);
    set(next.way, k, way);
    next.length[k] = way.norm();
}

// Strands that pass a tie are caught; those that are in a tail follow it.
LISSOM_INLINE void meet_ties(const GrowthRules& rules, const Reading& here, LaneStrands& strands,
                             Segments& next) {
    if (rules.ties.empty()) return;
    for (std::size_t i = 0; i < rules.ties.size(); ++i) {
        const TieRule& tie = rules.ties[i];
        meet_gate(tie, tie.tie, i, next, strands);
        for (const TailGate& gate : tie.gates) meet_gate(tie, gate, i, next, strands);
    }
    const Ints tied = next.go & no(strands.tie < all(0));
    if (!any(tied)) return;
    for (int k = 0; k < kLanes; ++k) {
        if (!tied[k]) continue;
        const TieRule& tie = rules.ties[strands.tie[k]];
        pass_planes(tie, next, k, strands);
        settle(rules, tie, strands, here, k, next);
    }
}

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
