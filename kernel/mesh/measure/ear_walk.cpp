#include "kernel/mesh/measure/ear_walk.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "kernel/mesh/measure/flat_triangle.h"

namespace lissom {
namespace {

// Errors of coordinates in the plane, as a fraction of the polygon's extent.
constexpr double kFlatRounding = 1e-14;

// A triangle to search points of the plane in. Points beyond its sides, by a triangle of twice the
// area `beyond`, still count as inside.
class SearchedTriangle {
  public:
    SearchedTriangle(const std::array<Vec2, 3>& corners, double beyond, double extent)
        : corners_(corners), beyond_(beyond + kFlatRounding * extent * extent) {
        const Vec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
        const double area = ab.x() * ac.y() - ab.y() * ac.x();
        // Barycentric coordinates of all that counts as inside are above this share, negative.
        const double share = beyond_ / std::max(area, beyond_);
        const Vec2 sum = corners[0] + corners[1] + corners[2];
        min_ = max_ = corners[0];
        for (const Vec2& corner : corners) {
            const Vec2 farther = corner + share * (3.0 * corner - sum);
            min_ = min_.cwiseMin(farther);
            max_ = max_.cwiseMax(farther);
        }
        min_.array() -= kFlatRounding * extent;
        max_.array() += kFlatRounding * extent;
    }

    // Returns false only if no point of the box counts as inside.
    bool meets(const PlanePoints::Box2& box) const {
        if ((box.min.array() > max_.array()).any() || (box.max.array() < min_.array()).any()) {
            return false;
        }
        return !lies_beyond(0, 1, box) && !lies_beyond(1, 2, box) && !lies_beyond(2, 0, box);
    }

  private:
    // Whether the box lies beyond the side from corner i to corner j.
    bool lies_beyond(std::size_t i, std::size_t j, const PlanePoints::Box2& box) const {
        const Vec2 side = corners_[j] - corners_[i];
        const Vec2 inmost(side.y() > 0.0 ? box.min.x() : box.max.x(),
                          side.x() > 0.0 ? box.max.y() : box.min.y());
        const Vec2 to = inmost - corners_[i];
        return side.x() * to.y() - side.y() * to.x() < -beyond_;
    }

    std::array<Vec2, 3> corners_;
    double beyond_;
    Vec2 min_, max_;
};

class EarWalk {
  public:
    EarWalk(std::span<const Vec3> points, const Vec3& normal,
            std::vector<std::array<Index, 3>>& triangles, EarRoom& room)
        : points_(points),
          normal_(normal),
          triangles_(triangles),
          room_(room),
          steps_left_(kStepsPerCorner * points.size()) {
        const Index n = count_of(points);
        link_corners(n);
        lay_flat();
        room_.obstacles.assign(room_.flat_points);
        room_.open.assign(n, true);
        room_.in_line.assign(n, false);
        room_.convex.assign(n, false);
        for (Index i = 0; i < n; ++i) note_shape(i);
    }

    void clip_all() {
        Index here = 0;
        for (std::size_t left = points_.size(); left > 3; --left) {
            here = next_ear(here);
            const Index after = room_.after[at(here)];
            clip(here);
            // The corner after an ear waits for the next turn, so that ears do not become a fan.
            here = room_.after[at(after)];
        }
        triangles_.push_back({room_.before[at(here)], here, room_.after[at(here)]});
    }

  private:
    // Enough for any outline that is drawn, and a bound for outlines made to be slow.
    static constexpr std::size_t kStepsPerCorner = 500;

    void link_corners(Index n) {
        room_.before.resize(at(n));
        room_.after.resize(at(n));
        for (Index i = 0; i < n; ++i) {
            room_.before[at(i)] = (i + n - 1) % n;
            room_.after[at(i)] = (i + 1) % n;
        }
        for (auto* list :
             {&room_.blocker, &room_.previous_blocked, &room_.next_blocked, &room_.first_blocked}) {
            list->assign(at(n), kNoIndex);
        }
    }

    // Coordinates in the mean plane, from the first corner on.
    void lay_flat() {
        const Vec3 along = normal_.unitOrthogonal(), across = normal_.cross(along);
        room_.flat_points.clear();
        for (const Vec3& p : points_) {
            const Vec3 from_first = p - points_[0];
            room_.flat_points.emplace_back(from_first.dot(along), from_first.dot(across));
            extent_ = std::max(extent_, 2.0 * room_.flat_points.back().cwiseAbs().maxCoeff());
        }
    }

