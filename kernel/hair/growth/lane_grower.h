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
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// A strand is pushed out of the head this often a segment, as distances between grid points are
// interpolated.
inline constexpr std::int32_t kPushes = 3;

// A strand so little below its floor, in steps, is not pushed: it would have to look again.
inline constexpr float kMinPush = 0.02f;

inline constexpr std::size_t kFirstBuffer = 64;

// Hair in a tail comes nearer to its place there by this share a step of the grid, by less at
// first, up to so many steps behind the tie; so many steps over the head it does not go down to it.
inline constexpr float kSettling = 0.3f, kSettlingBegin = 3.0f, kSettlingRoom = 0.5f;

// None of these has a constructor: the compiler would make it outside of LISSOM_LANES_BEGIN.
struct Floats3 {
    Floats x, y, z;
};

LISSOM_INLINE Floats3 all(const Eigen::Vector3f& v) {
    return {all(v[0]), all(v[1]), all(v[2])};
}

LISSOM_INLINE Floats3 sum(const Floats3& a, const Floats3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

LISSOM_INLINE Floats3 difference(const Floats3& a, const Floats3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

LISSOM_INLINE Floats3 scaled(const Floats3& a, const Floats& by) {
    return {a.x * by, a.y * by, a.z * by};
}

LISSOM_INLINE Floats between(const Floats& a, const Floats& b, const Floats& share) {
    return a + share * (b - a);
}

LISSOM_INLINE Floats dot(const Floats3& a, const Floats3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

LISSOM_INLINE Floats3 choose(const Ints& yes, const Floats3& a, const Floats3& b) {
    return {choose(yes, a.x, b.x), choose(yes, a.y, b.y), choose(yes, a.z, b.z)};
}

inline void set(Floats3& v, int k, const Eigen::Vector3f& to) {
    v.x[k] = to[0];
    v.y[k] = to[1];
    v.z[k] = to[2];
}

inline Eigen::Vector3f get(const Floats3& v, int k) {
    return {v.x[k], v.y[k], v.z[k]};
}

// The field at the next points of the strands.
struct Reading {
    Floats3 vector;
    Floats distance;
    // Gradient of the distance a step.
    Floats3 slope;
};

// The next segments of the strands that are not pushed.
struct Segments {
    Ints go;
    Floats3 way;
    Floats length;
    // Whether a cut ends the strand.
    Ints cut;
};

constexpr std::int32_t code(StrandEnd end) {
    return 1 + static_cast<std::int32_t>(end);
}

// The first point after a root, or the code of the reason for an earlier end, else 0.
struct FirstSegment {
    Eigen::Vector3f to;
    std::int32_t end;
};

class LaneGrower {
  public:
    LaneGrower(const QuadGrid& grid, const GrowthRules& rules, std::span<const StrandSeed> seeds,
               StrandBatch& batch)
        : grid_(grid), rules_(rules), seeds_(seeds), batch_(batch) {
        batch_.lists.resize(kLanes);
        batch_.strands.assign(seeds.size(), {});
        sprouts_.resize(seeds.size());
        for (int k = 0; k < kLanes; ++k) make_room(k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            below_last_[axis] = std::nextafter(grid_.last[axis], 0.0f);
        }
    }

    void run() {
        for (std::size_t i = 0; i < seeds_.size(); i += kLanes) sprout(i);
        for (int k = 0; k < kLanes; ++k) begin_strand(k);
        while (growing_count_ > 0) {
            locate();
            const Reading here = read_all();
            const Floats missing = missing_height(here.distance, grown_);
            const Ints low =
                growing_ & inside_ & (missing > all(kMinPush)) & (pushes_ < all(kPushes));
            if (any(low)) push(low, missing, read_gradients());
            pushes_ = pushes_ - low;
            Segments next = segments_of(growing_ & no(low));
            for (std::size_t i = 0; i < rules_.ties.size(); ++i) meet_tie(rules_.ties[i], i, next);
            if (!rules_.ties.empty()) follow_tails(next, here);
            const Ints too_long = next.length > length_ - grown_;
            if (any(too_long)) shorten(next, too_long, (length_ - grown_) / next.length);
            for (const CutRule& cut : rules_.cuts) meet_cut(cut, next);
            go_on(next, here);
        }
    }

  private:
    LISSOM_INLINE void locate() {
        const Floats3 last{all(grid_.last[0]), all(grid_.last[1]), all(grid_.last[2])};
        const Floats zero = all(0.0f);
        const Floats x = least(most(to_.x, zero), last.x), y = least(most(to_.y, zero), last.y),
                     z = least(most(to_.z, zero), last.z);
        const Ints i = truncate(least(x, all(below_last_[0]))),
                   j = truncate(least(y, all(below_last_[1]))),
                   l = truncate(least(z, all(below_last_[2])));
        place_ = {x - to_floats(i), y - to_floats(j), z - to_floats(l)};
        cell_ = i + all(grid_.nx) * j + all(grid_.nxy) * l;
        inside_ = (x == to_.x) & (y == to_.y) & (z == to_.z);
    }

    // At both ends along x of a cell, there along y and z, vector and distance, and slopes of the
    // distance along y and z as the last two of four numbers.
    LISSOM_INLINE void read(std::int32_t cell, float ty, float tz, EightFloats& quads,
                            EightFloats& slopes) const {
        const float* from = grid_.values + 4 * at(cell);
        const std::size_t nx = 4 * at(grid_.nx), nxy = 4 * at(grid_.nxy);
        const EightFloats a = load(from), b = load(from + nx);
        const EightFloats low_z = load(from + nxy) - a, high_z = load(from + nxy + nx) - b;
        const EightFloats low = a + tz * low_z, along_y = (b + tz * high_z) - low;
        quads = low + ty * along_y;
        slopes = last_of(along_y, low_z + ty * (high_z - low_z));
    }

    LISSOM_INLINE Reading read_all() const {
        // Compilers that read single lanes of a vector may store all of it for each.
        std::int32_t cells[kLanes];
        float ty[kLanes], tz[kLanes];
        std::memcpy(cells, &cell_, sizeof(cells));
        std::memcpy(ty, &place_.y, sizeof(ty));
        std::memcpy(tz, &place_.z, sizeof(tz));
        EightFloats quads[kLanes], slopes[kLanes];
        for (int k = 0; k < kLanes; ++k) read(cells[k], ty[k], tz[k], quads[k], slopes[k]);
        Floats low[4], high[4], low_slopes[4], high_slopes[4];
        transpose(quads, 0, low);
        transpose(quads, 4, high);
        transpose(slopes, 0, low_slopes);
        transpose(slopes, 4, high_slopes);
        const Floats& x = place_.x;
        return {
            {between(low[0], high[0], x), between(low[1], high[1], x), between(low[2], high[2], x)},
            between(low[3], high[3], x),
            {high[3] - low[3], between(low_slopes[2], high_slopes[2], x),
             between(low_slopes[3], high_slopes[3], x)}};
    }

    // The way out of the head, of any length.
    LISSOM_INLINE Floats3 read_gradients() const {
        std::int32_t cells[kLanes];
        float ty[kLanes], tz[kLanes];
        std::memcpy(cells, &cell_, sizeof(cells));
        std::memcpy(ty, &place_.y, sizeof(ty));
        std::memcpy(tz, &place_.z, sizeof(tz));
        const std::size_t nx = 4 * at(grid_.nx), nxy = 4 * at(grid_.nxy);
        EightFloats gradients[kLanes];
        for (int k = 0; k < kLanes; ++k) {
            const float* from = grid_.gradients + 4 * at(cells[k]);
            const EightFloats a = load(from), b = load(from + nx);
            const EightFloats low = a + tz[k] * (load(from + nxy) - a),
                              high = b + tz[k] * (load(from + nxy + nx) - b);
            gradients[k] = low + ty[k] * (high - low);
        }
        Floats low[4], high[4];
        transpose(gradients, 0, low);
        transpose(gradients, 4, high);
        const Floats& x = place_.x;
        return {between(low[0], high[0], x), between(low[1], high[1], x),
                between(low[2], high[2], x)};
    }

    // Returns the distance of a point at this height over the head below the floor of its strand.
    LISSOM_INLINE Floats missing_height(const Floats& distance, const Floats& grown) const {
        if (!rules_.avoid) return all(-1.0f);
        const Floats share =
            least(all(1.0f), (grown + all(rules_.segment)) * all(rules_.inverse_ramp));
        return floor_ * share - distance * all(rules_.inverse_step);
    }

    // Moves the next points outward.
    LISSOM_INLINE void push(const Ints& asked, const Floats& by, const Floats3& slope) {
        const Floats steepness = root(dot(slope, slope));
        const Ints yes = asked & (steepness > all(0.0f));
        to_ = choose(yes, sum(to_, scaled(slope, by / steepness)), to_);
    }

    LISSOM_INLINE Segments segments_of(const Ints& go) const {
        const Floats3 way = difference(to_, at_);
        return {go, way, root(dot(way, way)), all(std::int32_t{0})};
    }

    // Shortens segments before the next points, if asked.
    LISSOM_INLINE void shorten(Segments& next, const Ints& asked, const Floats& share) {
        const Ints yes = asked & next.go;
        next.way = choose(yes, scaled(next.way, share), next.way);
        next.length = choose(yes, next.length * share, next.length);
        to_ = choose(yes, sum(at_, next.way), to_);
    }

    LISSOM_INLINE void meet_tie(const TieRule& tie, std::size_t number, const Segments& next) {
        meet_gate(tie, tie.tie, number, next);
        for (const TailGate& gate : tie.gates) meet_gate(tie, gate, number, next);
    }

    LISSOM_INLINE void meet_gate(const TieRule& tie, const TailGate& gate, std::size_t number,
                                 const Segments& next) {
        const Floats3 direction = all(gate.direction), center = all(gate.center);
        const Floats before = dot(direction, difference(at_, center)),
                     after = dot(direction, difference(to_, center));
        const Ints passes =
            (before < all(0.0f)) & no(after < all(0.0f)) & (tie_ < all(0)) & next.go;
        if (any(passes)) pass_gate(tie, gate, number, next, passes, before / (before - after));
    }

    // Catches strands that pass the plane of a tie or of a gate behind it, that share of the
    // segment on, within its radius.
    void pass_gate(const TieRule& tie, const TailGate& gate, std::size_t number,
                   const Segments& next, const Ints& passes, const Floats& share) {
        for (int k = 0; k < kLanes; ++k) {
            if (!passes[k]) continue;
            const Eigen::Vector3f off = get(at_, k) + share[k] * get(next.way, k) - gate.center;
            if (off.squaredNorm() > gate.square_radius) continue;
            tie_[k] = index_of(number);
            tails_.plane[k] = gate.plane;
            const float angle = static_cast<float>(kPi) * cut_[k], far = std::sqrt(tail_[k]);
            tails_.right[k] = far * std::cos(angle);
            tails_.above[k] = far * std::sin(angle);
            if (!tie.measures) continue;
            tails_.length[k] = tie.tail_length * (1.0f - tie.ragged * std::sqrt(tail_[k]));
            length_[k] = grown_[k] + share[k] * next.length[k] +
                         std::max(tails_.length[k] - gate.behind, 0.0f);
        }
    }

    // Factors of the growth of strands in tails, by their place along its spine: in the bend of a
    // tail the way is longer outside; and their places in it.
    LISSOM_INLINE void follow_tails(Segments& next, const Reading& here) {
        const Ints tied = next.go & no(tie_ < all(0));
        if (!any(tied)) return;
        for (int k = 0; k < kLanes; ++k) {
            if (!tied[k]) continue;
            pass_planes(rules_.ties[tie_[k]], next, k);
            settle(rules_.ties[tie_[k]], next, here, k);
        }
    }

    // Draws a strand towards its own place in the cross section of a tail, unless that leads into
    // the head.
    void settle(const TieRule& tie, Segments& next, const Reading& here, int k) {
        if (at(tails_.plane[k]) >= tie.planes.size()) return;
        const TailPlane& plane = tie.planes[at(tails_.plane[k])];
        if (!(plane.side.squaredNorm() > 0.0f)) return;
        const Eigen::Vector3f to = get(to_, k), from = to - plane.center;
        const Eigen::Vector3f off = from - from.dot(plane.direction) * plane.direction;
        const Eigen::Vector3f place = tails_.right[k] * plane.side + tails_.above[k] * plane.up;
        const float share = std::min(1.0f, kSettling * next.length[k]) *
                            std::min(1.0f, plane.behind / kSettlingBegin);
        const Eigen::Vector3f by = share * (place - off);
        const float sinks = get(here.slope, k).dot(by);
        const float height = (here.distance[k] + sinks) * rules_.inverse_step;
        if (rules_.avoid && sinks < 0.0f && height < floor_[k] + kSettlingRoom) return;
        set(to_, k, to + by);
        const Eigen::Vector3f way = get(to_, k) - get(at_, k);
        set(next.way, k, way);
        next.length[k] = way.norm();
    }

    void pass_planes(const TieRule& tie, const Segments& next, int k) {
        for (std::size_t i = tails_.plane[k]; i < tie.planes.size(); ++i) {
            const TailPlane& plane = tie.planes[i];
            if (plane.behind >= tails_.length[k]) return;
            const float after = plane.direction.dot(get(to_, k) - plane.center);
            if (after < 0.0f) return;
            const float before = plane.direction.dot(get(at_, k) - plane.center);
            const float share = before < 0.0f ? before / (before - after) : 0.0f;
            length_[k] = grown_[k] + share * next.length[k] + (tails_.length[k] - plane.behind);
            tails_.plane[k] = index_of(i) + 1;
        }
    }

    LISSOM_INLINE void meet_cut(const CutRule& cut, Segments& next) {
        const Floats3 normal = all(cut.normal);
        const Floats plane = all(cut.offset) + all(cut.ragged) * cut_;
        const Floats before = dot(normal, at_) - plane, after = dot(normal, to_) - plane;
        const Ints can_be = all(std::int32_t{rules_.spare_tied ? 0 : -1}) | (tie_ < all(0));
        const Ints passes = no(before > all(0.0f)) & (after > all(0.0f)) & can_be & next.go;
        if (!any(passes)) return;
        shorten(next, passes, before / (before - after));
        next.cut = next.cut | passes;
    }

    // Takes the segments that may be taken, ends strands, and chooses the points after.
    LISSOM_INLINE void go_on(const Segments& next, const Reading& here) {
        const Floats speed = root(dot(here.vector, here.vector));
        const Floats grown = grown_ + next.length, left = length_ - grown;
        const Ints moves = next.length > all(rules_.min_move);
        const Ints turns =
            (dot(next.way, way_) < all(rules_.min_cosine) * next.length * way_length_) &
            (segments_ > all(0));
        const Ints take = next.go & moves & no(turns);
        const Ints end = next.go & ends_of(next, moves, turns, left, speed);

        const Floats scale = least(full_step(speed), left / speed);
        put_points(take);
        way_ = choose(take, next.way, way_);
        way_length_ = choose(take, next.length, way_length_);
        at_ = choose(take, to_, at_);
        to_ = choose(take, sum(to_, scaled(here.vector, scale)), to_);
        // By the slope here, which saves most pushes later.
        const Floats distance = here.distance + scale * dot(here.slope, here.vector);
        const Floats missing = missing_height(distance, grown);
        const Ints low = take & inside_ & (missing > all(0.0f));
        if (any(low)) push(low, missing, read_gradients());
        grown_ = choose(take, grown, grown_);
        pushes_ = choose(take, all(0), pushes_);
        if (any(end)) end_lanes(end);
    }

    // By which a vector of this length is multiplied for a whole segment.
    LISSOM_INLINE Floats full_step(const Floats& speed) const {
        return all(rules_.segment) / most(speed * all(rules_.inverse_cap), all(1.0f));
    }

    static LISSOM_INLINE void mark(Ints& end, const Ints& yes, StrandEnd why) {
        end = choose(yes, all(code(why)), end);
    }

    // Returns the code of each strand's end with this segment, or before it, or 0; the last
    // condition that holds counts.
    LISSOM_INLINE Ints ends_of(const Segments& next, const Ints& moves, const Ints& turns,
                               const Floats& left, const Floats& speed) const {
        Ints end = all(0);
        mark(end, segments_ > all(rules_.max_segments - 2), StrandEnd::segments);
        mark(end, no(speed > all(rules_.min_speed)), StrandEnd::slow);
        mark(end, no(inside_), StrandEnd::left_grid);
        mark(end, no(left > all(rules_.min_move)), StrandEnd::length);
        mark(end, turns, StrandEnd::turned);
        mark(end, no(moves), StrandEnd::stuck);
        mark(end, next.cut & no(moves & turns), StrandEnd::cut);
        return end;
    }

    // Chooses the first points after the roots of the seeds from `first` on, one a lane.
    LISSOM_INLINE void sprout(std::size_t first) {
        const std::size_t count = std::min<std::size_t>(kLanes, seeds_.size() - first);
        Floats3 normal{};
        for (std::size_t k = 0; k < count; ++k) {
            const StrandSeed& seed = seeds_[first + k];
            set(to_, index_of(k), seed.at);
            set(normal, index_of(k), seed.normal);
            length_[index_of(k)] = seed.length;
        }
        locate();
        const Floats3 v = read_all().vector;
        const Floats inward = all(rules_.outward) * least(all(0.0f), dot(v, normal));
        const Floats3 lifted = sum(v, scaled(normal, all(rules_.lift) - inward));
        const Floats speed = root(dot(lifted, lifted));
        const Floats scale = least(full_step(speed), length_ / speed);
        to_ = sum(to_, scaled(lifted, scale));
        const Ints end = ends_of_roots(root(dot(v, v)), speed);
        for (std::size_t k = 0; k < count; ++k) {
            const int lane = index_of(k);
            sprouts_[first + k] = {get(to_, lane), end[lane]};
        }
    }

    // Returns the code of each strand's end at its root, or 0; the last condition that holds
    // counts.
    LISSOM_INLINE Ints ends_of_roots(const Floats& speed, const Floats& lifted_speed) const {
        Ints end = all(0);
        mark(end, no(lifted_speed > all(0.0f)), StrandEnd::slow);
        mark(end, no(speed > all(rules_.min_speed)), StrandEnd::slow);
        mark(end, no(inside_), StrandEnd::left_grid);
        mark(end, no(length_ > all(rules_.min_move)), StrandEnd::length);
        return end;
    }

    // Adds the next points to the strands; in lanes that do not take them they are overwritten
    // later.
    LISSOM_INLINE void put_points(const Ints& take) {
        const Eigen::Matrix3f& m = rules_.linear;
        const Floats x = all(rules_.translation[0]) + all(m(0, 0)) * to_.x + all(m(0, 1)) * to_.y +
                         all(m(0, 2)) * to_.z;
        const Floats y = all(rules_.translation[1]) + all(m(1, 0)) * to_.x + all(m(1, 1)) * to_.y +
                         all(m(1, 2)) * to_.z;
        const Floats z = all(rules_.translation[2]) + all(m(2, 0)) * to_.x + all(m(2, 1)) * to_.y +
                         all(m(2, 2)) * to_.z;
        float rows[4][kLanes];
        store_rows(x, y, z, rows);
        const Ints places = segments_ + segments_ + segments_;
        for (int k = 0; k < kLanes; ++k) {
            std::memcpy(ends_[k] + places[k], rows[k % 4] + k / 4 * 4, 4 * sizeof(float));
        }
        segments_ = segments_ - take;
        const Ints full = segments_ > capacity_;
        if (any(full)) enlarge_lanes(full);
    }

    std::vector<float>& list(int k) { return batch_.lists[k]; }

    void enlarge_lanes(const Ints& full) {
        for (int k = 0; k < kLanes; ++k) {
            if (!full[k]) continue;
            list(k).resize(2 * list(k).size());
            place_strand(k);
        }
    }

    // Makes room for the beginning of a strand behind the finished ones.
    void make_room(int k) {
        const std::size_t needed = starts_[k] + 3 * kFirstBuffer;
        if (list(k).size() < needed) list(k).resize(2 * needed);
        place_strand(k);
    }

    void place_strand(int k) {
        const std::size_t start = starts_[k];
        ends_[k] = list(k).data() + start + 3;
        capacity_[k] = index_of((list(k).size() - start) / 3) - 3;
    }

    void end_lanes(const Ints& end) {
        for (unsigned lanes = bits_of(end); lanes != 0; lanes &= lanes - 1) {
            const int k = std::countr_zero(lanes);
            record(k, end[k]);
            --growing_count_;
            begin_strand(k);
        }
    }

    void record(int k, std::int32_t end) {
        const Index count = segments_[k] + 1;
        const std::size_t lane = k;
        batch_.strands[seed_of_[k]] = {lane, starts_[lane], count, tie_[k],
                                       static_cast<StrandEnd>(end - 1)};
        starts_[lane] += 3 * at(count);
        make_room(k);
    }

    // Gives lane k the next seed that can grow; others are strands of their roots alone.
    void begin_strand(int k) {
        growing_[k] = 0;
        while (next_ < seeds_.size()) {
            seed_of_[k] = next_;
            const StrandSeed& seed = seeds_[next_++];
            start(k, seed);
            const FirstSegment& sprout = sprouts_[next_ - 1];
            if (sprout.end == 0) {
                set(to_, k, sprout.to);
                growing_[k] = -1;
                ++growing_count_;
                return;
            }
            record(k, sprout.end);
        }
        // The lane runs on, and its points are overwritten.
        segments_[k] = 0;
        set(at_, k, Eigen::Vector3f::Zero());
        set(to_, k, Eigen::Vector3f::Zero());
    }

    void start(int k, const StrandSeed& seed) {
        set(at_, k, seed.at);
        grown_[k] = 0.0f;
        length_[k] = seed.length;
        floor_[k] = seed.floor;
        cut_[k] = seed.cut;
        tail_[k] = seed.tail;
        segments_[k] = pushes_[k] = 0;
        tie_[k] = kNoIndex;
        const Eigen::Vector3f root_point = (rules_.linear * seed.at).eval() + rules_.translation;
        std::copy_n(root_point.data(), 3, ends_[k] - 3);
    }

    // The strands of all lanes: last and next points, the last segments and their lengths, lengths
    // so far and in the end, floors and random numbers, whether there is a strand, segments so far,
    // pushes of the next point, and ties.
    Floats3 at_{}, to_{}, way_{};
    Floats way_length_{}, grown_{}, length_{}, floor_{}, cut_{}, tail_{};
    Ints growing_{}, segments_{}, pushes_{}, tie_{};
    // For strands in a tail: their final length along its spine, the next of its planes, and their
    // places across it, in its radius.
    struct Tails {
        Floats length, right, above;
        Ints plane;
    };
    // Zeros from here: without optimisation gcc 12 does not compile such values of the members
    // above.
    Tails tails_{};
    // For the next points: their cells, places in them, and whether they are in the grid.
    Ints cell_{}, inside_{};
    Floats3 place_{};
    // Segments for which there is room.
    Ints capacity_{};

    const QuadGrid& grid_;
    // Just below the greatest coordinates, so in the last cell.
    std::array<float, 3> below_last_{};
    const GrowthRules& rules_;
    std::span<const StrandSeed> seeds_;
    StrandBatch& batch_;
    // The beginning of each lane's strand in its list, and its continuation after the root.
    std::array<std::size_t, kLanes> starts_{};
    float* ends_[kLanes]{};
    std::array<std::size_t, kLanes> seed_of_{};
    std::size_t next_ = 0;
    // First segments of the seeds.
    std::vector<FirstSegment> sprouts_;
    int growing_count_ = 0;
};

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
