/// Strands follow the motions along their group side by side, one a lane. Files that include this
/// are compiled without contraction to fused instructions, so that every processor gives the same
/// points. Private to kernel/hair; growth_lanes.h says for which processor this is compiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernel/hair/follow/path_loops.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

static_assert(kPathLanes % kLanes == 0);

// Parts of segments' lengths that tips may have at least before all segments shrink alike.
inline constexpr float kLeastTip = 0.25f, kMostTip = 4.0f;
// Metres below their floor at which points begin to be moved.
inline constexpr float kContactSlack = 1e-5f;

LISSOM_INLINE Floats load_lanes(const float* from) {
    Floats result;
    std::memcpy(&result, from, sizeof(result));
    return result;
}

LISSOM_INLINE void store_lanes(const Floats& x, float* to) {
    std::memcpy(to, &x, sizeof(x));
}

LISSOM_INLINE Floats3 load_point(const PathRow& row, int first) {
    return {load_lanes(row.x + first), load_lanes(row.y + first), load_lanes(row.z + first)};
}

LISSOM_INLINE void store_point(const Floats3& point, PathRow& row, int first) {
    store_lanes(point.x, row.x + first);
    store_lanes(point.y, row.y + first);
    store_lanes(point.z, row.z + first);
}

// Some strands of a block, from the lane `first` on.
class PathPart {
  public:
    PathPart(const PathBlock& block, PathRow* steps, int first)
        : block_(block), strands_(*block.strands), steps_(steps), first_(first) {}

    void move() {
        take_steps();
        fit_lengths();
        make_points();
    }

  private:
    // The steps from each point to the next as the motions take them, and their lengths.
    LISSOM_INLINE void take_steps() {
        const Floats3 first = load_point(block_.rows[0], first_);
        const Floats per_total = all(1.0f) / load_lanes(strands_.total + first_);
        Floats3 before = roots();
        have_ = weighted_ = all(0.0f);
        for (int k = 1; k < strands_.rows; ++k) {
            const PathRow& row = block_.rows[k];
            fetch_ahead(row);
            const Floats3 rest = load_point(row, first_);
            const Floats arc = load_lanes(row.arc + first_);
            Floats3 target = moved(rest, arc, block_.ranges[k]);
            if (block_.ranges[k].in_ramp) target = turned(difference(rest, first), arc, target);
            const Floats3 step = difference(target, before);
            const Floats size = root(dot(step, step)), t = arc * per_total;
            have_ = have_ + size;
            weighted_ = weighted_ + size * t * t;
            before = target;
            store_point(step, steps_[k], first_);
        }
    }

    // A point by the motions of the knots around it.
    LISSOM_INLINE Floats3 moved(const Floats3& rest, const Floats& arc, const PathRange& range) {
        const Floats knot = least(arc * all(block_.per_metre), all(block_.last_knot));
        const Floats x = rest.x - all(block_.origin[0]), y = rest.y - all(block_.origin[1]),
                     z = rest.z - all(block_.origin[2]);
        Floats3 target = rest;
        for (int j = range.low; j <= range.high; ++j) {
            const float* const m = block_.knots + 16 * static_cast<std::size_t>(j);
            const Floats away = knot - all(static_cast<float>(j));
            const Floats part = most(all(1.0f) - most(away, all(0.0f) - away), all(0.0f));
            target.x = target.x + part * (m[0] * x + m[4] * y + m[8] * z + all(m[12]));
            target.y = target.y + part * (m[1] * x + m[5] * y + m[9] * z + all(m[13]));
            target.z = target.z + part * (m[2] * x + m[6] * y + m[10] * z + all(m[14]));
        }
        return target;
    }

    // Near the root points turn with the skin.
    LISSOM_INLINE Floats3 turned(const Floats3& p, const Floats& arc, const Floats3& target) {
        const float* const m = block_.turn;
        const Floats v = least(arc * all(block_.per_ramp), all(1.0f));
        const Floats share = all(1.0f) - v * v * (all(3.0f) - 2.0f * v);
        const Floats3 turn = {m[0] * p.x + m[3] * p.y + m[6] * p.z,
                              m[1] * p.x + m[4] * p.y + m[7] * p.z,
                              m[2] * p.x + m[5] * p.y + m[8] * p.z};
        const Floats3 skin = sum(roots(), turn);
        return {between(target.x, skin.x, share), between(target.y, skin.y, share),
                between(target.z, skin.z, share)};
    }

    // The factors that give strands their lengths: base + slope * arc^2.
    LISSOM_INLINE void fit_lengths() {
        const Floats total = load_lanes(strands_.total + first_), none = all(0.0f);
        const Floats want = block_.scale * total, per_total = all(1.0f) / total;
        const Floats change = choose(weighted_ > none, (want - have_) / weighted_, none);
        const Floats tip = all(1.0f) + change;
        const Ints is_fair = (tip > all(kLeastTip)) & (tip < all(kMostTip));
        const Floats even = choose(have_ > none, want / have_, all(1.0f));
        base_ = choose(is_fair, all(1.0f), even);
        slope_ = choose(is_fair, change * per_total * per_total, none);
    }

