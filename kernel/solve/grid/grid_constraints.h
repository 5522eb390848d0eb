/// GridConstraints: known vectors at points of a grid, each given by an owner.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// Owner of constraints, for instance a curve: a number of the caller's choice.
using ConstraintOwner = std::int64_t;

/// A vector that is known at a grid point.
struct GridConstraint {
    Index point = 0;
    Vec3 value = Vec3::Zero();
    /// The square of the weight omega of equation (4.2).
    double weight = 100.0;
    /// For the caller to tell constraints apart; the field does not read it.
    int tag = 0;

    bool operator==(const GridConstraint&) const = default;
};

/// All constraints at one grid point as one.
struct MergedConstraint {
    Index point = 0;
    double weight = 0.0;
    Vec3 value = Vec3::Zero();
    /// Time of its owners' last change of points or weights; of several owners, the earliest.
    std::uint64_t stamp = 0;
};

/// The constraints of all owners. Several owners may constrain one point; it stands in the system
/// once, with the average of their values by w^2 and the greatest of their weights. So the result
/// does not depend on the order of edits, and an owner that comes to a point or leaves it does not
/// change the matrix as long as another is there.
class GridConstraints {
  public:
    explicit GridConstraints(const GridSize& size) : size_(size) {}

    /// Replaces all constraints of `owner`; none removes it. Errors: out_of_range for a point
    /// outside the grid; not_finite; invalid_argument for a weight that is not positive or a point
    /// that the owner gives twice.
    void set(ConstraintOwner owner, std::vector<GridConstraint> constraints);
    void clear();

    /// Returns the constraints of `owner`; empty if it has none.
    std::span<const GridConstraint> of(ConstraintOwner owner) const;
    std::vector<ConstraintOwner> owners() const;

    /// Returns one constraint a point, ascending by point.
    std::vector<MergedConstraint> merged() const;
    /// Grows with every change.
    std::uint64_t version() const { return version_; }

  private:
    struct Owned {
        std::vector<GridConstraint> constraints;
        std::uint64_t stamp = 0;
    };

    GridSize size_;
    std::map<ConstraintOwner, Owned> owners_;
    std::uint64_t stamp_ = 0, version_ = 0;
};

}  // namespace lissom
