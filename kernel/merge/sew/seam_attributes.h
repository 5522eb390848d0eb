/// Attributes of sewn meshes along a seam; private to kernel/merge.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

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

/// Gives the corners at each vertex of the seams one displacement by every morph target: half of
/// each side, or that of the side that has one, so that a target does not tear the seam open.
/// Corners of one side keep their differences.
void close_morphs(std::span<const std::vector<Index>> seams, std::span<const SeamSide> side_of_face,
                  Mesh& mesh);

/// The "normal" attribute of a mesh around a seam that moves. Costs nothing if there is none.
class SeamNormals {
  public:
    /// `moving` are vertices that will move.
    SeamNormals(Mesh& mesh, std::vector<Index> moving);
    /// Turns the normals of the vertices that moved with the surface, and gives those on the seams
    /// the normal of the surface.
    void follow(std::span<const std::vector<Index>> seams);

  private:
    Mesh& mesh_;
    Attribute* normals_ = nullptr;
    std::vector<Index> moving_;
    std::vector<Vec3> before_;
};

}  // namespace lissom
