#include "kernel/deform/constraints.h"

#include <Eigen/Eigenvalues>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Positions count as one plane where their covariance is flatter than this.
constexpr double kFlat = 1e-10;

// What holds one connected part of the patch.
struct Part {
    Elements free{ElementKind::vertex, 0, {}};
    bool has_gradient = false;
    double positions = 0.0;
    Vec3 sum = Vec3::Zero();
    Mat3 products = Mat3::Zero();

    bool spans_space() const {
        if (positions < 4.0) return false;
        const Mat3 covariance =
            products / positions - sum * sum.transpose() / (positions * positions);
        const Vec3 values =
            Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
        return values[0] > kFlat * values[2];
    }
};

void add_vertex(const Patch& patch, const Knowledge& known, Index v, Part& part) {
    part.has_gradient = part.has_gradient || known.gradient[v];
    if (known.position[v]) {
        part.positions += 1.0;
        part.sum += patch.rest[v];
        part.products += patch.rest[v] * patch.rest[v].transpose();
    } else if (v < patch.real_count) {
        part.free.add(patch.mesh_vertex[v]);
    }
}

Part collect_part(const Patch& patch, const Rings& rings, const Knowledge& known, Index start,
                  std::vector<char>& seen) {
    Part part;
    std::vector<Index> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
        const Index v = stack.back();
        stack.pop_back();
        add_vertex(patch, known, v, part);
        for (const Index n : rings.ring(v)) {
            if (!std::exchange(seen[n], 1)) stack.push_back(n);
        }
    }
    return part;
}

void require_held(Part part) {
    if (part.free.count == 0) return;
    if (part.positions > 0.0 && (part.has_gradient || part.spans_space())) return;
    const std::string names = describe(part.free);
    const std::string remedy =
        part.positions == 0.0
            ? "no position is prescribed; add a handle there, or leave a part out of the region"
            : "its positions alone do not say how it turns; prescribe a gradient, or four "
              "positions "
              "that are not in one plane";
    throw Error(ErrorCode::unconstrained,
                "nothing holds the connected part of " + names + ": " + remedy,
                std::move(part.free));
}

}  // namespace

std::vector<Index> find_owners(const Patch& patch, const Rings& rings,
                               const std::vector<HandleState>& handles,
                               const VertexConstraints& constraints) {
    std::vector<Index> owner(static_cast<std::size_t>(patch.vertex_count), kPinned);
    for (Index i = 0; i < patch.vertex_count; ++i) {
        if (patch.in_region[i] && rings.count(i) > 0) owner[i] = kFree;
    }
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (handles[h].removed) continue;
        for (const Index v : handles[h].local) owner[v] = static_cast<Index>(h);
    }
    for (const auto& entry : constraints) owner[entry.first] = kConstrained;
    return owner;
}

Knowledge find_knowledge(const Patch& patch, const Rings& rings, const std::vector<Index>& owner,
                         const std::vector<HandleState>& handles,
                         const VertexConstraints& constraints) {
    const auto n = static_cast<std::size_t>(patch.vertex_count);
    Knowledge known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 0)};
    for (Index i = 0; i < patch.vertex_count; ++i) {
        const Index o = owner[i];
        if (o == kPinned) {
            known.position[i] = known.gradient[i] = 1;
        } else if (o == kConstrained) {
            const VertexConstraint& constraint = constraints.at(i);
            known.position[i] = constraint.position.has_value() || rings.count(i) == 0;
            known.gradient[i] = constraint.gradient.has_value();
        } else if (o >= 0) {
            known.position[i] = handles[o].options.position || rings.count(i) == 0;
            known.gradient[i] = handles[o].options.gradient;
        }
        known.gradient_wanted[i] = !known.gradient[i] && rings.count(i) > 0;
    }
    return known;
}

void require_constraints(const Patch& patch, const Rings& rings, const Knowledge& known) {
    std::vector<char> seen(static_cast<std::size_t>(patch.vertex_count), 0);
    for (Index v = 0; v < patch.vertex_count; ++v) {
        if (!seen[v]) require_held(collect_part(patch, rings, known, v, seen));
    }
}

}  // namespace lissom
