/// Stroke: the intended curve of a drawing on a picture. Lengths are logical pixels.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

/// One event of a pen or mouse that draws.
struct StrokeEvent {
    Vec2 pixel = Vec2::Zero();
    /// Seconds from any start; may stand still.
    double time = 0.0;
    /// 0 to 1; 1 if the device does not report it.
    double pressure = 1.0;
};

struct StrokeOptions {
    /// Distance that the stroke may leave the events, as a multiple of the one for a mouse (a mean
    /// of 2 pixels); 0 keeps every wiggle.
    double smoothing = 1.0;
    /// Pixels between two points of the result.
    double spacing = 4.0;
    /// Pixels of the device to a logical one.
    double scale = 1.0;
};

/// A fair curve of evenly spaced points.
struct Stroke {
    std::vector<Vec2> points;
    /// Values at each point, interpolated along the events.
    std::vector<double> times, pressures;
    /// The points, in ascending order, that are corners which were meant; never an end.
    std::vector<Index> corners;

    /// Length in pixels.
    double length() const;
};

/// Returns whether the events are a click: within 6 logical pixels and a quarter of a second.
/// Errors: invalid_argument without events; not_finite.
bool is_click(std::span<const StrokeEvent> events, double scale = 1.0);

/// Returns the intended curve: hooks at the touch and the lift of the pen are dropped, corners of
/// 45 degrees and more are kept, and between them a cubic B-spline follows the events, with the
/// fewest knots (90 to 20 pixels apart) that stay near enough. The first point stays at the first
/// event, unless it begins a hook. A click gives its first point alone; times that run backwards
/// are taken as standing still. Errors: invalid_argument without events, for a spacing or scale
/// that is not positive, a negative smoothing, or more than thirty million points; not_finite;
/// memory_limit; cancelled.
Stroke fair_stroke(std::span<const StrokeEvent> events, const StrokeOptions& options = {},
                   const Context& context = {});

}  // namespace lissom
