/// Offsets of surfaces, and solid shells from them.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

struct ThickenOptions {
    /// Thickness of the shell, above 0.
    double thickness = 0.0;
    /// Part of the thickness that lies outside the surface, 0 to 1.
    double outside = 0.0;
    /// Whether faces that run through one another are searched for.
    bool check = true;
};

struct Shell {
    Mesh mesh;
    /// Pairs of faces that run through one another and that are not of the surface as given.
    std::vector<FacePair> crossings;
};

/// Returns for each vertex the displacement by which the planes of its faces move by 1 along their
/// normals, as nearly as possible (least squares, weighted by angle; no longer than 3). A box's
/// corner moves along its diagonal, so that its faces move evenly. Zero without faces.
std::vector<Vec3> offset_directions(const Mesh& mesh);

/// Moves the surface by `distance` along its normals, in place; inwards if it is negative. Returns
/// the pairs of faces that run through one another and did not before, if `check`; else none.
/// Errors: invalid_argument if the distance is not finite or more than ten times the diagonal of
/// the mesh's box, or if a closed surface is moved inwards by more than the shortest side of its
/// box; cancelled. The mesh is then as it was.
std::vector<FacePair> offset(Mesh& mesh, double distance, bool check = true,
                             const Context& context = {});

/// Returns a solid shell: the surface moved outwards, and turned over and moved inwards, with rims
/// of quads along open borders. The vertices and faces of the outer side come first, then those of
/// the inner side in the same order, then the rims. A closed surface becomes a hollow one. Both
/// sides have all attributes, labels and regions of the surface; rims take those of the faces
/// beside them. Errors: mesh_empty; invalid_argument for a thickness not above 0, a part outside 0
/// to 1, or sides farther from the surface than offset() allows; out_of_range if the result would
/// have more elements than can be numbered; memory_limit; cancelled.
Shell thicken(const Mesh& mesh, const ThickenOptions& options, const Context& context = {});

}  // namespace lissom
