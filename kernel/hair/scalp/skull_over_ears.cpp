#include "kernel/hair/scalp/skull_over_ears.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/index.h"
#include "kernel/core/roots.h"

namespace lissom {
namespace {

// The skull is measured so high, and counts as skull up to so many ellipses: an ear that reaches
// higher is wider.
constexpr double kOverEars = 17.0 * kDegree, kWidestSkull = 1.15;

double ray_azimuth(int ray, int rays) {
    return SkullOverEars::kFront +
           (SkullOverEars::kBack - SkullOverEars::kFront) * ray / (rays - 1);
}

}  // namespace

double SkullOverEars::ellipses(const HeadFrame& frame, const Vec3& point) {
    return 2.0 * hypotenuse(point.x() / frame.width, point.z() / frame.length);
}

SkullOverEars::SkullOverEars(const SpatialTree& head, const HeadFrame& frame) {
    for (int ray = 0; ray < kRays; ++ray) {
        for (const bool left : {false, true}) {
            const double azimuth = (left ? 1.0 : -1.0) * ray_azimuth(ray, kRays);
            const double flat = std::cos(kOverEars);
            const Vec3 direction = frame.axes * Vec3(flat * std::sin(azimuth), std::sin(kOverEars),
                                                     flat * std::cos(azimuth));
            const auto hit = head.pick(frame.center, direction);
            const double radius = hit ? ellipses(frame, frame.local(hit->position)) : 1.0;
            radii_[at(ray)][left] = radius > kWidestSkull ? 1.0 : std::max(radius, 1.0);
        }
    }
}

double SkullOverEars::radius_at(const Vec3& point) const {
    const double azimuth = std::abs(std::atan2(point.x(), point.z()));
    const double place = std::clamp((azimuth - kFront) / (kBack - kFront), 0.0, 1.0) * (kRays - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), at(kRays - 2));
    const std::size_t side = point.x() > 0.0 ? 1 : 0;
    const double part = place - static_cast<double>(below);
    return radii_[below][side] + part * (radii_[below + 1][side] - radii_[below][side]);
}

}  // namespace lissom
