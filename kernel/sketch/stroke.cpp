#include "kernel/sketch/stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/sketch/spline_fit.h"

namespace lissom {
namespace {

constexpr double kClickPixels = 6.0, kClickSeconds = 0.25;

// A piece at an end, no longer than this and than a share of the stroke, that turns by more than
// the angle against the rest, is a hook.
constexpr double kHookPixels = 10.0, kHookShare = 0.25, kHookTurn = 57.0 * kPi / 180.0;
// A shorter one is jitter.
constexpr double kMinHook = 3.0;

// Corners: the angle between chords before and after, on a softened course with even steps.
constexpr double kCornerSoftening = 3.0, kCornerStep = 2.0, kCornerTurn = kPi / 4.0;
constexpr Index kCornerChord = 8, kCornerLongChord = 16;
constexpr double kLongChordShare = 0.75;
// The lines whose meeting is the corner are fitted between these distances from it.
constexpr double kCornerLineStart = 6.0, kCornerLineEnd = 28.0, kCornerMove = 10.0;

constexpr std::array kKnotDistances = {90.0, 60.0, 40.0, 28.0, 20.0};
constexpr double kFitError = 2.0;
// Parameters of the fit come from a course that jitter has not made longer.
constexpr double kParameterSoftening = 4.0;

// Lists of a stroke: the events in logical pixels, the place along them of each.
struct Course {
    std::vector<Vec2> points;
    std::vector<double> places;

