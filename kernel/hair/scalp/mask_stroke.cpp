#include "kernel/hair/scalp/mask_stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

double squared_distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 side = b - a, from = point - a;
    const double square = side.squaredNorm();
    const double t = square > 0.0 ? std::clamp(from.dot(side) / square, 0.0, 1.0) : 0.0;
    return (from - t * side).squaredNorm();
}

double distance_to_way(const Vec3& point, std::span<const Vec3> way) {
    double least = (point - way.front()).squaredNorm();
    for (std::size_t i = 1; i < way.size(); ++i) {
        least = std::min(least, squared_distance_to_segment(point, way[i - 1], way[i]));
    }
    return std::sqrt(least);
}

// How much of the brush is felt this far from its way: 1 in the middle, 0 from the radius on.
double brush_share(const MaskStroke& stroke, double distance) {
    if (distance >= stroke.radius) return 0.0;
    const double fade = stroke.softness * stroke.radius, inside = stroke.radius - distance;
    if (inside >= fade) return 1.0;
    const double t = inside / fade;
    return t * t * (3.0 - 2.0 * t);
}

bool is_within(double value, double least, double most) {
    return value >= least && value <= most;
}

Box reach_of(const MaskStroke& stroke) {
    Box box;
    for (const Vec3& p : stroke.points) box.extend(p);
    box.min.array() -= stroke.radius;
    box.max.array() += stroke.radius;
    return box;
}

}  // namespace

void require_mask(const MaskStroke& stroke) {
    require(!stroke.points.empty(), "a mask is painted along one point or more");
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        if (stroke.points[i].allFinite()) continue;
        throw Error(ErrorCode::not_finite,
                    "point " + std::to_string(i + 1) + " of a mask is not finite",
                    {ElementKind::row, 1, {index_of(i)}});
    }
    const bool of_length = stroke.kind == MaskKind::length;
    require(is_within(stroke.value, 0.0, of_length ? kMaxLengthMask : 1.0),
            of_length ? "a mask of the length has values from 0 to 4"
                      : "a mask of the density has values from 0 to 1");
    require(stroke.radius > 0.0 && std::isfinite(stroke.radius),
            "the brush of a mask needs a radius above 0");
    require(is_within(stroke.softness, 0.0, 1.0), "the softness of a brush is from 0 to 1");
}

ScalpMask::ScalpMask(std::span<const MaskStroke> strokes, MaskKind kind) {
    for (const MaskStroke& stroke : strokes) {
        if (stroke.kind == kind) layers_.push_back({reach_of(stroke), stroke});
    }
}

double ScalpMask::at(const Vec3& point) const {
    double value = 1.0;
    for (const Layer& layer : layers_) {
        if (!layer.reach.contains(point)) continue;
        const double share = brush_share(layer.stroke, distance_to_way(point, layer.stroke.points));
        value += share * (layer.stroke.value - value);
    }
    return value;
}

}  // namespace lissom
