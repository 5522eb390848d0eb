/// A smooth closed curve on a surface and distances to it along the surface, whose contours cuts
/// follow; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/cut/contour.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A point of a curve nearest to another one.
struct CurvePlace {
    /// Fraction of the curve's length, 0 to 1.
    double parameter = 0.0;
    /// Distance in space.
    double distance = 0.0;
    /// Distance to the left, along the surface's tangent plane at the curve; negative to the right.
    double left = 0.0;
};

class SurfaceCurve {
  public:
    /// The closed polyline through `vertices`, sampled evenly and smoothed by a Gaussian with the
    /// given fraction of its length as standard deviation; `normals` are those of all vertices.
    /// Errors: invalid_argument for a line without length.
    SurfaceCurve(const Mesh& mesh, std::span<const Index> vertices,
                 const std::vector<Vec3>& normals, double smoothing);

    double length() const { return length_; }
    /// Returns the nearest place of the whole curve, or of the part within `window` of its length
    /// to both sides of `around`.
    CurvePlace nearest(const Vec3& p) const;
    CurvePlace nearest(const Vec3& p, double around, double window) const;

  private:
    void sample(std::span<const Vec3> points, std::span<const Vec3> normals);
    void smooth(double sigma);
    void find_left();
    CurvePlace nearest_among(const Vec3& p, Index first, Index count) const;

    std::vector<Vec3> points_, normals_, left_;
    double length_ = 0.0;
};

/// Distances to the left of a curve, on the vertices near it.
struct CurveDistances {
    /// NaN beyond the band.
    std::vector<double> left;
    /// Places along the curve, as fractions of its length.
    std::vector<double> parameter;
};

/// Distances of the vertices around `seeds`, the vertices that the curve came from, as far as
/// edges lead without going farther than `width` from the curve.
CurveDistances distances_to_curve(const Mesh& mesh, const SurfaceCurve& curve,
                                  std::span<const Index> seeds, double width,
                                  const Context& context);

/// Returns the contour of `levels` that runs once along the whole curve, in its direction; of
/// several the shortest. None: an empty list.
std::vector<ContourLine> contour_along(const Mesh& mesh, const LevelSet& levels,
                                       const CurveDistances& distances, const Context& context);

/// Mean length of the edges at the given vertices.
double edge_length_at(const Mesh& mesh, std::span<const Index> vertices);

}  // namespace lissom
