/// Refinement around points of a surface: edges are halved until those near the points are short.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A ball around a point of a surface, and how long edges in it may be.
struct FinePlace {
    Index face = kNoIndex;
    Vec3 point = Vec3::Zero();
    double radius = 0.0;
    /// Edges are halved if one is longer than `coarse`, until none is longer than `length`.
    double coarse = 0.0, length = 0.0;
};

struct FinerMesh {
    Mesh mesh;
    /// From its elements to those of the mesh as given. Old vertices keep their numbers.
    MeshMap map;
};

/// Returns the faces that touch the ball of a place and hang together with its face through such
/// faces, in the order in which they are reached.
std::vector<Index> faces_touching(const Mesh& mesh, const FinePlace& place);

/// Halves edges until no face that touches the ball of a place has an edge longer than its length,
/// at places with an edge that is too long. The longest edge of a triangle is halved before its
/// others (Rivara 1984), so that every angle keeps at least half its size. The shape stays, and the
/// mesh conforms: polygons in a ball are triangulated, those beside it take the new vertices in.
/// The faces made from one face follow each other in its place; attributes are interpolated within
/// faces. Nothing if all places are fine enough. Errors: memory_limit; cancelled.
std::optional<FinerMesh> finer_near(const Mesh& mesh, std::span<const FinePlace> places,
                                    const Context& context);

}  // namespace lissom
