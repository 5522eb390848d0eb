/// Our data in the extras of a glTF mesh: labels of faces and named regions, for which glTF has no
/// place; private to kernel/io and not installed.
///
///     "lissom": {"vertices": 8, "faces": 6,
///                "labels": {"group": {"names": ["side"], "runs": [0, 4, -1, 2]}},
///                "regions": {"top": [4, 4]}, "turns": [0, 5, 1, 1], "corners": ["uv"],
///                "parts": [1, 5, 3, 1], "copies": [1, 4, 2, 2]}
///
/// Runs are pairs: a label (-1 for none) and the number of faces that have it; for regions the
/// first vertex and how many follow. Vertices are those of the mesh's accessors, faces the polygons
/// of its primitives in order; if polygons had to be written as several faces, "parts" has runs of
/// the number of faces of each. "copies", if positions do not identify vertices, has runs of the
/// number of consecutive entries of one vertex. Turns are runs too: the place in each polygon of
/// the corner that was its first. "corners" names attributes of corners, even if none of them
/// differ.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

struct MeshExtras {
    std::map<std::string, FaceLabels> labels;
    /// Vertices in ascending order.
    std::map<std::string, std::vector<Index>> regions;
    /// For each face; empty if all are 0.
    std::vector<Index> turns;
    std::vector<std::string> corners;
    /// For each face the number of faces read that it is made of; empty if all are 1.
    std::vector<Index> parts;
    /// For each vertex of the surface the number of vertices that it is; empty if that is left to
    /// their places.
    std::vector<Index> copies;
};

/// Returns the extras of `mesh` that fit these counts of vertices and faces; another program may
/// have changed it. Removes them from `mesh`; `fits` is false if there were some that do not fit.
MeshExtras take_extras(Json& mesh, std::size_t vertex_count, std::size_t face_count, bool& fits);

/// Adds extras to `mesh`, unless there are none.
void put_extras(Json& mesh, const MeshExtras& extras, std::size_t vertex_count,
                std::size_t face_count);

}  // namespace lissom
