#include "kernel/sketch/stroke_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr std::size_t kPointsBetweenChecks = 64;

void require_points(std::span<const Vec2> stroke) {
    for (const Vec2& p : stroke) {
        if (!p.allFinite())
            throw Error(ErrorCode::not_finite, "a point of the stroke is not finite");
    }
    if (stroke.empty())
        throw Error(ErrorCode::invalid_argument, "a stroke needs at least one point");
}

// Surface seen at a pixel: the depth of the first surface there, whether it may be drawn on, and
// whether it is seen from behind. A part of a surface, such as hair grows on, has one side alone.
struct Seen {
    double depth = kNothing;
    bool counts = false, from_behind = false;
};

Seen look(const Vec2& pixel, const View& view, const DrawnSurface& surface) {
    const Ray ray = view.ray(pixel);
    const auto hit = surface.tree.pick(ray.origin, ray.direction);
    if (!hit) return {};
    const bool all = surface.faces.empty();
    const bool from_behind = !all && hit->normal.dot(ray.direction) > 0.0;
    return {view.camera.to_camera(hit->position).z(),
            all || (surface.faces[hit->face] != 0 && !from_behind), from_behind};
}

std::vector<Seen> look_along(std::span<const Vec2> stroke, const View& view,
                             const DrawnSurface& surface, const Context& context) {
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        if (i % kPointsBetweenChecks == 0) context.checkpoint();
        seen.push_back(look(stroke[i], view, surface));
    }
    return seen;
}

[[noreturn]] void refuse_start(const Seen& start) {
    if (!start.from_behind && !std::isfinite(start.depth)) {
        throw Error(ErrorCode::out_of_range,
                    "the stroke starts beside the surface; start it on the surface");
    }
    throw Error(ErrorCode::invalid_argument,
                start.from_behind
                    ? "the stroke starts on the inside of the surface: the camera is in the head, "
                      "or looks through a hole; move it out, and start on the outside"
                    : "the stroke starts on a part that is not to be drawn on; start on the marked "
                      "region, or look at it from another side");
}

// Returns the depth of each point on the surface to be drawn on, or of the last such point; the
// first one counts.
std::vector<double> carried_depths(std::span<const Seen> seen) {
    std::vector<double> depths;
    double last = seen.front().depth;
    for (const Seen& one : seen) {
        if (one.counts) last = one.depth;
        depths.push_back(last);
    }
    return depths;
}

// ---- the envelope

// Returns the pixel within reach, nearest first in rings, at which the surface may be drawn on.
std::optional<Vec2> nearest_start(const Vec2& pixel, const View& view, const DrawnSurface& surface,
                                  double reach) {
    constexpr double kRing = 2.0;
    for (double radius = kRing; radius <= reach; radius += kRing) {
        const int count = static_cast<int>(std::ceil(2.0 * kPi * radius / kRing));
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * kPi * i / count;
            const Vec2 near = pixel + radius * Vec2(std::cos(angle), std::sin(angle));
            if (look(near, view, surface).counts) return near;
        }
    }
    return std::nullopt;
}

// Returns the stroke from its first point on the region: within reach of the start, else with the
// nearest pixel before it.
std::vector<Vec2> with_start(std::span<const Vec2> stroke, const View& view,
                             const DrawnSurface& surface, double reach) {
    const Seen start = look(stroke.front(), view, surface);
    std::size_t i = 0;
    while (i < stroke.size() && (stroke[i] - stroke.front()).norm() <= reach) {
        if (look(stroke[i], view, surface).counts) return {stroke.begin() + i, stroke.end()};
        ++i;
    }
    const auto near = nearest_start(stroke.front(), view, surface, reach);
    if (!near) refuse_start(start);
    std::vector<Vec2> result{*near};
    result.insert(result.end(), stroke.begin(), stroke.end());
    return result;
}

// Lengths along the stroke in the world, as seen at the depth of each point.
std::vector<double> screen_lengths(std::span<const Vec2> stroke, std::span<const double> depths,
                                   const View& view) {
    std::vector<double> lengths(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const double pixel = view.pixel_length(0.5 * (depths[i] + depths[i - 1]));
        lengths[i] = lengths[i - 1] + pixel * (stroke[i] - stroke[i - 1]).norm();
    }
    return lengths;
}

// Lowers depths until they change no faster than `slope` along the lengths.
void bound_slope(std::vector<double>& depths, std::span<const double> lengths, double slope) {
    const auto lower = [&](std::size_t i, std::size_t by) {
        depths[i] = std::min(depths[i], depths[by] + slope * std::abs(lengths[i] - lengths[by]));
    };
    for (std::size_t i = 1; i < depths.size(); ++i) lower(i, i - 1);
    for (std::size_t i = depths.size() - 1; i-- > 0;) lower(i, i + 1);
}

