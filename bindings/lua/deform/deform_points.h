/// Points of a mesh as scripts write them, for constraints of a deformation.
#pragma once

#include <span>
#include <vector>

#include "bindings/lua/core/call.h"
#include "kernel/deform/mesh_point.h"

namespace lissom::lua {

/// A point of a mesh as plain data: weights of the corners of `face`, or of `vertices` if that is
/// kNoIndex.
struct PointSpec {
    Index face;
    std::span<const Index> vertices;
    std::span<const double> weights;

    /// Errors: as face_point; invalid_argument.
    MeshPoint point(const Topology& topology) const;
};

/// Reads a list of tables {vertex=}, {edge={a, b}, at=}, {face=, bary=} or of results of
/// Mesh.nearest and Mesh.pick. Raises a Lua error for anything else.
std::span<const PointSpec> read_points(const Call& call, const char* path);

/// The options of one point, and the point they tell. Raises a Lua error unless there is exactly
/// one of vertex, edge and face.
std::vector<Parameter> point_fields();
PointSpec read_point_options(const Call& call);

}  // namespace lissom::lua
