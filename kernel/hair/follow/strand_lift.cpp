#include "kernel/hair/follow/strand_lift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lissom {
namespace {

// Metres along a strand over which the clearance grows; what is deeper than the slack is inside.
constexpr double kLiftRamp = 0.01, kLiftSlack = 1e-5;
constexpr int kLiftSteps = 3;
// Metres over the skin at rest beyond which a point's height does not matter, and within which the
// skin is looked for at least.
constexpr double kRestReach = 0.02, kLookReach = 0.012;

// The point k of a strand whose points before were moved: it comes back to where the head takes it
// as far as the length of the segment lets it.
Vec3 drawn_point(const LiftedStrand& strand, Index k, double size) {
    const Vec3 before = strand.made.col(k - 1).cast<double>();
    const Vec3 target = strand.made.col(k).cast<double>(), along = target - before;
    const double length = along.norm();
    return length > 0.0 ? Vec3(before + size / length * along) : target;
}

// A step of the same length that rises by `rise` more along a unit normal, as far as it can.
Vec3 raised_step(const Vec3& step, const Vec3& normal, double rise) {
    const double up = normal.dot(step) + rise, beside = step.squaredNorm() - up * up;
    const Vec3 level = step - normal.dot(step) * normal;
    const double size = level.norm();
    if (!(beside > 0.0) || !(size > 0.0)) return step.norm() * normal;
    return up * normal + std::sqrt(beside) / size * level;
}

bool is_low(const std::optional<SkinHeight>& over, double floor) {
    return over && over->height < floor - kLiftSlack;
}

}  // namespace

double clearance_at(double clearance, float arc) {
    return clearance * std::min(1.0, double{arc} / kLiftRamp);
}

double StrandLift::floor_at(float arc) const {
    return head_.scale() * clearance_at(clearance_, arc);
}

double StrandLift::rest_height(const SkinSurface& rest, const Vec3& point) const {
    const auto over = rest.height(point, kRestReach);
    return over ? head_.scale() * over->height : std::numeric_limits<double>::infinity();
}

// Moves a point to its floor over the skin, as far from the point before it as it was.
template <typename Height>
bool StrandLift::raise(LiftedStrand& strand, Index k, Vec3& point, double floor,
                       const Height& height) const {
    const Vec3 before = strand.made.col(k - 1).cast<double>();
    bool moved = false;
    for (int step = 0; step < kLiftSteps; ++step) {
        const std::optional<SkinHeight> over = height(point);
        if (!is_low(over, floor)) break;
        moved = true;
        point = before + raised_step(point - before, over->normal, floor - over->height);
    }
    return moved;
}

// Moves a point so that the middle of the segment before it is not deeper inside than at rest.
template <typename Height>
bool StrandLift::raise_middle(const LiftedStrand& strand, Index k, Vec3& point,
                              const SkinSurface& rest, const Height& height) const {
    const Vec3 before = strand.made.col(k - 1).cast<double>();
    const std::optional<SkinHeight> over = height(0.5 * (before + point));
    if (!is_low(over, 0.0)) return false;
    const Vec3 middle = 0.5 * (point_of(strand.rest, k - 1) + point_of(strand.rest, k));
    const double missing = std::min(0.0, rest_height(rest, middle)) - over->height;
    if (!(missing > kLiftSlack)) return false;
    point += 2.0 * missing * over->normal;
    return true;
}

// Points that seem to lie too low are compared with their height at rest. `free` is the least
// distance from the skin that the point before can have.
void StrandLift::out_of(const SkinSurface& skin, const SkinSurface& rest,
                        LiftedStrand strand) const {
    Vec3 old = strand.made.col(0).cast<double>();
    bool pushed = false;
    double free = 0.0;
    for (Index k = 1; k < index_of(strand.made.cols()); ++k) {
        const Vec3 before = strand.made.col(k - 1).cast<double>();
        const Vec3 target = strand.made.col(k).cast<double>();
        const double size = (target - old).norm(), floor = floor_at(strand.arcs[at(k)]);
        old = target;
        Vec3 point = pushed ? drawn_point(strand, k, size) : target;
        const double free_before = free;
        free -= (point - before).norm();
        if (!pushed && free > floor) continue;
        const double reach = std::max(kLookReach, size + floor);
        const auto height = [&](const Vec3& p) { return skin.height(p, reach); };
        const std::optional<SkinHeight> over = height(point);
        free = over ? std::abs(over->height) : reach;
        bool moved = false;
        if (is_low(over, floor)) {
            const double least = std::min(floor, rest_height(rest, point_of(strand.rest, k)));
            moved = is_low(over, least) && raise(strand, k, point, least, height);
        }
        if (std::max(free, free_before) < 0.5 * size) {
            moved = raise_middle(strand, k, point, rest, height) || moved;
        }
        if (moved) free = 0.0;
        if (moved || pushed) strand.made.col(k) = point.cast<float>();
        pushed = moved || (pushed && (point - target).norm() > kLiftSlack);
    }
}

}  // namespace lissom
