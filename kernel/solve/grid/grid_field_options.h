/// Options of a GridField.
#pragma once

#include <cstddef>
#include <optional>

#include "kernel/core/geometry.h"

namespace lissom {

/// Weights of the Laplacian of (4.1) at the faces of the grid.
enum class GridBoundary {
    /// 1/6 for each neighbour everywhere, as if the field went on mirrored behind the faces.
    zero_flux,
    /// 1 / |N(i)|, as the thesis has it: rows at faces, edges and corners weigh more.
    thesis,
};

enum class GridSolver {
    /// The unknowns are the multipliers of the constraints; the field follows by a cosine
    /// transform.
    dual,
    /// The unknowns are the vectors at all points; one sparse factor is updated and downdated with
    /// the constraints, as in section 4.4.2 of the thesis. Slow: the reference.
    cholesky,
};

struct GridFieldOptions {
    GridBoundary boundary = GridBoundary::zero_flux;
    GridSolver solver = GridSolver::dual;
    /// tau >= 0: adds (tau / 6) |t_i - t_j|^2 for each edge of the grid to the energy (4.1). The
    /// biharmonic field overshoots away from the constraints; 0.03 takes most of that away.
    double tension = 0.0;
    /// Constraints from which on the dual solver iterates: its dense factor takes about 10 bytes
    /// for the square of their number. By default 3000, and on large grids, with their costlier
    /// iterations, up to 6000: 8 times the root of the number of points.
    std::optional<Index> dense_limit = std::nullopt;
    /// Iterations, of the dual solver beyond `dense_limit` and for the thesis's boundary, end at
    /// this fraction of the greatest given component; 1e-12 to 1e-2.
    double tolerance = 1e-6;
    /// Further solves, for the residual in double precision. Without them the field is accurate to
    /// 1e-9 or better.
    int refinements = 0;
};

/// Costs of a grid's factorisations so far.
struct GridCholeskyStats {
    /// Factorisations from nothing, and constraints added to or taken from a factor.
    Index factorisations = 0, updated = 0;
    std::size_t factor_nonzeros = 0;
};

}  // namespace lissom
