/// Motion of a head's skin from rest to another shape: places, normals and smoothed rotations of
/// vertices; private to kernel/hair.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

class HeadMotion {
  public:
    /// `rest`: places of all vertices, in any unit. Rotations are known at the vertices `active`,
    /// which ascend; they are smoothed over about the length `smoothing`.
    HeadMotion(std::vector<Vec3> rest, std::shared_ptr<const Topology> topology,
               std::vector<Index> active, double smoothing);

    /// Takes other places of all vertices, times `unit`. Errors: invalid_argument if the head is
    /// turned inside out or has no size.
    void move(std::span<const Vec3> positions, double unit, std::optional<double> scale,
              const Context& context);

    /// Takes the shape at rest again.
    void rest_again() { scale_ = 1.0; }

    const Topology& topology() const { return *topology_; }
    const std::vector<Vec3>& rest() const { return rest_; }
    const std::vector<Vec3>& places() const { return places_; }
    const std::vector<Index>& active() const { return active_; }
    /// Unit normals at rest and moved, of active vertices; zero where the faces have no area.
    const std::vector<Vec3>& rest_normals() const { return rest_normals_; }
    const std::vector<Vec3>& normals() const { return normals_; }
    /// Rotation of an active vertex as a unit quaternion (x, y, z, w); zero where it is not known.
    const std::vector<Vec4>& rotations() const { return rotations_; }
    /// Places and outward normals of vertices in 32-bit numbers.
    struct SkinVertex {
        Eigen::Array4f place = Eigen::Array4f::Zero(), normal = Eigen::Array4f::Zero();
    };
    const auto& skin() const { return skin_; }
    /// Factor of lengths: that asked for, or the one that most edges share.
    double scale() const { return scale_; }
    /// -1 for faces that look inward at rest, else 1.
    double outward() const { return rest_volume_ < 0.0 ? -1.0 : 1.0; }

  private:
    Vec3 normal_at(const std::vector<Vec3>& places, Index v) const;
    Vec4 rotation_at(Index v) const;
    void smooth(const Context& context);
    void pack(Index v);
    double found_scale();
    double volume_of(const std::vector<Vec3>& places) const;

    std::vector<Vec3> rest_, places_, rest_normals_, normals_;
    std::shared_ptr<const Topology> topology_;
    std::vector<Index> active_;
    std::vector<char> is_active_;
    std::vector<Vec4> rotations_, smoothed_;
    std::vector<SkinVertex, Eigen::aligned_allocator<SkinVertex>> skin_;
    /// Edges whose lengths are compared, and their ratios.
    std::vector<Index> edges_;
    std::vector<double> ratios_;
    int passes_ = 1;
    double rest_volume_ = 0.0, scale_ = 1.0;
};

/// Returns the mean of unit quaternions of either sign with these weights, as a unit quaternion;
/// the identity if none is known.
Eigen::Quaterniond mean_rotation(const Vec4& a, const Vec4& b, const Vec4& c, const Vec3& weights);

}  // namespace lissom
