#include "kernel/hair/scalp/hairline.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/roots.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

constexpr double kMost = 1000.0;
// Share of the band in which hair thins out that lies below the hairline.
constexpr double kBelow = 1.0 / 6.0;

// Ears lie between these azimuths, below the elevation, and stand out from the skull above them by
// more than the share of its width.
constexpr double kEarFront = SkullOverEars::kFront, kEarBack = SkullOverEars::kBack;
constexpr double kEarTop = 14.0 * kDegree;
constexpr double kEarDepth = 4.0 / 155.0;
// Ears rise so steeply that what stands out by a length is as far again and more from their crease:
// skull that is level with that above it has all of its hair.
constexpr double kEarSlope = 4.0;
// Points farther from the axis than this many ellipses, or lower than this many widths, are neck or
// shoulder.
constexpr double kReach = 1.3, kLowest = 0.75;

// Points at the hairline have more than -kMost, which stands for skin without hair.
constexpr double kLeast = -0.999 * kMost;

double to_margin(double distance, double softness) {
    if (softness > 0.0) return std::clamp(distance / softness + kBelow, kLeast, kMost);
    return distance > 0.0 ? kMost : kLeast;
}

// Returns the angle above the hairline: the difference in elevation, larger at a steep line, over
// the length of its gradient.
double angle_above(const std::vector<HairlinePoint>& hairline, double azimuth, double elevation) {
    constexpr double kStep = 0.5 * kDegree;
    const double rise = hairline_elevation(hairline, azimuth + kStep) -
                        hairline_elevation(hairline, azimuth - kStep);
    const double steepness = rise / (2.0 * kStep * std::max(std::cos(elevation), 0.1));
    return (elevation - hairline_elevation(hairline, azimuth)) / hypotenuse(1.0, steepness);
}

// How far inside the hairline a point is, in the mesh's unit, negative outside.
double inside_hairline(const HairlineTest& test, const Vec3& p) {
    const HeadFrame& frame = test.frame;
    const double around = std::atan2(p.x(), p.z()), azimuth = std::abs(around);
    const double elevation = std::atan2(p.y(), hypotenuse(p.x(), p.z()));
    double inside = angle_above(test.hairline, around, elevation) * std::min(p.norm(), frame.width);
    const double radius = SkullOverEars::ellipses(frame, p);
    if (azimuth > kEarFront && azimuth < kEarBack && elevation < kEarTop) {
        const double out = radius - test.skull.radius_at(p);
        inside = std::min(inside, kEarSlope * frame.width * (kEarDepth - 0.5 * out));
    }
    if (radius > kReach || p.y() < -kLowest * frame.width) inside = -frame.width;
    return inside;
}

// Marks the vertices reachable from `start` over vertices with a set flag.
std::vector<char> reached(const Topology& topology, const std::vector<char>& flags, Index start) {
    std::vector<char> found(flags.size(), 0);
    std::vector<Index> open{start};
    found[start] = 1;
    while (!open.empty()) {
        const Index v = open.back();
        open.pop_back();
        for (const Index n : topology.neighbors(v)) {
            if (found[n] || !flags[n]) continue;
            found[n] = 1;
            open.push_back(n);
        }
    }
    return found;
}

}  // namespace

bool HairlineTest::inside(double margin) {
    return margin > kBelow;
}

bool HairlineTest::bald(double margin) {
    return margin <= -kMost;
}

double HairlineTest::margin_at(const Vec3& point) const {
    return to_margin(inside_hairline(*this, frame.local(point)), softness);
}

void require_hairline(const std::vector<HairlinePoint>& hairline) {
    double last = -4.0;
    for (const auto& [azimuth, elevation] : hairline) {
        const bool good = azimuth > last && std::abs(azimuth) <= kPi * (1.0 + 1e-12) &&
                          std::abs(elevation) <= 0.5 * kPi * (1.0 + 1e-12);
        if (!good) {
            throw Error(ErrorCode::invalid_argument,
                        "the hairline's azimuths must ascend within 0 and 180 degrees, or -180 and "
                        "180 if its sides differ, its elevations lie between -90 and 90");
        }
        last = azimuth;
    }
    if (hairline.empty()) {
        throw Error(ErrorCode::invalid_argument, "the hairline has no points");
    }
}

std::vector<double> margins_of_hairline(const Mesh& head, const std::vector<Vec3>& normals,
                                        const HairlineTest& test) {
    std::vector<double> margins(head.vertex_count(), -kMost);
    std::vector<char> inside(margins.size(), 0);
    Index top = kNoIndex;
    double height = 0.0;
    for (const Index v : largest_component(head)) {
        const Vec3 p = test.frame.local(head.position(v));
        if (normals[v].dot(head.position(v) - test.frame.center) <= 0.0) continue;
        margins[v] = test.margin_at(head.position(v));
        inside[v] = margins[v] > 0.0;
        if (!inside[v] || (top != kNoIndex && p.y() <= height)) continue;
        top = v;
        height = p.y();
    }
    if (top == kNoIndex) return margins;
    const std::vector<char> scalp = reached(head.topology(), inside, top);
    for (std::size_t v = 0; v < margins.size(); ++v) {
        if (inside[v] && !scalp[v]) margins[v] = -kMost;
    }
    return margins;
}

std::vector<double> margins_of_region(const Mesh& head, const Region& region, double softness) {
    std::vector<double> margins(head.vertex_count(), -kMost);
    const std::vector<char> in = region.mask();
    std::vector<Index> outline;
    for (const Index v : region.vertices()) {
        const auto ring = head.topology().neighbors(v);
        if (std::any_of(ring.begin(), ring.end(), [&](Index n) { return !in[n]; })) {
            outline.push_back(v);
        }
        margins[v] = kMost;
    }
    if (outline.empty() || !(softness > 0.0)) return margins;
    const std::vector<double> distance = edge_distances(head, outline, 4.0 * softness);
    for (const Index v : region.vertices()) {
        if (std::isfinite(distance[v])) margins[v] = distance[v] / softness;
    }
    return margins;
}

}  // namespace lissom
