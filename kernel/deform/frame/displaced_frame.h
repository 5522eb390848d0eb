/// A displacement of a frame by forces on its vertices; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/rotation_system.h"

namespace lissom {

/// A frame and a displacement u of its vertices. With K the matrix of the second system, forces f
/// displace it by
///     u = K^-1 (f + change of the rotations),
/// where the rotations are those that fit the displaced surface best, less those that fit the
/// frame: without them forces would shear the surface, and the frame stays the same beside them.
class DisplacedFrame {
  public:
    /// `frame` is a full one of `prepared`, which has the implicit method.
    DisplacedFrame(const Preparation& prepared, const DeformFrame& frame, const Context& context);

    const RotationSystem& system() const { return system_; }
    /// Returns the place of a local vertex among the free ones, or kNoIndex.
    Index free_row(Index local) const { return free_row_[at(local)]; }
    /// Returns the free local vertex of a vertex of the mesh, or kNoIndex.
    Index free_vertex(Index mesh_vertex) const;
    /// Positions of real local vertices in the frame, relative to the patch's origin.
    std::span<const Vec4> shape() const { return shape_; }
    /// The displacement, and the part of the rotations in it, of all local vertices.
    std::vector<Vec4>& displacement() { return displacement_; }
    std::span<const Vec4> displacement() const { return displacement_; }
    std::span<const Vec4> turned() const { return turned_; }

    /// Adds to `x` how all local vertices answer to forces on the free ones.
    void answer(std::span<const Vec3> force, std::span<Vec4> x, const Context& context);
    /// Forgets the part of the rotations.
    void forget_turns();
    /// Finds it anew, for the present displacement.
    void turn(const Context& context);
    /// Adds the displacement to the positions of the frame.
    void displace(DeformFrame& frame) const;

  private:
    void take_shape(const DeformFrame& frame);
    void fit(std::vector<Mat3>& rotations, const Context& context) const;

    const Preparation& prepared_;
    const RotationSystem& system_;
    std::vector<Index> free_row_, turning_;
    std::vector<Vec4> shape_;
    std::vector<Mat3> fitted_;
    std::vector<Vec4> displacement_, turned_;
    std::vector<PaddedMat3> change_;
    RotationSystem::Scratch scratch_;
};

}  // namespace lissom
