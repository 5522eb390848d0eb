#include "kernel/deform/system/gradient_residual.h"

#include <algorithm>

#include "kernel/deform/system/gradient_system.h"

namespace lissom {

GradientResidual::GradientResidual(const WorkingPatch& work, const GradientStencils& gradients,
                                   const KnownMask& known, const DeformOptions& options)
    : work_(work),
      gradients_(gradients),
      known_(known),
      options_(options),
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

// |D(x) - M delta|^2 at v. Its part through M goes to `pull`.
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
        const double weight = edge_coherence(options_, work_.geometry.cotangent[e]);
        pull -= options_.coherence_weight * weight * (m[v] - m[n]);
    }
    if (options_.coherence == 2) add_second_ring(v, m, pull);
}

void GradientResidual::add_second_ring(Index v, const std::vector<Mat3>& m, Mat3& pull) const {
    const std::span<const Index> ring = work_.rings.ring(v);
    std::vector<Index> second;
    for (const Index n : ring) {
        for (const Index far : work_.rings.ring(n)) {
            const bool near = far == v || std::binary_search(ring.begin(), ring.end(), far);
            if (!near && has_gradient(far)) second.push_back(far);
        }
    }
    std::sort(second.begin(), second.end());
    second.erase(std::unique(second.begin(), second.end()), second.end());
    const double weight = options_.coherence_weight * second_ring_coherence(options_);
    for (const Index far : second) pull -= weight * (m[v] - m[far]);
}

void GradientResidual::scatter(Index v, const Mat3& pull, std::vector<Vec3>& residual) const {
    residual[v] += pull * gradients_.self[v];
    for (Index e = work_.rings.begin[v]; e < work_.rings.begin[v + 1]; ++e) {
        residual[work_.rings.neighbor[e]] += pull * gradients_.neighbor[e];
    }
}

std::vector<Vec3> GradientResidual::find(std::span<const Vec3> x, std::span<const Mat3> m,
                                         std::vector<Mat3>* pulls) const {
    if (pulls) pulls->assign(work_.rings.size(), Mat3::Zero());
    const std::vector<Mat3> gradient = all_gradients(x, m);
    std::vector<Vec3> residual(work_.rings.size(), Vec3::Zero());
    for (Index v = 0; v < work_.rings.size(); ++v) {
        if (!has_gradient(v)) continue;
        Mat3 pull = Mat3::Zero();
        if (work_.laplacian.weight[v] > 0.0) add_laplacian_term(v, x, gradient[v], residual, pull);
        if (known_.gradient[v] && !pulls) continue;
        add_coherence_term(v, gradient, pull);
        if (known_.gradient[v]) {
            (*pulls)[v] = pull;
        } else {
            scatter(v, pull, residual);
        }
    }
    return residual;
}

}  // namespace lissom
