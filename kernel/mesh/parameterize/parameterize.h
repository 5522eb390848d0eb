/// Planar parameterization: a piece of surface laid out in the plane, as texture coordinates or as
/// a common plane of two surfaces.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

enum class ParameterizeMethod {
    /// Least-squares conformal maps (Levy et al. 2002) in their spectral form (Mullen et al. 2008):
    /// angles are kept as well as can be, scale is not. No vertex is pinned.
    lscm,
    /// As rigid as possible (Liu et al. 2008), from `lscm`: angles and lengths are kept. If that
    /// ends with flipped faces, the better in energy of two: iterations that stop short of flips,
    /// or the last one without flips; `lscm` if there is none, or if boundaries come to cross.
    arap,
    /// Onto a disk (Tutte 1963, Floater 1997), with positive weights: never flips a face or covers
    /// a point twice, and keeps neither angles nor lengths.
    tutte,
};

struct ParameterizeOptions {
    ParameterizeMethod method = ParameterizeMethod::arap;
    /// Iterations of `arap`, 0 or more; it ends early if its energy falls by less than 1e-6 of it.
    Index maximum_iterations = 20;
    /// Closes every boundary but the longest by triangles of least area over its vertices. They
    /// take part in the map, so that the loops of a ring do not cross one another or themselves;
    /// without them they may. `tutte` needs them.
    bool close_holes = true;
    /// Triangles over vertices of the mesh that close holes the same way, given by the caller. They
    /// turn as the faces do.
    std::vector<Triangle> fill = {};
};

/// A piece of surface in the plane. Lengths are those of the mesh: for `lscm` and `tutte` the scale
/// makes the area that of the surface, for `arap` the scale follows from its energy. The mean of
/// the outer loop is at the origin and the loop's lowest vertex on the positive u axis, so that the
/// result depends neither on the place of the mesh nor on how it is turned.
struct Parameterization {
    /// Vertices of the mesh, ascending, and their positions.
    std::vector<Index> vertex;
    std::vector<Vec2> uv;
    /// Triangles over places in `vertex`, counter-clockwise in the plane: first those of the faces,
    /// `face.size()` of them, then the ones that close holes.
    std::vector<Triangle> triangles;
    /// The face of the mesh that each triangle of the surface is part of.
    std::vector<Index> face;
    /// Boundaries of the faces as places in `vertex`, in the direction of the faces: the longest,
    /// which is the outer one, and then the others by their lowest vertex.
    std::vector<std::vector<Index>> loops;

    /// Method of the map: `lscm` if `arap` was asked for and flips from its first iteration on.
    ParameterizeMethod method = ParameterizeMethod::lscm;
    /// Iterations of `arap` that are in the result.
    Index iterations = 0;
    /// Energy of `arap` before the first iteration and after each that was made, as the mean
    /// squared difference of the map's derivative from a rotation. Never increases.
    std::vector<double> energy;
    /// Faces with a triangle that is turned over, ascending, and such triangles that close holes.
    std::vector<Index> flipped;
    Index flipped_fill = 0;
    /// Faces with a triangle that has hardly an area on the surface, ascending: one narrower than
    /// 1e-4 of its length. It is laid out as if it had that width, and does not count in the scale.
    std::vector<Index> degenerate;
    /// Least and greatest factor by which the map changes a length at a point, over all faces: the
    /// singular values of its derivative.
    double min_scale = 1.0, max_scale = 1.0;
    /// Pairs of boundary edges that cross in the plane. Without these and without flips the map is
    /// one to one.
    Index boundary_crossings = 0;

    std::span<const Triangle> surface_triangles() const { return {triangles.data(), face.size()}; }
    std::span<const Triangle> fill_triangles() const {
        return std::span(triangles).subspan(face.size());
    }
};

/// Lays out faces of `mesh` in the plane. They must be connected, of genus 0 and open: a disk or a
/// disk with holes; polygons are triangulated. The result does not depend on the number of threads
/// nor on place, rotation or scale of the mesh, apart from rounding. Errors: region_empty without
/// faces; out_of_range; invalid_argument for options out of range, and for an outline without
/// length; not_a_disk, naming vertices, if the faces are closed, have handles, fall into several
/// parts, or have a hole that cannot be closed; nonmanifold_vertex if they meet at a vertex only;
/// nonmanifold_edge if triangles to close holes do not fit; not_positive_definite; memory_limit;
/// cancelled.
Parameterization parameterize(const Mesh& mesh, std::span<const Index> faces,
                              const ParameterizeOptions& options = {}, const Context& context = {});
/// Returns the same for the faces of a region. Errors: also topology_mismatch.
Parameterization parameterize(const Mesh& mesh, const Region& region,
                              const ParameterizeOptions& options = {}, const Context& context = {});

}  // namespace lissom
