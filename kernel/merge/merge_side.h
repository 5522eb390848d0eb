/// One side of a merge as it is worked on: looking outward, with smooth boundaries, and with the
/// way back to the mesh that was given; private to kernel/merge.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct MergeSide {
    Mesh mesh;
    /// From the elements of `mesh` to those of the mesh given.
    MeshMap map;
    /// Vertices of the boundaries to be joined, each in the direction of the surface.
    std::vector<std::vector<Index>> loops;
    /// Radians a loop's edges turn in the mean, as given, and whether it was trimmed.
    std::vector<double> turns;
    std::vector<char> trimmed;
    /// Reasons why jagged loops could not be trimmed.
    std::vector<std::string> untrimmed;
    bool flipped = false;
    /// By loop, or empty for none: those that fit as they are are neither trimmed nor refined.
    std::vector<char> fits = {};

    /// The vertices of `mesh` that are nothing but vertices of `given`.
    Region carried(const Region& given) const;
};

/// Returns the mesh with some of its open boundaries, whichever way round they are given.
/// Errors: topology_mismatch; not_a_boundary; boundary_conflict if one is given twice or crosses
/// itself.
MergeSide make_side(const Mesh& mesh, const std::vector<Path>& boundaries, const std::string& name);

/// Turns a mesh over that is inside out: whose volume, boundaries capped, is clearly negative.
void orient(MergeSide& side, const Context& context);

/// Trims the loops that turn by `max_turn` radians more than a regular polygon with as many
/// vertices, in the mean. A loop without room for it stays as it is; see `untrimmed`.
void trim_jagged(MergeSide& side, double max_turn, const Context& context);

/// Splits the faces at one loop, once, by bisecting its edges.
void refine_loop(MergeSide& side, std::size_t loop, const Context& context);

}  // namespace lissom