    // Returns the next corner to clip, from `here` on: a proper ear; if there is none, a corner in
    // line with its neighbours; then a convex one; then any.
    Index next_ear(Index here) {
        for (Index i = here; (i = room_.open.next_around(i)) != kNoIndex;) {
            if (steps_left_ == 0) return i;
            --steps_left_;
            room_.open.erase(i);
            if (!room_.convex.contains(i)) continue;
            const Index found = find_within(i);
            if (found == kNoIndex) return i;
            block(i, found);
        }
        const Index in_line = room_.in_line.next_around(here);
        if (in_line != kNoIndex) return in_line;
        const Index convex = room_.convex.next_around(here);
        return convex != kNoIndex ? convex : here;
    }

    void note_shape(Index i) {
        const Vec3 &a = before(i), &b = points_[at(i)], &c = after(i);
        const double flat = kFlatTriangle * longest_side_squared(a, b, c);
        const double area = signed_area(a, b, c, normal_);
        room_.convex.set(i, area > flat);
        room_.in_line.set(i, area <= flat && area >= -flat);
        room_.obstacles.set_present(i, area <= flat);
        if (area > flat) open_blocked_by(i);
    }

    // Returns a corner that lies in the ear of corner i. One at the place of a corner of the ear,
    // at a point of self-contact of the outline, does not count.
    Index find_within(Index i) {
        const Vec3 &a = before(i), &b = points_[at(i)], &c = after(i);
        const double flat = kFlatTriangle * longest_side_squared(a, b, c);
        const auto& flats = room_.flat_points;
        const SearchedTriangle ear(
            {flats[at(room_.before[at(i)])], flats[at(i)], flats[at(room_.after[at(i)])]}, flat,
            extent_);
        const auto lies_within = [&](Index other) {
            const Vec3& p = points_[at(other)];
            return p != a && p != b && p != c && signed_area(a, b, p, normal_) >= -flat &&
                   signed_area(b, c, p, normal_) >= -flat && signed_area(c, a, p, normal_) >= -flat;
        };
        return room_.obstacles.find([&](const auto& box) { return ear.meets(box); }, lies_within,
                                    steps_left_);
    }

    void clip(Index i) {
        const Index a = room_.before[at(i)], c = room_.after[at(i)];
        triangles_.push_back({a, i, c});
        room_.after[at(a)] = c;
        room_.before[at(c)] = a;
        for (CornerSet* set : {&room_.open, &room_.in_line, &room_.convex}) set->erase(i);
        room_.obstacles.set_present(i, false);
        unblock(i);
        open_blocked_by(i);
        for (const Index neighbor : {a, c}) {
            unblock(neighbor);
            room_.open.insert(neighbor);
            note_shape(neighbor);
        }
    }

    void block(Index i, Index blocker) {
        const Index next = room_.first_blocked[at(blocker)];
        room_.blocker[at(i)] = blocker;
        room_.previous_blocked[at(i)] = kNoIndex;
        room_.next_blocked[at(i)] = next;
        if (next != kNoIndex) room_.previous_blocked[at(next)] = i;
        room_.first_blocked[at(blocker)] = i;
    }

    void unblock(Index i) {
        const Index blocker = room_.blocker[at(i)];
        if (blocker == kNoIndex) return;
        const Index previous = room_.previous_blocked[at(i)], next = room_.next_blocked[at(i)];
        if (next != kNoIndex) room_.previous_blocked[at(next)] = previous;
        (previous != kNoIndex ? room_.next_blocked[at(previous)]
                              : room_.first_blocked[at(blocker)]) = next;
        room_.blocker[at(i)] = kNoIndex;
    }

    void open_blocked_by(Index blocker) {
        for (Index i; (i = room_.first_blocked[at(blocker)]) != kNoIndex;) {
            unblock(i);
            room_.open.insert(i);
        }
    }

    const Vec3& before(Index i) const { return points_[at(room_.before[at(i)])]; }
    const Vec3& after(Index i) const { return points_[at(room_.after[at(i)])]; }

    std::span<const Vec3> points_;
    Vec3 normal_;
    std::vector<std::array<Index, 3>>& triangles_;
    EarRoom& room_;
    std::size_t steps_left_;
    double extent_ = 0.0;
};

}  // namespace

void clip_ears_around(std::span<const Vec3> points, const Vec3& normal,
                      std::vector<std::array<Index, 3>>& triangles, EarRoom& room) {
    EarWalk(points, normal, triangles, room).clip_all();
}

}  // namespace lissom
