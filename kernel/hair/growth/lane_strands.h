/// Strands that grow side by side, one a lane, and their next segments, as plain values; private to
/// kernel/hair. Included as growth_lanes.h is, and compiled for the same processor.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/hair/growth/growth.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/lane_field.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// For strands in a tail: their final length along its spine, the next of its planes, and their
// places across it, in its radius.
struct LaneTails {
    Floats length, right, above;
    Ints plane;
};

struct LaneStrands {
    // Last and next points, and the last segments with their lengths.
    Floats3 at, to, way;
    Floats way_length;
    // Lengths so far and in the end, floors and random numbers.
    Floats grown, length, floor, cut, tail;
    // Whether there is a strand, segments so far, pushes of the next point, and ties.
    Ints growing, segments, pushes, tie;
    LaneTails tails;
};

// The next segments of the strands that are not pushed.
struct Segments {
    Ints go;
    Floats3 to, way;
    Floats length;
    // Whether a cut ends the strand.
    Ints cut;
};

// Which segments are taken, and the code of the reason why a strand ends with its segment or
// before it, else 0.
struct Steps {
    Ints take, end;
};

constexpr std::int32_t code(StrandEnd end) {
    return 1 + static_cast<std::int32_t>(end);
}

// The distance of points at this height over the head below the floors of their strands.
LISSOM_INLINE Floats missing_height(const GrowthRules& rules, const LaneStrands& strands,
                                    const Floats& distance, const Floats& grown) {
    if (!rules.avoid) return all(-1.0f);
    const Floats share = least(all(1.0f), (grown + all(rules.segment)) * all(rules.inverse_ramp));
    return strands.floor * share - distance * all(rules.inverse_step);
}

// Points moved outward, if asked.
LISSOM_INLINE Floats3 pushed(const Floats3& points, const Ints& asked, const Floats& by,
                             const Floats3& slope) {
    const Floats steepness = root(dot(slope, slope));
    const Ints yes = asked & (steepness > all(0.0f));
    return choose(yes, sum(points, scaled(slope, by / steepness)), points);
}

LISSOM_INLINE Segments next_segments(const LaneStrands& strands, const Ints& go) {
    const Floats3 way = difference(strands.to, strands.at);
    return {go, strands.to, way, root(dot(way, way)), all(std::int32_t{0})};
}

LISSOM_INLINE void shorten(Segments& next, const Floats3& from, const Ints& asked,
                           const Floats& share) {
    const Ints yes = asked & next.go;
    next.way = choose(yes, scaled(next.way, share), next.way);
    next.length = choose(yes, next.length * share, next.length);
    next.to = choose(yes, sum(from, next.way), next.to);
}

LISSOM_INLINE void end_at_length(const LaneStrands& strands, Segments& next) {
    const Floats left = strands.length - strands.grown;
    const Ints too_long = next.length > left;
    if (any(too_long)) shorten(next, strands.at, too_long, left / next.length);
}

LISSOM_INLINE void meet_cut(const GrowthRules& rules, const CutRule& cut,
                            const LaneStrands& strands, Segments& next) {
    const Floats3 normal = all(cut.normal);
    const Floats plane = all(cut.offset) + all(cut.ragged) * strands.cut;
    const Floats before = dot(normal, strands.at) - plane, after = dot(normal, next.to) - plane;
    const Ints can_be = all(std::int32_t{rules.spare_tied ? 0 : -1}) | (strands.tie < all(0));
    const Ints passes = no(before > all(0.0f)) & (after > all(0.0f)) & can_be & next.go;
    if (!any(passes)) return;
    shorten(next, strands.at, passes, before / (before - after));
    next.cut = next.cut | passes;
}

// By which a vector of this length is multiplied for a whole segment.
LISSOM_INLINE Floats full_step(const GrowthRules& rules, const Floats& speed) {
    return all(rules.segment) / most(speed * all(rules.inverse_cap), all(1.0f));
}

LISSOM_INLINE void mark(Ints& end, const Ints& yes, StrandEnd why) {
    end = choose(yes, all(code(why)), end);
}

// `speed` is the length of the field's vectors at the ends of the segments. The last condition
// that holds says why a strand ends.
LISSOM_INLINE Steps steps_of(const GrowthRules& rules, const LaneStrands& strands,
                             const Segments& next, const Ints& inside, const Floats& speed) {
    const Floats left = strands.length - (strands.grown + next.length);
    const Ints moves = next.length > all(rules.min_move);
    const Ints turns =
        (dot(next.way, strands.way) < all(rules.min_cosine) * next.length * strands.way_length) &
        (strands.segments > all(0));
    Ints end = all(0);
    mark(end, strands.segments > all(rules.max_segments - 2), StrandEnd::segments);
    mark(end, no(speed > all(rules.min_speed)), StrandEnd::slow);
    mark(end, no(inside), StrandEnd::left_grid);
    mark(end, no(left > all(rules.min_move)), StrandEnd::length);
    mark(end, turns, StrandEnd::turned);
    mark(end, no(moves), StrandEnd::stuck);
    mark(end, next.cut & no(moves & turns), StrandEnd::cut);
    return {next.go & moves & no(turns), next.go & end};
}

// Puts the points of the segments that are taken behind those before, and chooses the points
// after: along the field's vectors.
LISSOM_INLINE void advance(const GrowthRules& rules, const LaneField& field,
                           const LanePlaces& places, const Reading& here, const Floats& speed,
                           const Segments& next, const Ints& take, LaneStrands& strands) {
    const Floats grown = strands.grown + next.length, left = strands.length - grown;
    const Floats scale = least(full_step(rules, speed), left / speed);
    strands.way = choose(take, next.way, strands.way);
    strands.way_length = choose(take, next.length, strands.way_length);
    strands.at = choose(take, next.to, strands.at);
    strands.to = choose(take, sum(next.to, scaled(here.vector, scale)), next.to);
    // By the slope here, which saves most pushes later.
    const Floats distance = here.distance + scale * dot(here.slope, here.vector);
    const Floats missing = missing_height(rules, strands, distance, grown);
    const Ints low = take & places.inside & (missing > all(0.0f));
    if (any(low)) strands.to = pushed(strands.to, low, missing, field.gradients(places));
    strands.grown = choose(take, grown, strands.grown);
    strands.pushes = choose(take, all(0), strands.pushes);
}

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
