#include "kernel/hair/curve/hint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "kernel/hair/curve/length_text.h"

namespace lissom {
namespace {

// Segments of a join.
constexpr int kJoinSegments = 8;
// Lengths that are a smaller part of a curve than this are none.
constexpr double kTiny = 1e-9;

void require_hint(const HintOptions& o) {
    if (o.reach >= 0.0 && std::isfinite(o.reach) && o.join >= 0.0 && std::isfinite(o.join)) return;
    throw Error(ErrorCode::invalid_argument, "reach and join of a hint must be 0 or more");
}

// A curve with places on it by arc length.
struct Path {
    std::vector<Vec3> points, tangents;
    std::vector<double> lengths;

    explicit Path(std::span<const Vec3> given) {
        require_curve(given);
        points = without_repeated_points(given);
        tangents = curve_tangents(points);
        lengths = arc_lengths(points);
    }

    double length() const { return lengths.back(); }
    Vec3 at(double place) const { return point_at_arc_length(points, lengths, place); }
    Vec3 tangent(double place) const {
        const Vec3 mean = point_at_arc_length(tangents, lengths, place);
        return mean.norm() > 0.0 ? Vec3(mean.normalized()) : mean;
    }
    Path reversed() const { return Path(std::vector<Vec3>(points.rbegin(), points.rend())); }
};

// A place on a curve and how far a hint is from there.
struct Meeting {
    double place = 0.0, distance = 0.0;
};

Meeting meeting_at(const Path& curve, const Vec3& point) {
    const CurveFoot foot = foot_on_curve(curve.points, point);
    return {arc_length_at(curve.lengths, foot), foot.distance};
}

// Where a hint crosses a curve or comes nearest to it; of several places the first.
Meeting crossing(const Path& curve, const Path& hint) {
    Meeting best{0.0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
        const Vec3 &a = curve.points[i], &b = curve.points[i + 1];
        for (std::size_t j = 0; j + 1 < hint.points.size(); ++j) {
            const Vec3 &c = hint.points[j], &d = hint.points[j + 1];
            const Vec2 share = nearest_shares(a, b, c, d);
            const double distance = segment_distance(a, b, c, d);
            if (!(distance < best.distance)) continue;
            const double segment = curve.lengths[i + 1] - curve.lengths[i];
            best = {curve.lengths[i] + share.x() * segment, distance};
        }
    }
    return best;
}

void require_near(const Meeting& meeting, const HintOptions& options, const char* what) {
    if (meeting.distance <= options.reach) return;
    throw Error(ErrorCode::out_of_range, std::string(what) + " " + length_text(meeting.distance) +
                                             " m away from the curve, and " +
                                             length_text(options.reach) +
                                             " m is the most; draw it nearer, or set reach");
}

// A cubic from one point to another that leaves and arrives along unit tangents; without its first
// point.
void append_join(const Vec3& from, const Vec3& leaving, const Vec3& to, const Vec3& arriving,
                 std::vector<Vec3>& points) {
    const double size = (to - from).norm();
    if (!(size > 0.0)) return;
    for (int k = 1; k <= kJoinSegments; ++k) {
        const double t = static_cast<double>(k) / kJoinSegments, s = 1.0 - t;
        points.push_back(s * s * (1.0 + 2.0 * t) * from + s * s * t * size * leaving +
                         t * t * (1.0 + 2.0 * s) * to - t * t * s * size * arriving);
    }
}

// The part of a path between two places, without its first point.
void append_part(const Path& path, double from, double to, std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        if (path.lengths[i] > from && path.lengths[i] < to) points.push_back(path.points[i]);
    }
    if (to > from) points.push_back(path.at(to));
}

// A place of one path joined to a place of another, beginning where `points` end.
void append_join(const Path& first, double leave, const Path& second, double arrive,
                 std::vector<Vec3>& points) {
    append_join(first.at(leave), first.tangent(leave), second.at(arrive), second.tangent(arrive),
                points);
}

}  // namespace

HintOperation hint_operation(std::span<const Vec3> curve, std::span<const Vec3> hint,
                             const HintOptions& options) {
    require_hint(options);
    const Path path(curve), stroke(hint);
    const bool starts = meeting_at(path, stroke.points.front()).distance <= options.reach;
    const bool ends = meeting_at(path, stroke.points.back()).distance <= options.reach;
    if (starts) return ends ? HintOperation::insert : HintOperation::concatenate;
    require_near(crossing(path, stroke), options, "the hint passes");
    return HintOperation::cut;
}

std::vector<Vec3> cut_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                            const HintOptions& options) {
    require_hint(options);
    const Path path(curve), stroke(hint);
    const Meeting end = crossing(path, stroke);
    require_near(end, options, "the hint passes");
    if (!(end.place > kTiny * path.length())) {
        throw Error(ErrorCode::invalid_argument,
                    "the hint cuts the curve off at its first point; remove the curve instead");
    }
    std::vector<Vec3> result{path.points.front()};
    append_part(path, 0.0, end.place, result);
    return result;
}

std::vector<Vec3> concatenated_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                     const HintOptions& options) {
    require_hint(options);
    const Path path(curve), stroke(hint);
    const Meeting start = meeting_at(path, stroke.points.front());
    require_near(start, options, "the hint starts");
    const double leave = std::max(0.0, start.place - options.join);
    const double arrive = std::min(stroke.length(), options.join);

    std::vector<Vec3> result{path.points.front()};
    append_part(path, 0.0, leave, result);
    append_join(path, leave, stroke, arrive, result);
    append_part(stroke, arrive, stroke.length(), result);
    return result;
}

std::vector<Vec3> inserted_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                 const HintOptions& options) {
    require_hint(options);
    const Path path(curve);
    Path stroke(hint);
    Meeting start = meeting_at(path, stroke.points.front());
    Meeting end = meeting_at(path, stroke.points.back());
    require_near(start, options, "the hint starts");
    require_near(end, options, "the hint ends");
    if (std::abs(end.place - start.place) <= kTiny * path.length()) {
        throw Error(ErrorCode::invalid_argument,
                    "the hint starts and ends at one place of the curve; draw it longer");
    }
    if (end.place < start.place) {
        std::swap(start, end);
        stroke = stroke.reversed();
    }
    const double leave = std::max(0.0, start.place - options.join);
    const double back = std::min(path.length(), end.place + options.join);
    const double join = std::min(options.join, 0.5 * stroke.length());

    std::vector<Vec3> result{path.points.front()};
    append_part(path, 0.0, leave, result);
    append_join(path, leave, stroke, join, result);
    append_part(stroke, join, stroke.length() - join, result);
    append_join(stroke, stroke.length() - join, path, back, result);
    append_part(path, back, path.length(), result);
    return result;
}

}  // namespace lissom
