/// The surface that mirror images of handles are sought on; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/box_tree.h"

namespace lissom {

/// The point of a surface that is nearest to a mirror image.
struct MirrorFoot {
    Triangle corners{kNoIndex, kNoIndex, kNoIndex};
    Vec3 barycentric = Vec3::Zero();
    double distance = 0.0;
};

/// The vertices whose mirror image lies on those given, and how far from the surface the mirror
/// images of those given lie.
struct MirroredVertices {
    /// Ascending, all of them in the region.
    std::vector<Index> vertices;
    /// Distance of each given vertex, in their order.
    std::vector<double> distances;
    /// Given vertices whose mirror image lies outside the region.
    std::vector<Index> outside;
};

/// The triangles of a patch with a reflection. It takes nothing for granted about the tessellation
/// of both sides.
class MirrorSurface {
  public:
    /// `patch` must outlive it; `mirror` is about the patch's origin.
    MirrorSurface(const Patch& patch, const Affine& mirror);

    /// Returns the point of the surface nearest to the mirror image of a vertex, among triangles
    /// that look the same way, so that the front of a thin part does not become its back.
    MirrorFoot foot_of(Index vertex) const;
    /// Returns the point nearest to the mirror image of a point, on any triangle.
    MirrorFoot foot_of(const Vec3& point) const;

    /// Returns the vertices that cover the mirror image of `vertices`: those nearest to the mirror
    /// images, and those whose own mirror image lies among `vertices`. On a symmetric mesh these
    /// are the counterparts.
    MirroredVertices mirrored(std::span<const Index> vertices) const;

  private:
    MirrorFoot nearest(const Vec3& point, const Vec3& facing) const;
    Vec3 area_normal(const Triangle& triangle) const;
    std::vector<Index> around(std::span<const Index> vertices, const std::vector<char>& given,
                              double farthest) const;

    const Patch& patch_;
    Affine mirror_;
    std::span<const Triangle> triangles_;
    /// By vertex, weighted by area.
    std::vector<Vec3> normals_;
    BoxTree boxes_;
};

}  // namespace lissom