    double length() const { return places.back(); }
    // The point at a place, and the index of the one before with the share of the next.
    std::pair<std::size_t, double> find(double place) const;
    Vec2 at(double place) const;
};

std::vector<double> places_of(std::span<const Vec2> points) {
    std::vector<double> places(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        places[i] = places[i - 1] + (points[i] - points[i - 1]).norm();
    }
    return places;
}

Course course_of(std::vector<Vec2> points) {
    std::vector<double> places = places_of(points);
    return {std::move(points), std::move(places)};
}

std::pair<std::size_t, double> Course::find(double place) const {
    if (points.size() == 1) return {0, 0.0};
    const auto after = std::upper_bound(places.begin() + 1, places.end() - 1, place);
    const std::size_t i = after - places.begin() - 1;
    const double length = places[i + 1] - places[i];
    const double share = length > 0.0 ? (place - places[i]) / length : 0.0;
    return {i, std::clamp(share, 0.0, 1.0)};
}

Vec2 Course::at(double place) const {
    const auto [i, share] = find(place);
    return share == 0.0 ? points[i] : Vec2((1.0 - share) * points[i] + share * points[i + 1]);
}

// Points with even steps of about `step`, both ends kept.
Course with_even_steps(const Course& course, double step) {
    const double count = std::max(1.0, std::round(course.length() / step));
    std::vector<Vec2> points;
    for (double i = 0.0; i < count; ++i) points.push_back(course.at(course.length() * i / count));
    points.push_back(course.points.back());
    return course_of(std::move(points));
}

// The mean of a Gauss bell along the course. Near an end the bell is as narrow as the end is near,
// so that ends stay.
std::vector<Vec2> softened(const Course& course, double width, const Context& context) {
    std::vector<Vec2> result = course.points;
    std::size_t first = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double place = course.places[i];
        const double reach = std::min({3.0 * width, place, course.length() - place});
        if (reach <= 0.0) continue;
        context.checkpoint();  // there may be many points within reach
        while (course.places[first] < place - 3.0 * width) ++first;
        Vec2 sum = Vec2::Zero();
        double weights = 0.0;
        for (std::size_t j = first; j < course.points.size(); ++j) {
            const double x = course.places[j] - place;
            if (x > reach) break;
            const double weight = std::exp(-4.5 * x * x / (reach * reach));
            sum += weight * course.points[j];
            weights += weight;
        }
        result[i] = sum / weights;
    }
    return result;
}

double turn_between(const Vec2& a, const Vec2& b) {
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

// ---- hooks

// The number of points before the sharp turn that ends a hook at the start; 0 without one.
std::size_t hook_length(const Course& course) {
    const double reach = std::min(kHookPixels, kHookShare * course.length());
    std::size_t found = 0;
    double sharpest = kHookTurn;
    for (std::size_t i = 1; i + 1 < course.points.size() && course.places[i] <= reach; ++i) {
        const Vec2 before = course.points[i] - course.points.front();
        if (before.norm() < kMinHook) continue;
        const Vec2 after = course.at(course.places[i] + 2.0 * kHookPixels) - course.points[i];
        const double turn = turn_between(before, after);
        if (turn > sharpest) sharpest = turn, found = i;
    }
    return found;
}

Course reversed(const Course& course) {
    return course_of({course.points.rbegin(), course.points.rend()});
}

// Returns the first and last event without the hooks.
std::pair<std::size_t, std::size_t> without_hooks(const Course& course) {
    if (course.points.size() < 4) return {0, course.points.size() - 1};
    const std::size_t first = hook_length(course), last = hook_length(reversed(course));
    return {first, course.points.size() - 1 - last};
}

// ---- corners

// The turn at each point between chords of some steps to both sides; 0 near the ends.
std::vector<double> turns(std::span<const Vec2> points, Index chord) {
    std::vector<double> result(points.size(), 0.0);
    for (std::size_t i = chord; i + chord < points.size(); ++i) {
        result[i] = turn_between(points[i] - points[i - chord], points[i + chord] - points[i]);
    }
    return result;
}

// Returns whether no point within a chord turns more; the first of ties counts.
bool is_sharpest(const std::vector<double>& turns, std::size_t i) {
    const std::size_t chord = kCornerChord;
    const auto at = turns.begin();
    const auto before = std::max_element(at + (i > chord ? i - chord : 0), at + i);
    const auto after = std::max_element(at + i, at + std::min(turns.size(), i + chord + 1));
    return (before == at + i || *before < turns[i]) && *after <= turns[i];
}

// The centre and direction of the points of a course between two places.
std::pair<Vec2, Vec2> line_through(const Course& course, double from, double to) {
    Vec2 mean = Vec2::Zero();
    constexpr int kPoints = 12;
    std::array<Vec2, kPoints> points;
    for (int i = 0; i < kPoints; ++i) {
        points[i] =
            course.at(std::clamp(from + (to - from) * i / (kPoints - 1), 0.0, course.length()));
        mean += points[i] / kPoints;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Vec2& p : points) {
        const Vec2 d = p - mean;
        xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
    }
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    return {mean, {std::cos(angle), std::sin(angle)}};
}

// Returns the intersection of the lines to both sides of a place, if that is near; else the place
// itself.
Vec2 corner_point(const Course& course, double place) {
    const Vec2 seen = course.at(place);
    const auto [a, u] = line_through(course, place - kCornerLineEnd, place - kCornerLineStart);
    const auto [b, v] = line_through(course, place + kCornerLineStart, place + kCornerLineEnd);
    const double cross = u.x() * v.y() - u.y() * v.x();
    if (std::abs(cross) < 1e-3) return seen;
    const Vec2 d = b - a;
    const Vec2 meeting = a + (d.x() * v.y() - d.y() * v.x()) / cross * u;
    return (meeting - seen).norm() <= kCornerMove ? meeting : seen;
}

struct Corner {
    double place;
    Vec2 point;
};

std::vector<Corner> find_corners(const Course& course, const Context& context) {
    const Course even = with_even_steps(course, kCornerStep);
    const std::vector<Vec2> soft = softened(even, kCornerSoftening, context);
    const std::vector<double> sharp = turns(soft, kCornerChord),
                              wide = turns(soft, kCornerLongChord);
    std::vector<Corner> corners;
    for (std::size_t i = kCornerLongChord; i + kCornerLongChord < soft.size(); ++i) {
        if (sharp[i] < kCornerTurn || wide[i] < kLongChordShare * sharp[i]) continue;
        if (is_sharpest(sharp, i))
            corners.push_back({even.places[i], corner_point(course, even.places[i])});
    }
    return corners;
}

// ---- fitting

// The knots farthest apart that stay near enough to the points.
PlaneSpline fit_piece(const Course& piece, double smoothing, const Context& context) {
    const std::vector<double> soft = places_of(softened(piece, kParameterSoftening, context));
    std::vector<double> parameters(soft.size());
    for (std::size_t i = 0; i < soft.size(); ++i) {
        parameters[i] = soft.back() > 0.0 ? soft[i] / soft.back() : 0.0;
    }
    const CurveSamples samples{piece.points, parameters};
    const auto fit = [&](double distance) {
        return fit_spline(
            samples, std::max<Index>(1, static_cast<Index>(std::lround(soft.back() / distance))));
    };
    for (const double distance : kKnotDistances) {
        context.checkpoint();
        PlaneSpline spline = fit(distance);
        if (fit_error(spline, samples) <= kFitError * smoothing) return spline;
    }
    return fit(kKnotDistances.back());
}

// A piece between corners, resampled; its ends are exact.
std::vector<Vec2> fair_piece(const Course& piece, const StrokeOptions& options,
                             const Context& context) {
    constexpr int kFine = 8;
    if (piece.length() == 0.0) return {piece.points.front(), piece.points.back()};
    Course fine = piece;
    if (options.smoothing > 0.0 && piece.points.size() > 2) {
        const PlaneSpline spline = fit_piece(piece, options.smoothing, context);
        const int count = kFine * std::max(1, static_cast<int>(std::ceil(piece.length() / kFine)));
        std::vector<Vec2> points{piece.points.front()};
        for (int i = 1; i < count; ++i) points.push_back(spline.at(static_cast<double>(i) / count));
        points.push_back(piece.points.back());
        fine = course_of(std::move(points));
    }
    return with_even_steps(fine, options.spacing).points;
}

// The points of a course between two places, ends included, with given ends.
Course piece_between(const Course& course, const Corner& from, const Corner& to) {
    std::vector<Vec2> points{from.point};
    // Points nearer to a corner than its displacement would fold the piece back.
    const auto first = std::upper_bound(course.places.begin(), course.places.end(), from.place);
    const auto end = std::lower_bound(first, course.places.end(), to.place);
    const auto begin = course.points.begin();
    points.insert(points.end(), begin + (first - course.places.begin()),
                  begin + (end - course.places.begin()));
    points.push_back(to.point);
    return course_of(std::move(points));
}

// ---- events

void require_events(std::span<const StrokeEvent> events) {
    if (events.empty())
        throw Error(ErrorCode::invalid_argument, "a stroke needs at least one point");
    for (std::size_t i = 0; i < events.size(); ++i) {
        const StrokeEvent& event = events[i];
        if (event.pixel.allFinite() && std::isfinite(event.time) && std::isfinite(event.pressure))
            continue;
        throw Error(ErrorCode::not_finite,
                    "point " + std::to_string(i + 1) + " of the stroke is not finite");
    }
}

void require_scale(double scale) {
    if (std::isfinite(scale) && scale > 0.0) return;
    throw Error(ErrorCode::invalid_argument, "the scale of a stroke must be positive");
}

void require_options(const StrokeOptions& options) {
    require_scale(options.scale);
    if (!(options.spacing > 0.0 && options.smoothing >= 0.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "the spacing of a stroke must be positive and its smoothing 0 or more");
    }
}

// The memory of the points along a course in even steps. Errors: as fair_stroke.
MemoryCharge charge_points(const Course& course, const StrokeOptions& options,
                           const Context& context) {
    constexpr double kMostPoints = 3e7;
    constexpr std::size_t kBytes = 160;
    const double points = course.length() / std::min(kCornerStep, options.spacing);
    if (!(points <= kMostPoints)) {
        throw Error(
            ErrorCode::invalid_argument,
            "the stroke would have more than thirty million points; ask for a larger spacing, "
            "or give fewer events");
    }
    return context.charge(kBytes * (static_cast<std::size_t>(points) + course.points.size()),
                          "the points of a stroke");
}

// The events that move, in logical pixels.
std::vector<StrokeEvent> moving(std::span<const StrokeEvent> events, double scale) {
    std::vector<StrokeEvent> result;
    for (StrokeEvent event : events) {
        event.pixel /= scale;
        if (!result.empty()) event.time = std::max(event.time, result.back().time);
        if (result.empty() || result.back().pixel != event.pixel) result.push_back(event);
    }
    return result;
}

Course course_of(const std::vector<StrokeEvent>& events) {
    std::vector<Vec2> points;
    for (const StrokeEvent& event : events) points.push_back(event.pixel);
    return course_of(std::move(points));
}

// Times and pressures at the same share of the way.
void add_times(Stroke& stroke, std::span<const StrokeEvent> events, const Course& course) {
    const std::vector<double> places = places_of(stroke.points);
    for (const double place : places) {
        const double share = places.back() > 0.0 ? place / places.back() : 0.0;
        const auto [i, t] = course.find(share * course.length());
        const StrokeEvent &a = events[i], &b = events[std::min(i + 1, events.size() - 1)];
        stroke.times.push_back((1.0 - t) * a.time + t * b.time);
        stroke.pressures.push_back((1.0 - t) * a.pressure + t * b.pressure);
    }
}

}  // namespace

double Stroke::length() const {
    return points.empty() ? 0.0 : places_of(points).back();
}

bool is_click(std::span<const StrokeEvent> events, double scale) {
    require_events(events);
    require_scale(scale);
    const auto is_near = [&](const StrokeEvent& event) {
        return (event.pixel - events.front().pixel).norm() < kClickPixels * scale;
    };
    const double seconds = events.back().time - events.front().time;
    return seconds < kClickSeconds && std::all_of(events.begin(), events.end(), is_near);
}

Stroke fair_stroke(std::span<const StrokeEvent> events, const StrokeOptions& options,
                   const Context& context) {
    require_events(events);
    require_options(options);
    std::vector<StrokeEvent> kept = moving(events, options.scale);
    Stroke stroke;
    if (is_click(events, options.scale) || kept.size() == 1) {
        kept.resize(1);
        stroke.points = {kept.front().pixel};
        add_times(stroke, kept, course_of(kept));
        return stroke;
    }
    const auto [first, last] = without_hooks(course_of(kept));
    kept = {kept.begin() + first, kept.begin() + last + 1};
    const Course course = course_of(kept);
    const MemoryCharge charge = charge_points(course, options, context);

    std::vector<Corner> ends{{0.0, course.points.front()}};
    for (const Corner& corner : find_corners(course, context)) ends.push_back(corner);
    ends.push_back({course.length(), course.points.back()});
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (i > 0) stroke.corners.push_back(count_of(stroke.points) - 1);
        context.checkpoint();
        const std::vector<Vec2> piece =
            fair_piece(piece_between(course, ends[i], ends[i + 1]), options, context);
        stroke.points.insert(stroke.points.end(), piece.begin() + (i > 0), piece.end());
    }
    add_times(stroke, kept, course);
    return stroke;
}

}  // namespace lissom
