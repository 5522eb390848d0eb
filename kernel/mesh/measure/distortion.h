/// Stretch, shear and folds of a mesh's surface, compared with another shape of it.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// One number a vertex each, of the edges, faces and corners around it; NaN if it has none that had
/// a length or an area at rest.
struct Distortion {
    /// Length of the edge that changed most, over its length at rest: 1 as at rest.
    std::vector<double> stretch;
    /// Area of the faces over their area at rest.
    std::vector<double> area;
    /// Greatest change of the angle of a corner at the vertex, in radians.
    std::vector<double> angle;
    /// Number of flipped faces.
    std::vector<double> flips;
    /// Faces that look against the faces around them, and did not at rest; ascending.
    std::vector<Index> flipped;
};

/// Compares the shape of `mesh` with that of `rest`, which has the same faces.
/// Errors: topology_mismatch; cancelled.
Distortion distortion(const Mesh& mesh, const Mesh& rest, const Context& context = {});

/// Returns the faces among `faces`, in their order, that look against the faces around them and did
/// not at rest. Errors: topology_mismatch.
std::vector<Index> flipped_faces(const Mesh& mesh, const Mesh& rest, std::span<const Index> faces);

}  // namespace lissom
