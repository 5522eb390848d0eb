/// GridLaplacian: the operator of a grid field as a stencil and as a matrix; private to
/// kernel/solve.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_field_options.h"
#include "kernel/solve/grid/grid_size.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// The operator A0 = D'D + (tau / 6) L of equation (4.3) with the tension tau: L is the graph
/// Laplacian of the grid, D = -S L with S = 1/6 or 1 / |N(i)|, so that A0 = L S^2 L + (tau / 6) L.
class GridLaplacian {
  public:
    GridLaplacian(const GridSize& size, GridBoundary boundary, double tension)
        : size_(size), boundary_(boundary), tension_(tension) {}

    const GridSize& size() const { return size_; }
    /// y = A0 x for three fields, component by component; `scratch` is as large.
    void apply(const double* x, double* y, double* scratch, const Context& context) const;
    /// A0 as a matrix.
    SymmetricMatrix matrix() const;

  private:
    Index neighbors(const GridPoint& p) const;
    double square_weight(const GridPoint& p) const;

    GridSize size_;
    GridBoundary boundary_;
    double tension_;
};

}  // namespace lissom
