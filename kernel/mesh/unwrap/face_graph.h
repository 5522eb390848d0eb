/// FaceGraph: the faces of a surface as the nodes of a graph, which edges join; private to
/// kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

class FaceGraph {
  public:
    /// `crease` as of UnwrapOptions. `mesh` must outlive it.
    FaceGraph(const Mesh& mesh, double crease);

    const Mesh& mesh() const { return mesh_; }
    double area(Index face) const { return areas_[at(face)]; }
    double area(std::span<const Index> faces) const;
    /// The corner that runs along the edge of a corner the other way, or kNoIndex.
    Index twin(Index corner) const { return twins_[at(corner)]; }
    Index face_of(Index corner) const { return faces_[at(corner)]; }
    Index next(Index corner) const;
    double edge_length(Index corner) const;
    /// Cost of the step across the edge of a corner, for parts as large as `size`: the way between
    /// the middles of the faces, and more at creases.
    double step(Index corner, double size) const;
    /// Sharpness of the edge of a corner: 0 up to 20 degrees, 1 at 110 degrees and above; of open
    /// boundaries 1.
    double sharpness(Index corner) const { return sharpness_[at(corner)]; }

  private:
    const Mesh& mesh_;
    double crease_ = 1.0;
    std::vector<Index> twins_, faces_;
    std::vector<double> areas_, sharpness_;
    std::vector<Vec3> middles_;
};

/// Parts of `faces` that edges join, in the order of their first faces.
std::vector<std::vector<Index>> connected_parts(const FaceGraph& graph,
                                                std::span<const Index> faces);

/// Parts of all faces between creases: edges at least as sharp as `sharpness` part them. Parts with
/// less than `least` of the whole area go to the neighbour with the longest common border.
std::vector<std::vector<Index>> parts_between_creases(const FaceGraph& graph, double sharpness,
                                                      double least);

/// Halves connected faces: those nearer to one of two faces far apart, by the cost of steps, and
/// the others. Each half is connected. There are two faces at least.
std::vector<std::vector<Index>> halves(const FaceGraph& graph, std::span<const Index> faces,
                                       const Context& context);

}  // namespace lissom
