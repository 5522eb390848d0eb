/// BoundarySizes: the sizes of the surface between held vertices of different sizes, as a harmonic
/// function; private to kernel/deform.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_systems.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

class BoundarySizes {
  public:
    /// Returns `size` with those of all vertices interpolated from the known ones. Factors a system
    /// when sizes first differ. Errors: not_positive_definite; memory_limit; cancelled.
    std::vector<double> interpolated(const BoundarySystems& systems, std::vector<double> size,
                                     const Context& context);

  private:
    template <typename Use>
    void for_each_entry(const BoundarySystems& systems, const Use& use) const;
    void factor(const BoundarySystems& systems, const Context& context);
    void solve(const BoundarySystems& systems, std::vector<double>& size, const Context& context);

    std::unique_ptr<SparseSystem> system_;
    // The row of each vertex; kNoIndex for known ones.
    std::vector<Index> row_;
    Index rows_ = 0;
};

}  // namespace lissom
