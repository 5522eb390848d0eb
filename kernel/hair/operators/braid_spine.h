/// The middle of a braid as a smooth curve with a frame; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

class BraidSpine {
  public:
    /// Takes points in metres, evenly spaced and smoothed; two must differ. The frame begins
    /// with the direction `across` and turns as little as possible.
    BraidSpine(const std::vector<Vec3>& points, const Vec3& across);

    double length() const { return arcs_.back(); }
    const Vec3& start() const { return points_.front(); }
    const Vec3& direction() const { return tangents_.front(); }

    /// Returns the place x across, z towards the viewer and t along, from the spine's point at an
    /// arc; beyond its end the spine goes on straight.
    Vec3 place(double arc, double x, double z, double t) const;

    /// A place by the spine: how far along it, and the offset from there.
    struct Nearest {
        double arc = 0.0, distance = 0.0;
    };
    /// Returns the nearest point of the spine, of those up to the arc `most`.
    Nearest nearest(const Vec3& point, double most) const;
    /// Returns the coordinates of a vector at an arc: across, towards the viewer and along.
    Vec3 local(double arc, const Vec3& vector) const;

  private:
    struct Frame {
        Vec3 origin, normal, tangent;
    };
    Frame frame_at(double arc) const;

    std::vector<Vec3> points_, normals_, tangents_;
    std::vector<double> arcs_;
};

/// Errors: invalid_argument for points that are not finite or all the same, or for a direction
/// across that is zero.
void require_spine(const std::vector<Vec3>& spine, const Vec3& across);

}  // namespace lissom
