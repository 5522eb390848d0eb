/// Comparison of the surface around a seam with the surfaces that were joined: roughness, faces
/// that turned over, volume of the parts.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Measures the band around one seam and the sides behind it. Angles in radians, volumes over those
/// at rest and at the same scale.
struct BandQuality {
    /// The RMS dihedral angle of the edges within half a radius of the seam, without the seam's,
    /// weighted by length; and the same of both sides beside their boundaries before.
    double roughness = 0.0, rest_roughness = 0.0;
    /// The same of each side by itself: a smooth part that crumples beside a rough one shows.
    double source_roughness = 0.0, rest_source_roughness = 0.0;
    double target_roughness = 0.0, rest_target_roughness = 0.0;
    /// The same of the edges that turn by less than 40 degrees: the grain of a surface between its
    /// creases, beside which roughness tells little.
    double source_grain = 0.0, rest_source_grain = 0.0;
    double target_grain = 0.0, rest_target_grain = 0.0;
    /// Length of the source's edges within half a radius that turn by more than 25 degrees, in
    /// radii of the seam, beyond that before; at least 0.
    double wrinkled = 0.0;
    /// Dihedral angle of the seam's edges that a thirtieth of its length exceeds; and the same of
    /// the edges of the faces at the boundaries before, of the side that is steeper.
    double steep = 0.0, rest_steep = 0.0;
    /// Angles between planes fitted to the surface on either side of points of the seam, each to a
    /// strip a third of the radius wide: the RMS, and the angle that a tenth of them exceed. And
    /// those on either side before, from the strip next to the boundary to the one behind it, of
    /// the side that bends more.
    double bend = 0.0, max_bend = 0.0, rest_bend = 0.0, rest_max_bend = 0.0;
    /// Length of the edges within one radius at which the surface folds back by more than 135
    /// degrees, in radii of the seam; and of those of both sides before that turned by more than
    /// 105, and may have become such without a face turning over.
    double folded = 0.0, rest_folded = 0.0;
    /// Length of the edges within half a radius that turn by more than 60 degrees, in radii of the
    /// seam, beyond that of the same side before: of the side that gained most, at least 0. A slit,
    /// a ridge or teeth show there on sides that are too rough for `roughness` to tell.
    double sharpened = 0.0;
    /// Sum of the widths, in radii of the seam, of the vertices of the source within half a radius
    /// that became thorns or pits: their neighbours slope away from them by 30 degrees more than at
    /// rest, to either side (pinches). 0 if the origin of its vertices is unknown.
    double pinched = 0.0;
    /// Length of the edges of both sides within half a radius that turn by 20 degrees more than at
    /// rest, or the other way, in radii of the seam (crumpled_edges). Those of a side count if the
    /// origin of its vertices is known.
    double crumpled = 0.0;
    /// Outward turn of the source between neighbouring strips beside the seam, beyond that at rest,
    /// which shows as a flared rim: the RMS over the seam of the greatest gain; 0 if the origin of
    /// its vertices is unknown, and of a paste, whose rim is tilted on purpose.
    double flare = 0.0;
    /// Sharpness of the sharpest tip or pit within half a radius of the seam: the greatest sum of
    /// angles missing to full turns around the vertices within .15 radii. The corner of a cube has
    /// a quarter turn, a needle a full one. And the same of both sides before.
    double spike = 0.0, rest_spike = 0.0;
    /// Volume of the source and of the target between the surface and the middle of the seam, over
    /// that at rest at the source's scale: 1 for a part that kept it. It is 1 as well for a side
    /// with less than the seam's own dome. Of the target of a paste: the share of its area that is
    /// left.
    double source_volume = 1.0, target_volume = 1.0;
    /// Radius of the seam: the RMS distance of its points to their middle.
    double radius = 0.0;
};

/// A side of a seam: a mesh, the faces of it that count (all, if there are none), and the vertices
/// of the seam on it.
struct BandSide {
    const Mesh* mesh = nullptr;
    std::span<const Index> faces = {};
    std::span<const Index> loop = {};
    /// The mesh is a piece of a larger one: its volume is not known.
    bool is_piece = false;
    /// For a side in a merged mesh: the place of each vertex of the mesh on that side at rest, NaN
    /// for a vertex that was not on it.
    std::span<const Vec3> rest = {};
    /// It may meet the target at a crease, so that its rim is tilted on purpose.
    bool meets_at_crease = false;
};

/// Measures the band around a seam that `target` and `source` were joined at; `scale` is how much
/// the source grew. `made_target` and `made_source` are their faces in the merged mesh with the
/// seam as the loop of both. `stays`: the source was not brought to the seam but keeps its place.
/// The work is linear in the sizes of the meshes, with small factors.
/// Errors: out_of_range; cancelled.
BandQuality band_quality(const BandSide& made_target, const BandSide& made_source,
                         const BandSide& target, const BandSide& source, double scale, bool stays,
                         const Context& context = {});

/// The RMS distance of the points of a loop of vertices from their middle.
double loop_radius(const Mesh& mesh, std::span<const Index> loop);

/// The RMS dihedral angle, weighted by length, of the edges of `faces`, in radians; 0 without any.
/// Open edges and those of faces without area do not count.
double rms_dihedral(const Mesh& mesh, std::span<const Index> faces);

/// The dihedral angle that a thirtieth of the length of the edges of `faces` exceeds, in radians; 0
/// without any. Open edges do not count.
double steep_dihedral(const Mesh& mesh, std::span<const Index> faces);

}  // namespace lissom
