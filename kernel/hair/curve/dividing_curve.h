/// Dividing curves: partings with hair flowing away to both sides (thesis, section 4.5, Figure
/// 4.4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/curve/fidelity.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// Lengths are in the unit of the grid; absent ones follow from its step.
struct DividingOptions {
    /// Rotation of the flow away from the curve, towards its last point, in radians from -pi / 2 to
    /// pi / 2, at its two ends; between them it changes evenly with the arc length.
    struct Tilt {
        double start = 0.0, end = 0.0;

        bool operator==(const Tilt&) const = default;
    };
    /// Sides as seen from outside by one who looks along the curve with the normal up. Equal tilts
    /// are mirror images.
    Tilt left, right;
    /// Shape of the Gaussian that hair follows: it rises from the curve, its inflexion, to its top
    /// a distance `sigma` away. `height` is h of the thesis, the Gaussian's factor: the top stands
    /// 0.39 h above the skin. 1 and 0.5 steps.
    std::optional<double> sigma = std::nullopt, height = std::nullopt;
    /// Points at most `reach` from the curve across and `thickness` from the Gaussian in height
    /// take its direction (blue in the figure). 2.5 sigma and 0.8 steps.
    std::optional<double> reach = std::nullopt, thickness = std::nullopt;
    /// Magnitude of the vectors that keep the sides apart (red), 0 to 1; 0 gives none.
    double separation = 0.3;
    /// They stand at points at most `wall_width` from the curve across and between the Gaussian and
    /// `wall_height` above it. 1.2 and 2.6 steps.
    std::optional<double> wall_width = std::nullopt, wall_height = std::nullopt;
    /// Within this distance across the curve, the across-component of vectors fades linearly to 0,
    /// so that the interpolated field changes side at the curve and not at a grid point. 0: no
    /// fade, as the thesis has it. 0.87 steps, half the diagonal of a cell.
    std::optional<double> ramp = std::nullopt;
    /// omega of equation (4.2), 1e-6 to 1e9.
    double weight = 100.0;
    /// thesis: u and v are coordinates in the local xy-planes of Figure 4.4, which the tilt turns,
    /// and vectors lie in them; `ramp` is 0 if absent.
    HairFidelity fidelity = HairFidelity::lissom;

    bool operator==(const DividingOptions&) const = default;
};

/// Returns the options with the lengths that follow from the step of a grid.
DividingOptions with_lengths(DividingOptions options, double step);

/// Position of a point relative to the nearest point of a dividing curve.
struct DividingPlace {
    /// Across, positive on the right.
    double across = 0.0;
    /// Along the normal of the scalp.
    double height = 0.0;
    /// Beyond the ends along the curve: negative before its first point, positive after its last
    /// one, else 0.
    double beyond = 0.0;
    /// Share of the arc length, 0 to 1.
    double along = 0.0;
    /// Local frame, orthonormal: of the curve, outward from the scalp, and to the right.
    Vec3 tangent = Vec3::Zero(), normal = Vec3::Zero(), right = Vec3::Zero();
};

/// A line on the scalp with its local frames.
class DividingLine {
  public:
    /// `normals` point outward, one a point, of any length. Errors: as require_curve;
    /// invalid_argument if there are not as many normals as points, or one is along the curve;
    /// not_finite.
    DividingLine(std::span<const Vec3> points, std::span<const Vec3> normals);

    /// Returns the position relative to the nearest point of the line. The first of several counts.
    DividingPlace place(const Vec3& point) const;
    /// Distance of a point of the scalp to the line along the skin. For the gap of bare skin: no
    /// roots if it is less than kPartingGap / 2.
    double skin_distance(const Vec3& point) const;
    double length() const { return lengths_.back(); }

  private:
    std::vector<Vec3> points_, tangents_, normals_;
    /// Arc length up to each point.
    std::vector<double> lengths_;
    double longest_segment_ = 0.0;
};

/// Width of the bare skin at a parting, in metres.
inline constexpr double kPartingGap = 0.0024;

/// Returns the constraints of a dividing curve of segments about as long as the grid's step that
/// lies on the scalp; each grid point belongs to the nearest point of the curve. With u the
/// distance across and v the signed distance to the head, hair follows the Gaussian
///     g(u) = h (exp(-(u - sigma)^2 / 2 sigma^2) - exp(-1/2))
/// away from the curve: points at |v - g(u)| < thickness take the unit tangent of the surface g in
/// the direction that is turned by the tilt. Above them stand vectors of length `separation` that
/// point away from the curve, too. Points on the curve's plane belong to no side and take none; nor
/// do those beyond the curve's ends by more than half a step. Ascending by point. With the fidelity
/// of the thesis each grid point belongs to the local plane that contains it, the one with the
/// nearest origin among several; the head is ignored. Errors: as DividingLine; invalid_argument for
/// options out of range; out_of_range if the grid has no point near the curve, or the curve is
/// nowhere near the head.
std::vector<GridConstraint> dividing_constraints(const DistanceGrid& distances,
                                                 std::span<const Vec3> points,
                                                 std::span<const Vec3> normals,
                                                 const DividingOptions& options = {});

}  // namespace lissom