    // Steps become points; those bound to the skin stay over it.
    LISSOM_INLINE void make_points() {
        Floats3 target = roots(), before = target;
        Ints pushed = all(std::int32_t{0});
        store_point(target, steps_[0], first_);
        const PathContact* next = block_.contacts;
        const PathContact* const last = next + block_.contact_count;
        for (int k = 1; k < strands_.rows; ++k) {
            const Floats arc = load_lanes(block_.rows[k].arc + first_);
            const Floats3 step = scaled(load_point(steps_[k], first_), base_ + slope_ * arc * arc);
            target = sum(target, step);
            const bool is_bound = next != last && next->row == k;
            before = is_bound || any(pushed)
                         ? lifted(step, target, before, is_bound ? next : nullptr, pushed)
                         : target;
            if (is_bound) ++next;
            store_point(before, steps_[k], first_);
        }
    }

    // The place of a point over the skin. A point whose points before were moved comes back to its
    // target as far as the length of its segment lets it; one that is too low rises by turning its
    // segment.
    LISSOM_INLINE Floats3 lifted(const Floats3& step, const Floats3& target, const Floats3& before,
                                 const PathContact* contact, Ints& pushed) {
        const Floats none = all(0.0f);
        Floats3 along = difference(target, before);
        const Floats far = root(dot(along, along)), size = root(dot(step, step));
        const Ints drawn = pushed & (far > none);
        along = choose(drawn, scaled(along, size / far), along);
        Ints moved = all(std::int32_t{0});
        if (contact != nullptr) moved = raise(*contact, before, along);
        const Floats3 point = choose(moved | drawn, sum(before, along), target);
        const Floats3 away = difference(point, target);
        const Ints is_away = dot(away, away) > all(kContactSlack * kContactSlack);
        pushed = moved | (pushed & is_away);
        return point;
    }

    // Turns segments whose ends lie below their floor so that they end there, or as near as they
    // can; whether it did.
    LISSOM_INLINE Ints raise(const PathContact& contact, const Floats3& before, Floats3& along) {
        Floats3 foot, normal;
        take_skin(contact, foot, normal);
        const Floats none = all(0.0f), floor = block_.scale * load_lanes(contact.floor + first_);
        const Floats from = dot(normal, difference(before, foot)), rise = dot(normal, along);
        const Ints low = from + rise < floor - all(kContactSlack);
        if (!any(low)) return low;
        const Floats up = floor - from, square = dot(along, along);
        const Floats beside = square - up * up;
        const Floats3 level = difference(along, scaled(normal, rise));
        const Floats size = root(dot(level, level));
        const Ints fits = (beside > none) & (size > none);
        const Floats level_part = root(most(beside, none)) / size;
        const Floats3 turned_up = sum(scaled(normal, up), scaled(level, level_part));
        const Floats3 upright = scaled(normal, root(square));
        along = choose(low, choose(fits, turned_up, upright), along);
        return low;
    }

    // Places and unit normals on the skin, the means of the corners.
    LISSOM_INLINE void take_skin(const PathContact& contact, Floats3& foot, Floats3& normal) {
        EightFloats rows[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const int lane = first_ + i;
            rows[i] = contact.weights[0][lane] * corner(contact.vertices[0][lane]) +
                      contact.weights[1][lane] * corner(contact.vertices[1][lane]) +
                      contact.weights[2][lane] * corner(contact.vertices[2][lane]);
        }
        Floats columns[4];
        transpose(rows, 0, columns);
        foot = {columns[0], columns[1], columns[2]};
        transpose(rows, 4, columns);
        normal = {columns[0], columns[1], columns[2]};
        const Floats size = root(dot(normal, normal));
        normal = scaled(normal, choose(size > all(0.0f), all(1.0f) / size, all(0.0f)));
    }

    // The eight numbers of a vertex of the skin.
    LISSOM_INLINE EightFloats corner(std::uint32_t vertex) const {
        return load(block_.skin + 8 * std::size_t{vertex});
    }

    LISSOM_INLINE Floats3 roots() const {
        return {load_lanes(block_.roots[0] + first_), load_lanes(block_.roots[1] + first_),
                load_lanes(block_.roots[2] + first_)};
    }

    // Rows of the next block come from memory while this one is moved.
    LISSOM_INLINE static void fetch_ahead([[maybe_unused]] const PathRow& row) {
#if defined(__GNUC__)
        constexpr std::uintptr_t kAhead = 20 * sizeof(PathRow), kLine = 64;
        const auto place = reinterpret_cast<std::uintptr_t>(&row) + kAhead;
        for (std::uintptr_t i = 0; i < sizeof(PathRow); i += kLine) {
            __builtin_prefetch(reinterpret_cast<const void*>(place + i));
        }
#endif
    }

    const PathBlock& block_;
    const PathStrands& strands_;
    PathRow* steps_;
    int first_;
    Floats have_{}, weighted_{}, base_{}, slope_{};
};

inline void move_lanes(const PathBlock& block, PathRow* steps) {
    for (int first = 0; first < block.strands->count; first += kLanes) {
        PathPart(block, steps, first).move();
    }
}

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