// A box average as wide as the ends are far, so that these stay.
std::vector<double> averaged(std::span<const double> depths, std::span<const Vec2> stroke,
                             double width) {
    std::vector<double> places(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        places[i] = places[i - 1] + (stroke[i] - stroke[i - 1]).norm();
    }
    std::vector<double> result(depths.begin(), depths.end());
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const double half = std::min({0.5 * width, places[i], places.back() - places[i]});
        double sum = 0.0, count = 0.0;
        for (std::size_t j = i; j < depths.size() && places[j] <= places[i] + half; ++j) {
            sum += depths[j], ++count;
        }
        for (std::size_t j = i; j-- > 0 && places[j] >= places[i] - half;) {
            sum += depths[j], ++count;
        }
        result[i] = sum / count;
    }
    return result;
}

// Moves a point towards the viewer until the head is as far away as the clearance.
double cleared(double depth, const Vec2& pixel, const View& view, const SpatialTree& head,
               double clearance) {
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i) {
        const Vec3 point = view.camera.unproject({pixel.x(), pixel.y(), depth}, view.size);
        const auto near = head.nearest_within(point, clearance);
        if (!near) break;
        depth -= std::max(clearance - near->distance, 0.1 * clearance);
    }
    return depth;
}

void require_envelope(const EnvelopeOptions& o) {
    for (const double length : {o.lift, o.rise, o.clearance, o.averages, o.snap}) {
        if (std::isfinite(length) && length >= 0.0) continue;
        throw Error(ErrorCode::invalid_argument, "a length of the envelope is negative");
    }
    if (std::isfinite(o.metre) && o.metre > 0.0 && o.slope > 0.0) return;
    throw Error(ErrorCode::invalid_argument,
                "the metre and slope of the envelope must be positive");
}

double risen(double length, double rise) {
    if (rise == 0.0) return length > 0.0 ? 1.0 : 0.0;
    const double t = std::clamp(length / rise, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

std::vector<Vec3> at_depths(std::span<const Vec2> stroke, std::span<const double> depths,
                            const View& view) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        points.push_back(
            view.camera.unproject({stroke[i].x(), stroke[i].y(), depths[i]}, view.size));
    }
    return points;
}

std::vector<Vec3> stroke_on_plane(std::span<const Vec2> stroke, const View& view, const Vec3& point,
                                  const Vec3& normal) {
    require_points(stroke);
    if (!point.allFinite() || !normal.allFinite()) {
        throw Error(ErrorCode::not_finite, "the plane of a stroke is not finite");
    }
    if (normal.isZero(0.0))
        throw Error(ErrorCode::invalid_argument, "the plane's normal has no length");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const Ray ray = view.ray(stroke[i]);
        const double along = (point - ray.origin).dot(normal) / ray.direction.dot(normal);
        if (!std::isfinite(along) || along < 0.0) {
            throw Error(
                ErrorCode::invalid_argument,
                "point " + std::to_string(i + 1) +
                    " of the stroke does not meet the plane in front of the camera; turn the "
                    "view towards the plane");
        }
        points.emplace_back(ray.origin + along * ray.direction);
    }
    return points;
}

std::vector<Vec3> stroke_on_surface(std::span<const Vec2> stroke, const View& view,
                                    const DrawnSurface& surface, double lift,
                                    const Context& context) {
    require_points(stroke);
    const std::vector<Seen> seen = look_along(stroke, view, surface, context);
    if (!seen.front().counts) refuse_start(seen.front());
    std::vector<double> depths = carried_depths(seen);
    for (double& depth : depths) depth -= lift;
    return at_depths(stroke, depths, view);
}

std::vector<Vec3> stroke_over_head(std::span<const Vec2> drawn, const View& view,
                                   const DrawnSurface& head, const EnvelopeOptions& options,
                                   const Context& context) {
    require_points(drawn);
    require_envelope(options);
    const std::vector<Vec2> stroke = with_start(drawn, view, head, options.snap);
    const std::vector<Seen> seen = look_along(stroke, view, head, context);
    const std::vector<double> region = carried_depths(seen);
    const std::vector<double> lengths = screen_lengths(stroke, region, view);
    const double metre = options.metre;
    const auto share = [&](std::size_t i) { return risen(lengths[i], options.rise * metre); };
    const auto clearance = [&](std::size_t i) { return share(i) * options.clearance * metre; };
    const auto keep_off = [&](std::vector<double>& depths) {
        for (std::size_t i = 0; i < depths.size(); ++i) {
            depths[i] = std::min(depths[i], seen[i].depth - clearance(i));
        }
    };

    std::vector<double> depths = region;
    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] -= share(i) * options.lift * metre;
    keep_off(depths);
    bound_slope(depths, lengths, options.slope);
    for (int pass = 0; pass < 2; ++pass) depths = averaged(depths, stroke, options.averages);
    keep_off(depths);
    depths.front() = seen.front().depth;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (i % kPointsBetweenChecks == 0) context.checkpoint();
        if (clearance(i) > 0.0) {
            depths[i] = cleared(depths[i], stroke[i], view, head.tree, clearance(i));
        }
    }
    return at_depths(stroke, depths, view);
}

}  // namespace lissom
