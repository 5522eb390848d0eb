/// The residual of the first system (Eq 2.8) from its energy instead of its matrix; private to
/// kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/gradients.h"

namespace lissom {

/// Half the downward gradient of E_L + E_R. The entries of the matrix are sums of products, whose
/// rounding errors grow by its condition; terms of the energy are evaluated one by one here, and
/// theirs by its square root only. For a patch without ties or stiffness.
class GradientResidual {
  public:
    /// All must live as long.
    GradientResidual(const WorkingPatch& work, const GradientStencils& gradients,
                     const KnownMask& known, const DeformOptions& options);

    /// Returns the residual at positions `x` of all local vertices and the known ones of the
    /// gradients `m`; both may be deviations from an affine map. One value a local vertex. `pulls`,
    /// if any, becomes the same by the known gradients.
    std::vector<Vec3> find(std::span<const Vec3> x, std::span<const Mat3> m,
                           std::vector<Mat3>* pulls = nullptr) const;

  private:
    bool has_gradient(Index v) const { return known_.gradient[at(v)] || gradients_.defined[at(v)]; }
    std::vector<Mat3> all_gradients(std::span<const Vec3> x, std::span<const Mat3> m) const;
    void add_laplacian_term(Index v, std::span<const Vec3> x, const Mat3& m,
                            std::vector<Vec3>& residual, Mat3& pull) const;
    void add_coherence_term(Index v, const std::vector<Mat3>& m, Mat3& pull) const;
    void add_second_ring(Index v, const std::vector<Mat3>& m, Mat3& pull) const;
    void scatter(Index v, const Mat3& pull, std::vector<Vec3>& residual) const;

    const WorkingPatch& work_;
    const GradientStencils& gradients_;
    const KnownMask& known_;
    DeformOptions options_;
    std::vector<Vec3> delta_;
};

}  // namespace lissom
