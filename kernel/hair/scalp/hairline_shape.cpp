#include "kernel/hair/scalp/hairline_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/roots.h"
#include "kernel/hair/scalp/hairline.h"

namespace lissom {
namespace {

// Mean distance of the hairline from the middle of an average head, in metres.
constexpr double kHairlineRadius = 0.1;
// Degrees between the points of a changed hairline, and over which a drawn one runs into the rest.
constexpr int kHairlineStep = 2;
constexpr double kDrawnBlend = 10.0;
// Of a hairline, in degrees.
constexpr double kLowestElevation = -85.0, kHighestElevation = 89.0;

double rising_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Returns 1 between the middle two of four ascending azimuths, and 0 outside the others.
double within(const std::array<double, 4>& ends, double x) {
    return rising_step(ends[0], ends[1], x) * (1.0 - rising_step(ends[2], ends[3], x));
}

// Metres by which the line rises at an azimuth of 0 to 180 degrees.
double rise_at(const HairlineShape& shape, double azimuth) {
    const double peak = std::pow(std::max(1.0 - azimuth / 14.0, 0.0), 1.4);
    return shape.forehead * (1.0 - rising_step(34.0, 64.0, azimuth)) +
           shape.recession * within({8.0, 34.0, 44.0, 66.0}, azimuth) - shape.peak * peak -
           shape.sideburns * within({66.0, 74.0, 85.0, 89.0}, azimuth) -
           shape.nape * rising_step(116.0, 145.0, azimuth);
}

// A line that wanders between -1 and 1, the same on every head: waves of whole numbers around it,
// so that it closes at the back.
double wandering(double azimuth) {
    constexpr std::array<double, 5> kWaves{7.0, 11.0, 17.0, 27.0, 41.0};
    double sum = 0.0;
    for (std::size_t i = 0; i < kWaves.size(); ++i) {
        sum += std::sin(kWaves[i] * azimuth * kDegree + 2.1 * static_cast<double>(i)) /
               (1.5 + static_cast<double>(i));
    }
    return sum / 1.6;
}

void require_shape(const HairlineShape& shape) {
    for (const double x :
         {shape.forehead, shape.recession, shape.peak, shape.sideburns, shape.nape}) {
        require(std::abs(x) <= kMaxHairlineChange,
                "a change of the hairline must lie between -0.1 and 0.1 metres");
    }
    require(shape.irregular >= 0.0 && shape.irregular <= kMaxHairlineChange,
            "an irregular hairline must wander by 0 to 0.1 metres");
}

HairlinePoint hairline_point(double azimuth, double elevation) {
    return {azimuth * kDegree,
            std::clamp(elevation, kLowestElevation, kHighestElevation) * kDegree};
}

// A drawn line as ascending azimuths of which each has one elevation, in degrees.
std::vector<HairlinePoint> directions_of(std::span<const Vec3> line) {
    std::vector<HairlinePoint> places;
    double turns = 0.0;
    for (const Vec3& p : line) {
        if (!p.allFinite()) throw Error(ErrorCode::not_finite, "a drawn hairline is not finite");
        double azimuth = std::atan2(p.x(), p.z()) / kDegree + turns;
        // A line across the back goes on beyond half a turn.
        if (!places.empty()) {
            const double jump = azimuth - places.back().azimuth;
            const double back = -360.0 * std::round(jump / 360.0);
            azimuth += back;
            turns += back;
        }
        places.push_back({azimuth, std::atan2(p.y(), hypotenuse(p.x(), p.z())) / kDegree});
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.azimuth < b.azimuth; });
    const auto same = [](const auto& a, const auto& b) { return b.azimuth - a.azimuth < 1e-6; };
    places.erase(std::unique(places.begin(), places.end(), same), places.end());
    require(places.size() >= 2 && places.back().azimuth - places.front().azimuth > 1.0,
            "a drawn hairline must run around the head, over a degree at least; draw it along the "
            "edge of the hair");
    return places;
}

// Elevation of a drawn line at an azimuth, degrees; beyond its ends that of the nearest.
double drawn_elevation(const std::vector<HairlinePoint>& drawn, double azimuth) {
    const auto next = std::lower_bound(drawn.begin(), drawn.end(), azimuth,
                                       [](const auto& p, double x) { return p.azimuth < x; });
    if (next == drawn.begin()) return next->elevation;
    if (next == drawn.end()) return drawn.back().elevation;
    const HairlinePoint& before = *(next - 1);
    const double part = (azimuth - before.azimuth) / (next->azimuth - before.azimuth);
    return before.elevation + part * (next->elevation - before.elevation);
}

// The azimuth nearest to the drawing of those that name one direction.
double turned_to(const std::vector<HairlinePoint>& drawn, double azimuth) {
    const double middle = 0.5 * (drawn.front().azimuth + drawn.back().azimuth);
    return middle + std::remainder(azimuth - middle, 360.0);
}

// Returns how far a direction belongs to the drawing, 0 to 1.
double share_of_drawing(const std::vector<HairlinePoint>& drawn, double azimuth) {
    const double first = drawn.front().azimuth, last = drawn.back().azimuth;
    return within({first - kDrawnBlend, first, last, last + kDrawnBlend}, azimuth);
}

}  // namespace

std::vector<HairlinePoint> shaped_hairline(const std::vector<HairlinePoint>& hairline,
                                           const HairlineShape& shape) {
    require_hairline(hairline);
    require_shape(shape);
    if (shape == HairlineShape{}) return hairline;
    std::vector<HairlinePoint> result;
    const bool both_sides = hairline.front().azimuth < 0.0 || shape.irregular > 0.0;
    for (int a = both_sides ? -180 : 0; a <= 180; a += kHairlineStep) {
        const double height = rise_at(shape, std::abs(a)) + shape.irregular * wandering(a);
        const double rise = height / kHairlineRadius;
        const double elevation = hairline_elevation(hairline, a * kDegree) + rise;
        result.push_back(hairline_point(a, elevation / kDegree));
    }
    return result;
}

std::vector<HairlinePoint> drawn_hairline(const std::vector<HairlinePoint>& hairline,
                                          std::span<const Vec3> line) {
    require_hairline(hairline);
    const std::vector<HairlinePoint> drawn = directions_of(line);
    const double first = drawn.front().azimuth, last = drawn.back().azimuth;
    const bool both = first >= 0.0 && last <= 180.0, mirrored = first >= -180.0 && last <= 0.0;
    const bool alike = (both || mirrored) && hairline.front().azimuth >= 0.0;
    std::vector<HairlinePoint> result;
    for (int a = alike ? 0 : -180; a <= 180; a += kHairlineStep) {
        const double before = hairline_elevation(hairline, a * kDegree) / kDegree;
        const double at = turned_to(drawn, alike && mirrored ? -a : a);
        const double share = share_of_drawing(drawn, at);
        result.push_back(hairline_point(a, before + share * (drawn_elevation(drawn, at) - before)));
    }
    return result;
}

}  // namespace lissom
