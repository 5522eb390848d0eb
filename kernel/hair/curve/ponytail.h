/// Ponytails: a spine with circles around it that hair is gathered into (thesis, section 4.5,
/// Figure 4.5).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/curve/fidelity.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// Lengths are in the unit of the grid; absent ones follow from its step.
struct PonytailOptions {
    /// Radius of the first cross section C1, the tie. If absent, that of `section`, else the
    /// distance of `profiles` from the spine at C1, else 1.5 steps.
    std::optional<double> radius = std::nullopt;
    /// A polyline drawn around the spine, closed by the way from its last point to its first, which
    /// is at most 0.75 of its width. It is read as a circle from any view: its radius is half of
    /// its extent across the spine, or its mean distance from its center if the spine runs along
    /// the normal of the polyline's plane. C1 is its point nearest to the spine. Empty for none: C1
    /// is at the beginning of the profiles, else of the spine.
    std::vector<Vec3> section;
    /// Polylines along the spine on either side, in any direction: the range of both has cross
    /// sections, C1 to C2; their radius is the mean distance of the profiles from the spine at each
    /// place, in the ratio to that at C1. Empty for none; one alone stands for both.
    std::array<std::vector<Vec3>, 2> profiles;
    /// Without profiles: C2 is at this share of the spine's length behind C1, 0 to 1, and the tail
    /// swells to 1 + fullness radii over its first half, and narrows to its end.
    double share = 0.7, fullness = 1.0;
    /// Radii in multiples of that of C1: hair is drawn to the middle of C1 between them (R1 and R2
    /// of the thesis), in a ring at least `ring` wide, as grids are coarse, and from `lead` in
    /// front of C1 on. 2.5 and 1.5 steps.
    double inner = 1.3, outer = 1.9;
    std::optional<double> ring = std::nullopt, lead = std::nullopt;
    /// Magnitude of the vectors in the ring, 0 to 1; 0 gives none.
    double tightness = 0.6;
    /// Grip of the tail on its hair: just outside its outline vectors turn inward by this slope a
    /// step of the grid. 0: none, as in the thesis.
    double grip = 4.0;
    /// Hair flows on towards the spine behind the tie. From there to half the way to C2 its
    /// distances from the spine grow by exp(spread) more than the outline does. 0 for not, as in
    /// the thesis.
    double spread = 2.0;
    /// The tail's vectors are left out at points nearer to the head than this, farther than that
    /// from C1 and behind it: so a tail that falls along the neck does not catch the hair that
    /// grows there. 0 leaves none out. 1.5 steps.
    std::optional<double> clearance = std::nullopt;
    /// Like StreamOptions::stop_length: beyond the end of the spine.
    double stop_length = 0.04;
    /// omega of equation (4.2), 1e-6 to 1e9.
    double weight = 100.0;
    /// thesis: the ring is that from R1 to R2 at the grid points nearest to the plane of C1, up to
    /// half a step from it, and counts before the cross sections; `ring` and `clearance` are 0 and
    /// `lead` half a step if absent; the spine is followed as StreamOptions::fidelity says.
    HairFidelity fidelity = HairFidelity::lissom;

    bool operator==(const PonytailOptions&) const = default;
};

/// Returns the options with the lengths that follow from the step of a grid, except the radius,
/// which follows from the drawing.
PonytailOptions with_lengths(PonytailOptions options, double step);

/// A circle around the spine.
struct PonytailSection {
    Vec3 center = Vec3::Zero();
    /// Direction of the spine towards its end, of unit length.
    Vec3 direction = Vec3::Zero();
    double radius = 0.0;
};

struct PonytailShape {
    /// From root to tip, in segments about as long as the step; the centers of C1 and C2 are two of
    /// its points.
    std::vector<Vec3> spine;
    /// At every point of the spine from C1 to C2, which come first and last.
    std::vector<PonytailSection> sections;
    /// Place of C1 in `spine`; C2 is sections.size() - 1 behind it.
    std::size_t first = 0;

    const PonytailSection& tie() const { return sections.front(); }
    std::size_t last() const { return first + sections.size() - 1; }
};

/// Errors: as require_curve for the spine, `section` and `profiles`; invalid_argument for options
/// out of range, a section that is open or that the spine does not pass through, profiles beyond
/// its ends, that cross it, lie on one side of it or along different parts of it.
PonytailShape ponytail_shape(std::span<const Vec3> spine, double step,
                             const PonytailOptions& options = {});

/// Returns the constraints of a ponytail, ascending by point: near the cross sections the
/// directions of the surface of revolution, between its spine and its outline (purple in the
/// figure); along the rest of the spine those of a stream curve (blue); around C1, outside the
/// head, vectors of length `tightness` to its center (green). If kinds meet at a point, the first
/// of these counts. With `grip`, points up to a step in front of C1 and near its axis lead into it,
/// which is not in the thesis. Errors: invalid_argument for options out of range, for a tie that is
/// wider than the grid or has its center inside the head, with the fidelity of the thesis for a
/// ring without a grid point; out_of_range if the whole spine lies outside the grid.
std::vector<GridConstraint> ponytail_constraints(const DistanceGrid& distances,
                                                 const PonytailShape& shape,
                                                 const PonytailOptions& options = {});

}  // namespace lissom
