#include "viewer/render/draw/image/colormap.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

constexpr int kIntervals = 8;

constexpr std::array<Color, kIntervals + 1> kControlPoints{{
    {0.267, 0.005, 0.329},
    {0.278, 0.176, 0.482},
    {0.231, 0.322, 0.545},
    {0.173, 0.447, 0.557},
    {0.129, 0.569, 0.549},
    {0.157, 0.682, 0.502},
    {0.369, 0.788, 0.384},
    {0.678, 0.863, 0.188},
    {0.993, 0.906, 0.145},
}};

// Catmull-Rom spline through b and c.
double spline(double a, double b, double c, double d, double t) {
    const double slope_b = 0.5 * (c - a), slope_c = 0.5 * (d - b);
    const double cubic = 2.0 * (b - c) + slope_b + slope_c;
    const double square = 3.0 * (c - b) - 2.0 * slope_b - slope_c;
    return std::clamp(b + t * (slope_b + t * (square + t * cubic)), 0.0, 1.0);
}

}  // namespace

Color colormap(double t) {
    const double at = kIntervals * std::clamp(t, 0.0, 1.0);
    const int i = std::min(static_cast<int>(at), kIntervals - 1);
    const auto point = [i](int offset) {
        return kControlPoints[std::clamp(i + offset, 0, kIntervals)];
    };
    const Color a = point(-1), b = point(0), c = point(1), d = point(2);
    const double u = at - i;
    return {spline(a.r, b.r, c.r, d.r, u), spline(a.g, b.g, c.g, d.g, u),
            spline(a.b, b.b, c.b, d.b, u)};
}

}  // namespace lissom
