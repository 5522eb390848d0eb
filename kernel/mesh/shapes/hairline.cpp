#include "kernel/mesh/shapes/hairline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/geometry.h"

namespace lissom {
namespace {

double slope_between(const HairlinePoint& a, const HairlinePoint& b) {
    return (b.elevation - a.elevation) / (b.azimuth - a.azimuth);
}

// Returns the slope at a point, so that the line is smooth and rises and falls as its points do
// (Fritsch and Butland 1984); level at the ends, which meet their mirror image or each other.
double slope_at(const std::vector<HairlinePoint>& hairline, std::size_t i) {
    if (i == 0 || i + 1 == hairline.size()) return 0.0;
    const double before = slope_between(hairline[i - 1], hairline[i]);
    const double after = slope_between(hairline[i], hairline[i + 1]);
    return before * after > 0.0 ? 2.0 * before * after / (before + after) : 0.0;
}

}  // namespace

std::vector<HairlinePoint> default_hairline() {
    std::vector<HairlinePoint> points;
    const std::vector<std::pair<double, double>> degrees = {
        {0, 35},    {20, 36},   {38, 35},   {52, 27},   {62, 12},  {70, -2},  {76, -11},
        {82, -13},  {86, -10},  {90, -3},   {95, 0},    {101, -1}, {106, -6}, {110, -14},
        {114, -23}, {121, -31}, {135, -38}, {155, -43}, {180, -45}};
    for (const auto& [azimuth, elevation] : degrees) {
        points.push_back({azimuth * kDegree, elevation * kDegree});
    }
    return points;
}

double hairline_elevation(const std::vector<HairlinePoint>& hairline, double azimuth) {
    const double turned = std::remainder(azimuth, 2.0 * kPi);
    const double at = hairline.front().azimuth < 0.0 ? turned : std::abs(turned);
    std::size_t next = 0;
    while (next < hairline.size() && hairline[next].azimuth <= at) ++next;
    if (next == 0) return hairline.front().elevation;
    if (next == hairline.size()) return hairline.back().elevation;
    const HairlinePoint &a = hairline[next - 1], &b = hairline[next];
    const double width = b.azimuth - a.azimuth, t = (at - a.azimuth) / width, u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * a.elevation + t * t * (1.0 + 2.0 * u) * b.elevation +
           t * u * width * (u * slope_at(hairline, next - 1) - t * slope_at(hairline, next));
}

}  // namespace lissom
