/// A hand that draws: strokes along meant curves, with the noise of a mouse.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "kernel/sketch/stroke.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {

struct HandOptions {
    /// Standard deviation of the jitter, pixels, correlated from event to event.
    double jitter = 1.0;
    /// Pixels a second where the course is straight.
    double speed = 600.0;
    bool hooks = false;
    bool whole_pixels = true;
};

/// Draws polylines of meant points at 125 events a second.
class Hand {
  public:
    explicit Hand(std::uint32_t seed) : random_(seed) {}

    std::vector<StrokeEvent> draw(const std::vector<Vec2>& meant, const HandOptions& options = {}) {
        std::vector<Vec2> course = meant;
        if (options.hooks) {
            course.insert(course.begin(), hook(meant[0], meant[1]));
            course.push_back(hook(meant.back(), meant[meant.size() - 2]));
        }
        std::vector<StrokeEvent> events;
        Vec2 noise = Vec2::Zero();
        double phase = random_.uniform(0.0, 2.0 * kPi);
        const double length = length_of(course), wave = random_.uniform(23.0, 60.0);
        for (double place = 0.0, time = 0.0; place <= length; time += kStep) {
            const double kept = 0.6, fresh = std::sqrt(1.0 - kept * kept) * options.jitter;
            noise = kept * noise + fresh * Vec2(normal(), normal());
            const double drift = 0.5 * options.jitter * std::sin(phase + 2.0 * kPi * place / wave);
            Vec2 pixel = at(course, place) + noise + drift * Vec2(0.6, 0.8);
            if (options.whole_pixels) pixel = pixel.array().round();
            events.push_back({pixel, time, 1.0});
            const double near_end = std::min(place, length - place);
            const double slow = std::clamp(near_end / 40.0, 0.2, 1.0);
            place += options.speed * slow * kStep;
        }
        events.push_back({at(course, length), events.back().time + kStep, 1.0});
        return events;
    }

    double uniform(double from, double to) { return random_.uniform(from, to); }

  private:
    static constexpr double kStep = 1.0 / 125.0;

    double normal() {
        double sum = 0.0;
        for (int i = 0; i < 12; ++i) sum += random_.uniform(-0.5, 0.5);
        return sum;
    }
    // 4 to 9 pixels, turned by 70 to 140 degrees from the way on.
    Vec2 hook(const Vec2& end, const Vec2& next) {
        const double angle = random_.uniform(70.0, 140.0) * kPi / 180.0;
        const Vec2 on = (next - end).normalized();
        const Vec2 way(std::cos(angle) * on.x() - std::sin(angle) * on.y(),
                       std::sin(angle) * on.x() + std::cos(angle) * on.y());
        return end - random_.uniform(4.0, 9.0) * way;
    }
    static double length_of(const std::vector<Vec2>& points) {
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            length += (points[i] - points[i - 1]).norm();
        return length;
    }
    static Vec2 at(const std::vector<Vec2>& points, double place) {
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double length = (points[i] - points[i - 1]).norm();
            if (place <= length)
                return points[i - 1] + place / length * (points[i] - points[i - 1]);
            place -= length;
        }
        return points.back();
    }

    Random random_;
};

/// The mean distance (root of squares) of points to a polyline.
inline double distance_to(const std::vector<Vec2>& points, const std::vector<Vec2>& line) {
    double sum = 0.0;
    for (const Vec2& p : points) {
        double nearest = kInfinity;
        for (std::size_t i = 1; i < line.size(); ++i) {
            const Vec2 side = line[i] - line[i - 1];
            const double t = std::clamp((p - line[i - 1]).dot(side) / side.squaredNorm(), 0.0, 1.0);
            nearest = std::min(nearest, (p - line[i - 1] - t * side).squaredNorm());
        }
        sum += nearest;
    }
    return std::sqrt(sum / points.size());
}

/// The sum of the absolute turns of a polyline, radians.
inline double turning(const std::vector<Vec2>& points) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Vec2 a = points[i] - points[i - 1], b = points[i + 1] - points[i];
        sum += std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
    }
    return sum;
}

}  // namespace lissom::test
