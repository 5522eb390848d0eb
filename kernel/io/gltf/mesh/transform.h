/// Transforms of vertex values by nodes; private to kernel/io.
#pragma once

#include <span>

#include "kernel/core/geometry.h"
#include "kernel/io/gltf/mesh/names.h"

namespace lissom {

/// The transform of a node, applied to values of vertices in place. A value without numbers stays
/// so.
class NodeTransform {
  public:
    explicit NodeTransform(const Affine& transform);
    /// Returns the way back; of a transform that flattens, the least squares one.
    NodeTransform inverse() const;

    /// Returns the same with positions moved by `offset` afterwards.
    NodeTransform moved(const Vec3& offset) const;

    bool is_identity() const { return transform_.is_identity(); }
    /// Returns true if faces have to be turned over to keep their outside.
    bool mirrors() const { return mirrors_; }
    Vec3 position(const Vec3& p) const { return transform_(p); }
    /// Unit again, or NaN if there is no direction.
    void turn_normal(std::span<double> n) const;
    /// Direction and handedness.
    void turn_tangent(std::span<double> t) const;
    /// Turns the offset of a position, normal or tangent by a morph target.
    void turn_delta(GltfSemantic semantic, std::span<double> delta) const;

  private:
    NodeTransform(const Affine& transform, const Mat3& normals, double scale);

    Affine transform_;
    // For normals; without scale if the transform has the same in all directions.
    Mat3 normals_ = Mat3::Identity();
    // Lengths along the transform, on average.
    double scale_ = 1.0;
    bool mirrors_ = false;
};

}  // namespace lissom
