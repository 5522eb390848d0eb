/// What the extras of a glTF mesh hold of ours: labels of faces and named regions, for which glTF
/// has no place; private to kernel/io and not installed.
///
///     "lissom": {"vertices": 8, "faces": 6,
///                "labels": {"group": {"names": ["side"], "runs": [0, 4, -1, 2]}},
///                "regions": {"top": [4, 4]}, "turns": [0, 5, 1, 1], "corners": ["uv"]}
///
/// Runs are pairs: a label (-1 for none) and the number of faces that have it; for regions the
/// first vertex and how many follow. Vertices are those of the mesh's accessors, faces the polygons
/// of its primitives in order. Turns are runs too: the place in each polygon of the corner that was
/// its first. "corners" names attributes that are of corners even where none of them differ.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kernel/io/gltf_json.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

struct MeshExtras {
    std::map<std::string, FaceLabels> labels;
    /// Vertices in ascending order.
    std::map<std::string, std::vector<Index>> regions;
    /// For each face; empty where all are 0.
    std::vector<Index> turns;
    std::vector<std::string> corners;
};

/// The extras of `mesh`, in so far as they fit a surface of so many vertices and faces; another
/// program may have changed it. Removes them from `mesh`, where `fits` is then false if there were
/// some that do not fit.
MeshExtras take_extras(Json& mesh, std::size_t vertex_count, std::size_t face_count, bool& fits);

/// Adds extras to `mesh`, unless there are none.
void put_extras(Json& mesh, const MeshExtras& extras, std::size_t vertex_count,
                std::size_t face_count);

}  // namespace lissom
