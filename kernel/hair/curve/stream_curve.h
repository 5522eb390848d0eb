/// Stream curves: hair flows along them (thesis, section 4.5).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/curve/constraint_kind.h"
#include "kernel/hair/curve/fidelity.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// Lengths are in the unit of the mesh.
struct StreamOptions {
    /// Keeps hair from growing on beyond the end of the curve: the curve is extended straight by
    /// this length, with vectors that fade to 0; 0 for no extension.
    double stop_length = 0.04;
    /// omega of equation (4.2), 1e-6 to 1e9.
    double weight = 100.0;
    /// thesis: a grid point beside several segments takes the vector of the nearest one, not their
    /// mean, so that vectors along the curve are of unit length.
    HairFidelity fidelity = HairFidelity::lissom;

    bool operator==(const StreamOptions&) const = default;
};

/// Returns the constraints of a stream curve of segments about as long as the grid's step, from
/// root to tip: the corners of the cell that the middle of a segment lies in take its direction, of
/// unit length; corners of several segments their mean, by the trilinear weights of the corners.
/// Along the vanishing extension lengths fall evenly from 1 to 0. Corners outside the grid are left
/// out. Errors: as require_curve; invalid_argument for options out of range; out_of_range if the
/// whole curve lies outside the grid.
std::vector<GridConstraint> stream_constraints(const GridLayout& layout,
                                               std::span<const Vec3> points,
                                               const StreamOptions& options = {});

/// A straight line of this many steps that begins in the grid ends outside.
double steps_across(const GridLayout& layout);

/// Collects vectors for grid points: each point takes the mean of its vectors, by weight; with the
/// fidelity of the thesis, the one of the greatest weight.
class VectorSplat {
  public:
    explicit VectorSplat(const GridLayout& layout, HairFidelity fidelity = HairFidelity::lissom)
        : layout_(layout), fidelity_(fidelity) {}

    /// Gives `vector` to the corners of the cell that `point` lies in, by trilinear weights. False
    /// if all of them are outside the grid.
    bool add(const Vec3& point, const Vec3& vector, ConstraintKind kind);
    /// Gives `vector` to one grid point.
    void add_at(Index point, const Vec3& vector, double weight, ConstraintKind kind);

    /// Ascending by point; means are of the kind that a point was given first.
    std::vector<GridConstraint> constraints(double weight) const;

  private:
    struct Given {
        Index point = 0;
        double weight = 0.0;
        Vec3 sum = Vec3::Zero();
        ConstraintKind kind = ConstraintKind::stream;
    };

    // Returns the vector of a point that was given these.
    Given taken(std::span<const Given> given) const;

    GridLayout layout_;
    HairFidelity fidelity_;
    std::vector<Given> given_;
};

}  // namespace lissom
