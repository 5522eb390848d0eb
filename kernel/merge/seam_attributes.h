/// What sewn meshes carry along a seam; private to kernel/merge.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Target and source as one mesh, not connected. Texture coordinates and tangents of vertices are
/// made those of corners, since two charts must not be averaged where they meet.
Mesh unconnected(const Mesh& target, const Mesh& source, const Context& context);

/// The vertices of a mesh that a seam vertex lies on or between, on each side, with weights.
struct SeamSources {
    std::vector<ElementMap::Source> target, source;

    /// Half of each side.
    std::vector<ElementMap::Source> blend() const;
};

/// Puts vertices on seams into the regions that hold all their sources of either side. Keys are
/// vertices of `old`, whose number in `mesh` is in `new_number`.
void carry_seam_regions(const Mesh& old, const std::unordered_map<Index, SeamSources>& sources,
                        std::span<const Index> new_number, Mesh& mesh);

/// Replaces "normal" attributes of the given vertices by those of the surface.
void renew_normals(Mesh& mesh, std::span<const Index> vertices);

}  // namespace lissom
