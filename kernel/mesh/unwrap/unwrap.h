/// Unwrapping: a whole surface cut into charts that lie flat with little stretch, side by side in
/// the unit square, as texture coordinates.
#pragma once

#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct UnwrapOptions {
    /// Greatest factor by which a length may change, for all but a fiftieth of each chart's area;
    /// above 1. More charts for less.
    double stretch = 1.3;
    /// Weight of creases against short ways, for the seams; 0 or more. With 1 edges of 50 degrees
    /// part charts, with 0 none do.
    double crease = 1.0;
    /// Space between two charts, as a part of the square's side; 0.0005 to 0.1. With 1/256 four
    /// pixels of a texture with 1,024.
    double gap = 1.0 / 256.0;
};

/// A surface in the unit square. Charts are numbered from the largest on, and have equal scales.
struct Unwrapping {
    /// Texture coordinates of each corner.
    std::vector<Vec2> uv;
    /// Chart of each face.
    std::vector<Index> chart;
    Index chart_count = 0;
    /// Part of the square that the charts cover.
    double coverage = 0.0;
    /// Side of the square in lengths of the mesh.
    double side = 0.0;
    /// Mean of the factors by which lengths change most at a point, over the area, and the greatest
    /// but for a fiftieth of it; 1 for a surface that is laid out as it is.
    double mean_stretch = 1.0, stretch = 1.0;
    /// Length on the surface of the seams within it; open boundaries do not count.
    double seam_length = 0.0;
    /// Faces that are turned over in the square, ascending.
    std::vector<Index> flipped;
};

/// Cuts the surface into charts: the parts between creases are halved until each is flat enough
/// (a ring is cut open), and joined again where both together are. Each is laid out by
/// `parameterize` with ParameterizeMethod::arap, and all are packed by their outlines (Levy et al.
/// 2002, section 4). Polygons, open meshes, handles and several components are welcome. The same
/// for any number of threads, and wherever the mesh lies, apart from rounding. Errors: mesh_empty
/// without faces; invalid_argument for options out of range; memory_limit; cancelled.
Unwrapping unwrap(const Mesh& mesh, const UnwrapOptions& options = {}, const Context& context = {});

/// Writes texture coordinates to the corners, as the attribute `name` of width 2, in place of one
/// of that name. Errors: topology_mismatch for an unwrapping of other faces; invalid_argument for
/// an empty name.
void write_unwrapping(Mesh& mesh, const Unwrapping& unwrapping, std::string_view name = "uv");

}  // namespace lissom
