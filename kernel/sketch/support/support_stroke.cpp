#include "kernel/sketch/support/support_stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "kernel/core/error.h"
#include "kernel/sketch/stroke_depth.h"

namespace lissom {
namespace {

constexpr double kLeastSquare = 0.3;

void require_pixels(std::span<const Vec2> stroke) {
    if (stroke.empty())
        throw Error(ErrorCode::invalid_argument, "a stroke needs at least one point");
    for (const Vec2& p : stroke) {
        if (p.allFinite()) continue;
        throw Error(ErrorCode::not_finite, "a point of the stroke is not finite");
    }
}

using Hits = std::vector<SupportSurface::Hit>;

// Returns the hit that continues the last one along the curve; without a last one the nearest to
// it.
std::optional<SupportSurface::Hit> continued(const Hits& hits,
                                             const std::optional<SupportSurface::Hit>& last) {
    const auto cost = [&](const SupportSurface::Hit& hit) {
        if (!last) return std::abs(hit.across);
        return std::abs(hit.along - last->along) + std::abs(hit.across - last->across);
    };
    const auto best = std::min_element(
        hits.begin(), hits.end(), [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
    return best != hits.end() ? std::optional(*best) : std::nullopt;
}

// Depths along the view of the points that are over the surface, NaN for others.
std::vector<double> depths_over(std::span<const Vec2> stroke, const View& view,
                                const SupportSurface& support) {
    std::vector<double> depths;
    std::optional<SupportSurface::Hit> last;
    for (const Vec2& pixel : stroke) {
        const auto hit = continued(support.hits(view.ray(pixel)), last);
        if (hit) last = hit;
        depths.push_back(hit ? view.camera.to_camera(hit->position).z() : kNone);
    }
    return depths;
}

// Lengths along the stroke, in the world at one depth.
std::vector<double> lengths_at(std::span<const Vec2> stroke, double pixel) {
    std::vector<double> lengths(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        lengths[i] = lengths[i - 1] + pixel * (stroke[i] - stroke[i - 1]).norm();
    }
    return lengths;
}

// Extrapolates depth from the point `last`, which has one, in steps of `step` (1 or -1).
void extrapolate(std::vector<double>& depths, std::span<const double> lengths, int last, int step,
                 const SupportStrokeOptions& options) {
    const int count = count_of(depths);
    int before = last;
    const auto in_reach = [&](int i) {
        return i >= 0 && i < count && std::isfinite(depths[at(i)]) &&
               std::abs(lengths[at(i)] - lengths[at(last)]) <= options.run;
    };
    while (in_reach(before - step)) before -= step;
    const double way = std::abs(lengths[at(last)] - lengths[at(before)]);
    const double slope =
        way > 0.0 ? std::clamp((depths[at(last)] - depths[at(before)]) / way, -1.0, 1.0) : 0.0;
    for (int i = last + step; i >= 0 && i < count; i += step) {
        const double beyond = std::abs(lengths[at(i)] - lengths[at(last)]);
        const double share = options.fade > 0.0 ? 1.0 - std::exp(-beyond / options.fade) : 0.0;
        depths[at(i)] = depths[at(last)] + slope * options.fade * share;
    }
}

// Fills the gaps between points that have a depth evenly along the stroke.
void bridge(std::vector<double>& depths, std::span<const double> lengths) {
    std::size_t last = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (!std::isfinite(depths[i])) continue;
        for (std::size_t k = last + 1; k < i; ++k) {
            const double way = lengths[i] - lengths[last];
            const double t = way > 0.0 ? (lengths[k] - lengths[last]) / way : 0.0;
            depths[k] = (1.0 - t) * depths[last] + t * depths[i];
        }
        last = i;
    }
}

void require_seen(const SupportSurface& support, const View& view) {
    if (support.seen_from(view.camera) >= kLeastSquare) return;
    const bool ruled = support.mode() == SupportMode::ruled;
    throw Error(ErrorCode::invalid_argument,
                std::string("the supporting surface is seen edge-on from here; turn the view ") +
                    (ruled ? "away from the one that it was made for, or take the strip"
                           : "towards the one that it was made for, or take the ruled surface"));
}

// Depth of the place of a projected curve that is nearest to a pixel.
double depth_beside(const Vec2& pixel, std::span<const Vec3> curve) {
    double nearest = std::numeric_limits<double>::infinity(), depth = curve.front().z();
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Vec2 a = curve[i].head<2>(), side = curve[i + 1].head<2>() - a;
        const double square = side.squaredNorm();
        const double t = square > 0.0 ? std::clamp((pixel - a).dot(side) / square, 0.0, 1.0) : 0.0;
        const double distance = (pixel - a - t * side).squaredNorm();
        if (!(distance < nearest)) continue;
        nearest = distance;
        // With perspective 1 / depth is linear on the picture; segments are short.
        depth = (1.0 - t) * curve[i].z() + t * curve[i + 1].z();
    }
    return depth;
}

}  // namespace

SupportStroke stroke_on_support(std::span<const Vec2> stroke, const View& view,
                                const SupportSurface& support,
                                const SupportStrokeOptions& options) {
    require_pixels(stroke);
    require_seen(support, view);
    std::vector<double> depths = depths_over(stroke, view, support);
    const auto over = [](double depth) { return std::isfinite(depth); };
    const auto first = std::find_if(depths.begin(), depths.end(), over);
    if (first == depths.end()) {
        throw Error(ErrorCode::invalid_argument,
                    "the stroke is nowhere over the supporting surface; begin it at the curve");
    }
    const auto last = std::find_if(depths.rbegin(), depths.rend(), over).base() - 1;
    const auto beside = depths.size() - at(std::count_if(depths.begin(), depths.end(), over));
    const std::vector<double> lengths = lengths_at(stroke, view.pixel_length(*first));
    const int begin = index_of(first - depths.begin()), end = index_of(last - depths.begin());
    extrapolate(depths, lengths, begin, -1, options);
    extrapolate(depths, lengths, end, 1, options);
    bridge(depths, lengths);
    return {at_depths(stroke, depths, view), beside};
}

std::vector<Vec3> stroke_beside_curve(std::span<const Vec2> stroke, const View& view,
                                      std::span<const Vec3> curve) {
    require_pixels(stroke);
    std::vector<Vec3> seen;
    for (const Vec3& point : curve) {
        if (!point.allFinite()) throw Error(ErrorCode::not_finite, "the curve is not finite");
        seen.push_back(view.project(point));
        if (seen.back().allFinite()) continue;
        throw Error(ErrorCode::invalid_argument,
                    "the curve is partly behind the camera; step back until all of it is seen");
    }
    if (seen.size() < 2) throw Error(ErrorCode::invalid_argument, "a curve needs two points");
    std::vector<double> depths;
    for (const Vec2& pixel : stroke) depths.push_back(depth_beside(pixel, seen));
    return at_depths(stroke, depths, view);
}

}  // namespace lissom
