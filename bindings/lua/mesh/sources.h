/// Starts of distances over a surface, as scripts write them.
#pragma once

#include <span>

#include "bindings/lua/core/call.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom::lua {

/// Vertices, or a point, as plain data.
struct SourceSpec {
    /// Vertices if `is_point` is false.
    std::span<const Index> vertices;
    bool is_point;
    double xyz[3];

    /// The point of the surface nearest to the one given. Errors: mesh_empty; cancelled.
    SurfacePoint nearest(MeshObject& mesh, const Context& context) const;
};

/// The option `from`: a vertex, a region, a list of vertices, or a point.
Parameter source_option();

/// Reads it. Raises a Lua error for a table that is neither, or that could be three vertices as
/// well as a point.
SourceSpec read_sources(Call& call, const char* path);

}  // namespace lissom::lua
