/// Provenance: from which elements of its inputs each element of a merged mesh comes; private to
/// kernel/merge.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Every element of a mesh from itself.
MeshMap identity_map(const Topology& topology);
/// Every element of a part from that of the mesh it was taken out of.
MeshMap part_map(const MeshPart& part, const Topology& old);
/// The map of a mesh whose faces were reversed, each from its first vertex (flip).
MeshMap flipped_map(const Topology& topology);
/// Returns the origin of the elements of a mesh that was made in two steps: `outer` leads to the
/// mesh in between and `inner` from there to the first.
ElementMap composed(const ElementMap& outer, const ElementMap& inner);
MeshMap composed(const MeshMap& outer, const MeshMap& inner);
/// The map of two meshes appended: elements of the second follow those of the first, as do the
/// elements they come from, `first_counts` of them in the first.
MeshMap appended_map(const MeshMap& first, const MeshMap& second, const Topology& first_origin);
/// composed(outer, appended_map(first, second, first_origin)), without forming the latter. `outer`
/// leads to the elements of `first_between` and, after these, to those of `second`; `first` leads
/// on from `first_between`, and is the identity if it is null.
MeshMap composed_of_two(const MeshMap& outer, const Topology& first_between, const MeshMap* first,
                        const MeshMap& second, const Topology& first_origin);
/// For each old vertex the new one that is nothing but it, or kNoIndex.
std::vector<Index> kept_vertices(const ElementMap& map, Index old_count);
/// For each new vertex its place on `second`, the second of two appended meshes, if the first
/// has `first_count` vertices: the weighted mean of its origins there, or NaN without any.
std::vector<Vec3> places_on_second(const MeshMap& map, const Mesh& second, Index first_count);

/// The same of the first mesh, whose elements keep their numbers.
std::vector<Vec3> places_on_first(const MeshMap& map, const Mesh& first);

}  // namespace lissom
