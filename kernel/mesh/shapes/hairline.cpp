#include "kernel/mesh/shapes/hairline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lissom {
namespace {

double smooth_unit(double t) {
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

std::vector<HairlinePoint> default_hairline() {
    std::vector<HairlinePoint> points;
    const std::vector<std::pair<double, double>> degrees = {
        {0, 35}, {20, 36},  {38, 35}, {52, 27},   {62, 12},   {70, -2},   {76, -10}, {81, -6},
        {86, 8}, {100, 10}, {112, 6}, {122, -12}, {135, -32}, {155, -42}, {180, -45}};
    for (const auto& [azimuth, elevation] : degrees) {
        points.push_back({azimuth * kDegree, elevation * kDegree});
    }
    return points;
}

double hairline_elevation(const std::vector<HairlinePoint>& hairline, double azimuth) {
    const double at = std::abs(std::remainder(azimuth, 2.0 * kPi));
    const auto next = std::find_if(hairline.begin(), hairline.end(),
                                   [&](const HairlinePoint& p) { return p.azimuth > at; });
    if (next == hairline.begin()) return next->elevation;
    if (next == hairline.end()) return hairline.back().elevation;
    const HairlinePoint &a = *std::prev(next), &b = *next;
    const double t = smooth_unit((at - a.azimuth) / (b.azimuth - a.azimuth));
    return a.elevation + t * (b.elevation - a.elevation);
}

}  // namespace lissom
