/// Rules that give the points of a stroke a depth: how a line on the screen becomes one in the
/// world.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Returns the points of a stroke at these depths along the view, one for each.
std::vector<Vec3> at_depths(std::span<const Vec2> stroke, std::span<const double> depths,
                            const View& view);

/// Returns the stroke on a plane through `point`. Errors: not_finite; invalid_argument for a normal
/// without length, or naming the place of the first point whose ray does not meet the plane in
/// front of the camera.
std::vector<Vec3> stroke_on_plane(std::span<const Vec2> stroke, const View& view, const Vec3& point,
                                  const Vec3& normal);

/// A surface that is drawn on, placed in the world.
struct DrawnSurface {
    const SpatialTree& tree;
    /// Faces that may be drawn on from outside, one mark a face; empty for all, from both sides.
    /// The others still hide them.
    std::span<const char> faces;
};

/// Returns the stroke on the surface while it is over it, and beyond it at the depth of the last
/// point that was (section 4.5). Points are `lift` nearer to the viewer. Errors: not_finite;
/// out_of_range if the stroke starts beside the surface, invalid_argument if something else is
/// there; cancelled.
std::vector<Vec3> stroke_on_surface(std::span<const Vec2> stroke, const View& view,
                                    const DrawnSurface& surface, double lift = 0.0,
                                    const Context& context = {});

/// Lengths in metres of a head of average size; see stroke_over_head.
struct EnvelopeOptions {
    /// World units to a metre.
    double metre = 1.0;
    /// Distance of the risen curve in front of the hair's region, and the length over which it
    /// rises from the root.
    double lift = 0.02, rise = 0.03;
    /// No point but those near the root is nearer to the head.
    double clearance = 0.005;
    /// The steepest that depth changes, per length on the screen.
    double slope = 0.7;
    /// Pixels of the averages that make the depth fair, and pixels within which a stroke that
    /// starts beside the hair's region is taken to start on it.
    double averages = 12.0, snap = 20.0;
};

/// Returns a stroke over a head, for hair that falls or stands off: the lowest envelope in front of
/// the skin with hair and of the rest of the head, with a depth that changes no faster than
/// `slope`, so that it bridges ears and passes silhouettes without a corner. It begins on the
/// region and, moving towards the viewer alone, never enters the head. Depths beyond the silhouette
/// are a guess; draw again from another view. If the start has to be moved, the point that it is
/// moved to comes before the others. Errors: not_finite; out_of_range if the stroke starts beside
/// the head; invalid_argument if it starts neither on the region nor near it, with the reason, or
/// for options out of range; cancelled.
std::vector<Vec3> stroke_over_head(std::span<const Vec2> stroke, const View& view,
                                   const DrawnSurface& head, const EnvelopeOptions& options = {},
                                   const Context& context = {});

}  // namespace lissom
