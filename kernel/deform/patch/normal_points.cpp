#include "kernel/deform/patch/normal_points.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace lissom {
namespace {

// Ratio of the covariance beyond which a vertex and its ring count as on one line.
constexpr double kThin = 1e3;

Vec3 ring_center(const WorkingPatch& work, Index i) {
    Vec3 sum = Vec3::Zero();
    for (const Index j : work.rings.ring(i)) sum += work.patch.rest[at(j)];
    return sum / work.rings.count(i);
}

// V_i V_i^T of Eq 2.5.
Mat3 covariance_of(const WorkingPatch& work, Index i) {
    const Vec3 center = ring_center(work, i), own = work.patch.rest[at(i)] - center;
    Mat3 covariance = own * own.transpose();
    for (const Index j : work.rings.ring(i)) {
        const Vec3 d = work.patch.rest[at(j)] - center;
        covariance.noalias() += d * d.transpose();
    }
    return covariance;
}

// Whether the least eigenvalue of a covariance, in the greatest, is above 1 / threshold for sure,
// by its invariants: most vertices of a dense mesh need no eigenvalues.
bool is_surely_round(const Mat3& m, double threshold) {
    const double trace = m.trace();
    const double second = 0.5 * (trace * trace - m.squaredNorm());
    return m.determinant() * threshold > 1.01 * second * trace;
}

bool is_flat(const Mat3& covariance, double threshold) {
    if (is_surely_round(covariance, threshold)) return false;
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
    const Vec3 values = solver.eigenvalues();
    return !(values[0] * threshold > values[2]) && values[1] * kThin > values[2];
}

bool may_be_extended(const WorkingPatch& work, Index i) {
    return work.patch.in_region[at(i)] && work.rings.count(i) > 1 &&
           !work.geometry.normal[at(i)].isZero();
}

Vec3 offset_of(const WorkingPatch& work, Index i, double displacement) {
    double length = 0.0;
    for (const Index j : work.rings.ring(i)) {
        length += (work.patch.rest[at(i)] - work.patch.rest[at(j)]).norm();
    }
    const double count = work.rings.count(i);
    return displacement * (length / count) * std::sqrt(count) * work.geometry.normal[at(i)];
}

// Puts an entry for its point behind the ring of each flat vertex, and the vertex into the ring of
// the point.
void extend_rings(WorkingPatch& work, const std::vector<Index>& flat) {
    const Rings before = work.rings;
    const std::vector<double> cotangent = std::move(work.geometry.cotangent);
    const std::vector<double> neighbor = std::move(work.laplacian.neighbor);
    work.rings = {{0}, {}};
    work.geometry.cotangent.clear();
    work.laplacian.neighbor.clear();
    const auto close = [&](Index added) {
        if (added != kNoIndex) work.rings.neighbor.push_back(added);
        work.rings.begin.push_back(count_of(work.rings.neighbor));
        work.geometry.cotangent.resize(work.rings.neighbor.size(), 0.0);
        work.laplacian.neighbor.resize(work.rings.neighbor.size(), 0.0);
    };
    std::size_t next = 0;
    for (Index i = 0; i < before.size(); ++i) {
        for (Index e = before.begin[at(i)]; e < before.begin[at(i) + 1]; ++e) {
            work.rings.neighbor.push_back(before.neighbor[at(e)]);
            work.geometry.cotangent.push_back(cotangent[at(e)]);
            work.laplacian.neighbor.push_back(neighbor[at(e)]);
        }
        const bool is_flat = next < flat.size() && flat[next] == i;
        close(is_flat ? before.size() + index_of(next++) : kNoIndex);
    }
    for (const Index v : flat) close(v);
}

}  // namespace

void add_normal_points(WorkingPatch& work, double threshold, double displacement) {
    Patch& patch = work.patch;
    std::vector<Index> flat;
    for (Index i = 0; i < patch.surface_count; ++i) {
        if (!may_be_extended(work, i) || !is_flat(covariance_of(work, i), threshold)) continue;
        flat.push_back(i);
    }
    if (flat.empty()) return;
    for (const Index v : flat) {
        patch.rest.push_back(patch.rest[at(v)] + offset_of(work, v, displacement));
        patch.in_region.push_back(1);
        patch.on_boundary.push_back(0);
    }
    extend_rings(work, flat);
    patch.normal_points = std::move(flat);
    patch.surface_count = patch.vertex_count = count_of(patch.rest);
    const auto n = at(patch.vertex_count);
    work.geometry.area.resize(n, 0.0);
    work.geometry.normal.resize(n, Vec3::Zero());
    work.laplacian.self.resize(n, 0.0);
    work.laplacian.weight.resize(n, 0.0);
}

}  // namespace lissom
