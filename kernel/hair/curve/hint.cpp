#include "kernel/hair/curve/hint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "kernel/hair/curve/length_text.h"

namespace lissom {
namespace {

// Step at which a hint is resampled, as a fraction of `near`.
constexpr double kHintSteps = 0.1;
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

// Returns the crossing of a hint and a curve, or their nearest points; the first of several.
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

// Appends a smooth join from a place of one path to a place of another, beginning at the end of
// `points`.
void append_join(const Path& first, double leave, const Path& second, double arrive,
                 std::vector<Vec3>& points) {
    append_join(first.at(leave), first.tangent(leave), second.at(arrive), second.tangent(arrive),
                points);
}

// A hint as seen from a curve.
struct HintShape {
    Meeting start, end;
    double length = 0.0, curve_length = 0.0;
    // Angle between the general direction and the curve's tangent towards the tip at the start of
    // the hint, degrees.
    double angle = 0.0;
    // The nearest that the hint comes.
    double least = 0.0;
    // Changes of side: arc length along the hint, and distance from the curve there.
    std::vector<Meeting> sides;
};

std::vector<Meeting> changes_of_side(const Path& curve, std::span<const Vec3> hint) {
    std::vector<Meeting> sides;
    const std::vector<double> lengths = arc_lengths(hint);
    for (std::size_t i = 1; i < hint.size(); ++i) {
        const CurveFoot foot = foot_on_curve(curve.points, hint[i]);
        if (foot.beyond != 0.0) continue;
        const Vec3 tangent = curve.tangent(arc_length_at(curve.lengths, foot));
        const Vec3 way = hint[i] - hint[i - 1];
        const Vec3 across = way - way.dot(tangent) * tangent;
        const double before = (hint[i - 1] - foot.point).dot(across),
                     after = (hint[i] - foot.point).dot(across);
        if (before < 0.0 && after >= 0.0) sides.push_back({lengths[i], foot.distance});
    }
    return sides;
}

HintShape shape_of(const Path& curve, const Path& hint, double near) {
    HintShape shape;
    shape.start = meeting_at(curve, hint.points.front());
    shape.end = meeting_at(curve, hint.points.back());
    shape.length = hint.length();
    shape.curve_length = curve.length();
    const Vec3 direction = hint.points.back() - hint.points.front();
    const Vec3 tangent = curve.tangent(shape.start.place);
    shape.angle = std::atan2(direction.cross(tangent).norm(), direction.dot(tangent)) * 180.0 / kPi;
    shape.least = crossing(curve, hint).distance;
    shape.sides = changes_of_side(curve, resampled_curve(hint.points, kHintSteps * near));
    return shape;
}

// How far along the hint it first crosses the curve.
std::optional<double> first_crossing(const HintShape& shape, double near) {
    for (const Meeting& side : shape.sides) {
        if (side.distance <= near) return side.place;
    }
    return std::nullopt;
}

// Returns the meaning of a hint for this `near`, if it were turned by `turn` degrees.
HintOperation operation_of(const HintShape& shape, double near, double turn = 0.0) {
    const std::optional<double> cross = first_crossing(shape, near);
    if (shape.start.distance <= near && shape.end.distance <= near) {
        const double apart = std::abs(shape.end.place - shape.start.place);
        if (apart >= std::max(1.2 * near, 0.15 * shape.length)) return HintOperation::insert;
        return cross || shape.length <= 3.0 * near ? HintOperation::cut
                                                   : HintOperation::concatenate;
    }
    if (shape.start.distance > near) return HintOperation::cut;
    const bool at_tip = shape.curve_length - shape.start.place <= near;
    if (at_tip || !cross || *cross > 1.2 * near) return HintOperation::concatenate;
    // Fitted to drawn hints, in pixels, of which `near` has 20.
    const double pixel = near / 20.0;
    const double across = (shape.angle + turn - 74.0) / 12.0 + (*cross / pixel - 10.0) / 8.0 -
                          (shape.length / pixel - 150.0) / 60.0;
    return across > 0.0 ? HintOperation::cut : HintOperation::concatenate;
}

// Returns the operations that the ends of a hint allow.
std::vector<HintOperation> possible_operations(const HintShape& shape, double near) {
    std::vector<HintOperation> possible;
    const bool starts = shape.start.distance <= near, ends = shape.end.distance <= near;
    const double apart = std::abs(shape.end.place - shape.start.place);
    if (starts) possible.push_back(HintOperation::concatenate);
    if (starts && ends && apart > kTiny * shape.curve_length) {
        possible.push_back(HintOperation::insert);
    }
    possible.push_back(HintOperation::cut);
    return possible;
}

// Variations for other meanings of a hint: factors of `near`, and turns in degrees.
constexpr std::pair<double, double> kOtherReadings[] = {
    {0.75, 0.0}, {1.3, 0.0}, {1.0, -12.0}, {1.0, 12.0}};

}  // namespace

HintReading hint_reading(std::span<const Vec3> curve, std::span<const Vec3> hint, double near) {
    if (!(near > 0.0 && std::isfinite(near))) {
        throw Error(ErrorCode::invalid_argument, "`near` of a hint must be a length above 0");
    }
    const HintShape shape = shape_of(Path(curve), Path(hint), near);
    if (shape.least > near) {
        std::ostringstream message;
        message.precision(3);
        message << "the hint passes " << shape.least << " away from the curve, and " << near
                << " is near; draw it nearer, or set near";
        throw Error(ErrorCode::out_of_range, message.str());
    }
    HintReading reading{operation_of(shape, near), true};
    const auto offer = [&](HintOperation operation) {
        auto& others = reading.others;
        if (operation == reading.operation) return;
        if (std::find(others.begin(), others.end(), operation) == others.end()) {
            others.push_back(operation);
        }
    };
    for (const auto& [factor, turn] : kOtherReadings) {
        const bool is_near = shape.least <= factor * near;
        if (is_near) offer(operation_of(shape, factor * near, turn));
        if (!is_near) reading.sure = false;
    }
    reading.sure = reading.sure && reading.others.empty();
    for (const HintOperation operation : possible_operations(shape, 1.3 * near)) offer(operation);
    return reading;
}

HintOperation hint_operation(std::span<const Vec3> curve, std::span<const Vec3> hint, double near) {
    return hint_reading(curve, hint, near).operation;
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
