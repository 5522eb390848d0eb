/// A part of one side of a seam while its triangles are changed; private to kernel/merge.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sheet/sheet_flip.h"
#include "kernel/merge/sheet/sheet_remesh.h"
#include "kernel/merge/sheet/sheet_rest.h"
#include "kernel/merge/sheet/sheet_star.h"
#include "kernel/merge/sheet/sheet_triangles.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Some faces of a mesh on one side of its seams, as triangles that can be split, collapsed,
/// flipped and moved. The edges around them stay, and features do: edges that are sharp, and
/// borders of charts and labels. A vertex between two feature edges in line slides along them.
/// No change makes a dihedral angle greater than the limits and the greatest of the edges around
/// it, or turns a triangle over.
class SeamSheet {
  public:
    /// The faces `faces` of `mesh`. Edges with a dihedral angle above `sharp` are features. The
    /// mesh must outlive the sheet.
    SeamSheet(const Mesh& mesh, std::vector<Index> faces, std::span<const std::vector<Index>> seams,
              double sharp, const Context& context);

    /// As flip_edges of a sheet, and remesh.
    Index flip_edges(const SheetLimits& limits, const Context& context);
    void remesh(const SheetSize& size, const SheetLimits& limits, const SheetLimits& flips,
                const Context& context);

    const Mesh& mesh() const { return mesh_; }
    /// The faces of the mesh that the sheet stands for.
    const std::vector<Index>& faces() const { return faces_; }
    Index vertex_count() const { return now_.vertex_count(); }
    /// The vertex of the mesh, or kNoIndex for one that was made.
    Index mesh_vertex(Index v) const { return now_.mesh_vertex[at(v)]; }
    const Vec3& position(Index v) const { return now_.x[at(v)]; }
    /// False for a vertex that was collapsed.
    bool is_used(Index v) const { return !now_.around[at(v)].empty(); }
    bool has_moved(Index v) const;
    /// Triangles that are there now.
    std::vector<Triangle> triangles() const;

    /// Returns the sources of a vertex that was made or has moved: vertices of the mesh.
    std::vector<ElementMap::Source> vertex_sources(Index v) const;
    /// The face of the mesh that a triangle comes from.
    Index face_source(const Triangle& triangle) const;
    /// Returns the sources of the corner `k` of a triangle: corners of one face of the mesh.
    std::vector<ElementMap::Source> corner_sources(const Triangle& triangle, std::size_t k) const;

  private:
    Vec3 middle(const Triangle& t) const;

    const Mesh& mesh_;
    std::vector<Index> faces_;
    SheetTriangles now_;
    SheetRest rest_;
    FlipMemory memory_;
};

}  // namespace lissom
