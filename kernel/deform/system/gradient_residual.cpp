#include "kernel/deform/system/gradient_residual.h"

#include "kernel/deform/system/gradient_system.h"

namespace lissom {

GradientResidual::GradientResidual(const WorkingPatch& work, const GradientStencils& gradients,
                                   const KnownMask& known, double coherence_weight)
    : work_(work),
      gradients_(gradients),
      known_(known),
      coherence_weight_(coherence_weight),
      delta_(work.rings.size(), Vec3::Zero()) {
    for (Index v = 0; v < work.rings.size(); ++v) {
        if (has_gradient(v))
            delta_[v] = work.laplacian.apply(work.rings, gradients.displaced_rest, v);
    }
}

std::vector<Mat3> GradientResidual::all_gradients(std::span<const Vec3> x,
                                                  std::span<const Mat3> m) const {
    std::vector<Mat3> all(work_.rings.size(), Mat3::Zero());
    for (Index v = 0; v < work_.rings.size(); ++v) {
        if (known_.gradient[v]) {
            all[v] = m[v];
        } else if (gradients_.defined[v]) {
            all[v] = gradients_.gather(work_.rings, x, v);
        }
    }
    return all;
}

// |D(x) - M delta|^2 at v. What it gives through M goes to `pull`.
void GradientResidual::add_laplacian_term(Index v, std::span<const Vec3> x, const Mat3& m,
                                          std::vector<Vec3>& residual, Mat3& pull) const {
    const Laplacian& laplacian = work_.laplacian;
    const Vec3 left = laplacian.weight[v] * (laplacian.apply(work_.rings, x, v) - m * delta_[v]);
    residual[v] -= laplacian.self[v] * left;
    for (Index e = work_.rings.begin[v]; e < work_.rings.begin[v + 1]; ++e) {
        residual[work_.rings.neighbor[e]] -= laplacian.neighbor[e] * left;
    }
    pull += left * delta_[v].transpose();
}

// The pairs of Eq 2.7 that v is in.
void GradientResidual::add_coherence_term(Index v, const std::vector<Mat3>& m, Mat3& pull) const {
    for (Index e = work_.rings.begin[v]; e < work_.rings.begin[v + 1]; ++e) {
        const Index n = work_.rings.neighbor[e];
        if (!has_gradient(n)) continue;
        const double weight = scale_free_coherence(work_.geometry.cotangent[e]);
        pull -= coherence_weight_ * weight * (m[v] - m[n]);
    }
}

void GradientResidual::scatter(Index v, const Mat3& pull, std::vector<Vec3>& residual) const {
    residual[v] += pull * gradients_.self[v];
    for (Index e = work_.rings.begin[v]; e < work_.rings.begin[v + 1]; ++e) {
        residual[work_.rings.neighbor[e]] += pull * gradients_.neighbor[e];
    }
}

std::vector<Vec3> GradientResidual::find(std::span<const Vec3> x, std::span<const Mat3> m) const {
    const std::vector<Mat3> gradient = all_gradients(x, m);
    std::vector<Vec3> residual(work_.rings.size(), Vec3::Zero());
    for (Index v = 0; v < work_.rings.size(); ++v) {
        if (!has_gradient(v)) continue;
        Mat3 pull = Mat3::Zero();
        if (work_.laplacian.weight[v] > 0.0) add_laplacian_term(v, x, gradient[v], residual, pull);
        if (known_.gradient[v]) continue;
        add_coherence_term(v, gradient, pull);
        scatter(v, pull, residual);
    }
    return residual;
}

}  // namespace lissom
