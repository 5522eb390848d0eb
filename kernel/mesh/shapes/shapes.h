/// Generated meshes. All are oriented outward, closed unless said, centred at the origin unless
/// said, and stand along y if one axis is special. Lengths must be finite and above 0, counts as
/// documented; otherwise invalid_argument names the option. Counts that would exceed Index are
/// out_of_range.
#pragma once

#include <array>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// An axis-aligned box of quads. Regions: "left", "right" (x), "bottom", "top" (y), "back", "front"
/// (z).
struct BoxOptions {
    Vec3 size = Vec3::Ones();
    /// Quads along x, y and z; at least 1 each.
    std::array<Index, 3> segments{1, 1, 1};
};
Mesh make_box(const BoxOptions& options = {}, const Context& context = {});

/// A slender bar of square cross section along y, made of quads. Regions: "bottom", "top" (its end
/// squares). Strictly between the ends lie 4 * across * (along - 1) vertices: 36 across and 171
/// along give 24,480.
struct BarOptions {
    double width = 1.0, length = 5.0;
    /// Quads across each side and along the bar; at least 1 each.
    Index across = 8, along = 40;
};
Mesh make_bar(const BarOptions& options = {}, const Context& context = {});

/// Subdivision of a sphere: a cube's quads projected by equal angles, or the triangles of an
/// icosahedron.
enum class SphereKind { quads, triangles };

/// A sphere; vertices lie on it exactly, up to rounding.
struct SphereOptions {
    double radius = 1.0;
    /// Divisions of each edge of the cube or icosahedron; at least 1.
    Index segments = 16;
    SphereKind kind = SphereKind::quads;
};
Mesh make_sphere(const SphereOptions& options = {}, const Context& context = {});

/// A cylinder along y. Regions: "bottom" and "top" (its end circles, with any caps), and "caps" if
/// there are caps.
struct CylinderOptions {
    double radius = 0.5, height = 2.0;
    /// Quads around (at least 3) and along (at least 1).
    Index segments = 32, rings = 16;
    /// Closes the ends with rings of quads around a fan of triangles; without it the cylinder is
    /// open.
    bool caps = true;
    /// Rings of each cap, at least 1; the innermost is the fan.
    Index cap_rings = 4;
};
Mesh make_cylinder(const CylinderOptions& options = {}, const Context& context = {});

/// An open rectangle of quads in the xz plane that faces +y. Region: "border".
struct GridOptions {
    Vec2 size = Vec2::Ones();
    /// Quads along x and z; at least 1 each.
    std::array<Index, 2> segments{10, 10};
};
Mesh make_grid(const GridOptions& options = {}, const Context& context = {});

/// A torus of quads around the y axis.
struct TorusOptions {
    /// Radius of the circle in the middle of the tube, and of the tube, which must be the smaller.
    double radius = 1.0, tube_radius = 0.35;
    /// Quads around the axis and around the tube; at least 3 each.
    Index segments = 48, tube_segments = 24;
};
Mesh make_torus(const TorusOptions& options = {}, const Context& context = {});

/// A saguaro: a ribbed trunk with a rounded top and two arms that leave it sideways and turn up.
/// One smoothly blended closed surface of quads that stands on the plane y = 0 around the y axis;
/// thorns are small bumps in rows along the ribs. Regions: "base" (the foot), "tip" (the trunk's
/// top), "left_arm" and "right_arm" (the upright parts, at -x and +x), "left_tip", "right_tip".
struct CactusOptions {
    double height = 2.0;
    /// Vertices wanted; the result is within 10 %. 2,000 to 1,000,000.
    Index vertices = 9000;
    /// Ribs around the trunk, 0 or 4 to 40; arms have about two thirds as many.
    Index ribs = 12;
    /// Depth of the grooves between ribs as a fraction of the trunk's radius, 0 to 0.3.
    double rib_depth = 0.2;
    /// Height of the thorns as a fraction of the trunk's radius, 0 to 0.2.
    double thorns = 0.06;
};
Mesh make_cactus(const CactusOptions& options = {}, const Context& context = {});

}  // namespace lissom
