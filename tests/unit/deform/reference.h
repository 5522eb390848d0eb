/// A slow deformation straight from the thesis's equations 2.3 to 2.11 and from what this project
/// changes in them, in dense matrices of extended precision: the oracle for the fast one.
///
/// It shares no code with the kernel but the options and the distances from what is held, over
/// which a blend fades. It takes triangle meshes, with degenerate
/// vertices displaced already (Eq 2.9), and holds vertices by affine maps, with their gradients.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/patch_distance.h"
#include "kernel/mesh/mesh.h"

namespace lissom::test {

class Reference {
  public:
    /// `displaced` are the rest positions for the first system.
    Reference(const Mesh& mesh, std::vector<Vec3> displaced, std::map<Index, Affine> held,
              const DeformOptions& options)
        : held_(std::move(held)), options_(options), displaced_(std::move(displaced)) {
        rest_.assign(mesh.positions().begin(), mesh.positions().end());
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto t = mesh.topology().face(f);
            faces_.push_back({t[0], t[1], t[2]});
        }
        find_rings();
        find_geometry();
        for (Index v = 0; v < size(); ++v) stencils_.push_back(stencil(v));
        for (Index v = 0; v < size(); ++v) {
            if (held_.count(v) > 0) continue;
            unknown_[v] = static_cast<Index>(unknown_.size());
        }
        find_fading(mesh);
    }

    /// Positions after the first system (Eq 2.8), where degenerate vertices are displaced.
    std::vector<Vec3> first() const {
        LeastSquares system(static_cast<Index>(unknown_.size()));
        for (Index i = 0; i < size(); ++i) {
            const Row row = laplacian_row(i);
            add_difference(system, row_weight(i), row, {kNoIndex, Real3::Zero()}, i,
                           applied(row, displaced_));
        }
        for (const auto& [pair, weight] : coherent_pairs()) {
            for (int d = 0; d < 3; ++d) {
                const Real3 unit = Real3::Unit(d);
                add_difference(system, options_.coherence_weight * weight, {}, {pair.first, unit},
                               pair.second, unit);
            }
        }
        return solved(system);
    }

    /// The same with degenerate vertices pulled back: v = M (v - v') + v'.
    std::vector<Vec3> pulled_back(std::vector<Vec3> x) const {
        const std::vector<Mat3> m = gradients(x);
        for (Index i = 0; i < size(); ++i) x[i] += m[i] * (rest_[i] - displaced_[i]);
        return x;
    }

    /// M_i of positions after the first system (Eq 2.5), or what a handle prescribes.
    std::vector<Mat3> gradients(const std::vector<Vec3>& x) const {
        std::vector<Mat3> result;
        for (Index i = 0; i < size(); ++i) {
            Mat3 m = Mat3::Zero();
            for (const auto& [v, g] : stencils_[i]) m += x[v] * g.cast<double>().transpose();
            result.push_back(held_.count(i) > 0 ? held_.at(i).linear : m);
        }
        return result;
    }

    /// Positions after the second system (Eq 2.10 and 2.11, Poisson, or the blend of both), for
    /// those after the first.
    std::vector<Vec3> second(const std::vector<Vec3>& first_positions) const {
        const std::vector<Mat3> m = gradients(first_positions);
        std::vector<Mat3> s;
        for (Index i = 0; i < size(); ++i) s.push_back(transform_of(i, m[i]));
        LeastSquares system(static_cast<Index>(unknown_.size()));
        const bool edges = options_.second != SecondSystem::laplacian;
        for (const auto& [edge, cotangent] : cotangent_) {
            const auto [i, j] = edge;
            if (i > j || !edges) continue;
            const double w = uniform() ? 1.0 : std::max(cotangent, 0.0);
            const Vec3 target = 0.5 * (s[i] + s[j]) * (rest_[i] - rest_[j]);
            system.add(w, known({{i, 1.0}, {j, -1.0}}), target.cast<Real>());
        }
        const double factor = laplacian_factor();
        const bool literal = !options_.scale_free && !edges;
        for (Index i = 0; i < size() && factor > 0.0; ++i) {
            const double weight = literal ? 1.0 : (uniform() ? 1.0 / area_[i] : area_[i]);
            Row row = laplacian_row(i);
            if (!options_.scale_free && edges && !uniform()) {
                for (auto& entry : row) entry.second *= 0.5L;
            }
            const Vec3 delta = applied(row, rest_).cast<double>();
            system.add(factor * faded_[i] * weight, known(row), Real3((s[i] * delta).cast<Real>()));
        }
        return solved(system);
    }

    /// The energy that refinement lowers: that of the second system with the best rotation at every
    /// vertex that no handle turns, each edge counted half at either end.
    double refined_energy(const std::vector<Vec3>& x) const {
        const double factor = laplacian_factor();
        double sum = 0.0;
        for (Index i = 0; i < size(); ++i) {
            Mat3 product = Mat3::Zero();
            double squares = 0.0;
            const auto add = [&](double weight, const Vec3& after, const Vec3& before) {
                product += weight * after * before.transpose();
                squares += weight * (after.squaredNorm() + before.squaredNorm());
            };
            for (const Index j : rings_[i]) {
                if (options_.second == SecondSystem::laplacian) break;
                const double w = uniform() ? 1.0 : std::max(cotangent_.at({i, j}), 0.0);
                add(0.5 * w, x[i] - x[j], rest_[i] - rest_[j]);
            }
            const Row row = laplacian_row(i);
            add(factor * faded_[i] * row_weight(i), applied(row, x).cast<double>(),
                applied(row, rest_).cast<double>());
            const Mat3 r = transform_of(i, held_.count(i) > 0 ? held_.at(i).linear : product);
            sum += squares - 2.0 * r.cwiseProduct(product).sum();
        }
        return sum;
    }

  private:
    using Real = long double;
    using Real3 = Eigen::Matrix<Real, 3, 1>;
    using Row = std::map<Index, Real>;

    /// A row over the unknowns and what the known positions add to it.
    struct Split {
        Row unknown;
        Real3 known = Real3::Zero();
    };

    /// Normal equations of weighted rows, for three coordinates at once.
    class LeastSquares {
      public:
        explicit LeastSquares(Index n) : matrix_(n, n), right_(n, 3) {
            matrix_.setZero();
            right_.setZero();
        }
        /// weight |row x + known - target|^2.
        void add(double weight, const Split& row, const Real3& target) {
            for (const auto& [i, a] : row.unknown) {
                for (const auto& [j, b] : row.unknown) matrix_(i, j) += weight * a * b;
                right_.row(i) += weight * a * (target - row.known).transpose();
            }
        }
        Eigen::Matrix<Real, Eigen::Dynamic, 3> solve() const {
            return matrix_.ldlt().solve(right_);
        }

      private:
        Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> matrix_;
        Eigen::Matrix<Real, Eigen::Dynamic, 3> right_;
    };

    Index size() const { return static_cast<Index>(rest_.size()); }
    bool uniform() const { return options_.weights == LaplacianWeights::uniform; }

    void find_rings() {
        rings_.resize(rest_.size());
        for (const auto& t : faces_) {
            for (int k = 0; k < 3; ++k) {
                rings_[t[k]].insert(t[(k + 1) % 3]);
                rings_[t[k]].insert(t[(k + 2) % 3]);
            }
        }
    }

    /// Half sums of cotangents and mixed Voronoi areas (Meyer et al. 2002), angles at least half a
    /// degree.
    void find_geometry() {
        area_.assign(rest_.size(), 0.0);
        for (const auto& t : faces_) {
            double angle[3], length[3];
            const double least = 0.5 * kPi / 180.0;
            for (int k = 0; k < 3; ++k) {
                const Vec3 a = rest_[t[(k + 1) % 3]] - rest_[t[k]];
                const Vec3 b = rest_[t[(k + 2) % 3]] - rest_[t[k]];
                angle[k] = std::clamp(std::atan2(a.cross(b).norm(), a.dot(b)), least, kPi - least);
                length[k] = (a - b).squaredNorm();
            }
            const double whole =
                0.5 * std::max((rest_[t[1]] - rest_[t[0]]).cross(rest_[t[2]] - rest_[t[0]]).norm(),
                               std::sin(least) * *std::max_element(length, length + 3));
            for (int k = 0; k < 3; ++k) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                cotangent_[{t[i], t[j]}] += 0.5 / std::tan(angle[k]);
                cotangent_[{t[j], t[i]}] += 0.5 / std::tan(angle[k]);
                const bool obtuse = *std::max_element(angle, angle + 3) > 0.5 * kPi;
                const double voronoi =
                    (length[i] / std::tan(angle[i]) + length[j] / std::tan(angle[j])) / 8.0;
                area_[t[k]] += obtuse ? (angle[k] > 0.5 * kPi ? 0.5 : 0.25) * whole
                                      : std::max(voronoi, 0.1 * whole);
            }
        }
    }

    /// Coefficients g with M_i = sum of x_k g_k^T (Eq 2.3 to 2.5).
    std::map<Index, Real3> stencil(Index i) const {
        const Real count = static_cast<Real>(rings_[i].size());
        Real3 center = Real3::Zero();
        for (const Index j : rings_[i]) center += displaced_[j].cast<Real>() / count;
        Eigen::Matrix<Real, 3, 3> covariance = Eigen::Matrix<Real, 3, 3>::Zero();
        std::vector<Index> members(rings_[i].begin(), rings_[i].end());
        members.push_back(i);
        for (const Index k : members) {
            const Real3 v = displaced_[k].cast<Real>() - center;
            covariance += v * v.transpose();
        }
        std::map<Index, Real3> g;
        for (const Index k : members) {
            const Real3 p = covariance.inverse() * (displaced_[k].cast<Real>() - center);
            g.try_emplace(k, Real3::Zero()).first->second += p;
            for (const Index j : rings_[i]) {
                g.try_emplace(j, Real3::Zero()).first->second -= p / count;
            }
        }
        return g;
    }

    /// D(x)_i, pointwise; twice as much where the thesis writes cot a + cot b.
    Row laplacian_row(Index i) const {
        Row row;
        for (const Index j : rings_[i]) {
            const double literal = options_.scale_free ? 1.0 : 2.0;
            const Real c = uniform()
                               ? 1.0L / static_cast<Real>(rings_[i].size())
                               : static_cast<Real>(literal) * cotangent_.at({i, j}) / area_[i];
            row[j] += c;
            row[i] -= c;
        }
        return row;
    }
    static Real3 applied(const Row& row, const std::vector<Vec3>& x) {
        Real3 sum = Real3::Zero();
        for (const auto& [v, c] : row) sum += c * x[v].cast<Real>();
        return sum;
    }
    double row_weight(Index i) const {
        if (!options_.scale_free) return 1.0;
        return uniform() ? 1.0 / area_[i] : area_[i];
    }

    /// The pairs SF of Eq 2.7 and their weights.
    std::map<std::pair<Index, Index>, double> coherent_pairs() const {
        std::map<std::pair<Index, Index>, double> pairs;
        for (Index a = 0; a < size(); ++a) {
            for (const Index b : rings_[a]) {
                const double w = std::max(cotangent_.at({a, b}), 1e-3);
                if (a < b) pairs[{a, b}] = options_.scale_free ? w : 2.0;
                if (options_.coherence < 2) continue;
                for (const Index c : rings_[b]) {
                    if (a < c && rings_[a].count(c) == 0) {
                        pairs[{a, c}] = options_.scale_free ? 1.0 / std::sqrt(3.0) : 2.0;
                    }
                }
            }
        }
        return pairs;
    }

    /// Splits a row into what multiplies unknown positions and what the known ones add.
    Split known(const Row& row) const {
        Split split;
        for (const auto& [v, c] : row) {
            const auto held = held_.find(v);
            if (held == held_.end()) {
                split.unknown[unknown_.at(v)] += c;
            } else {
                split.known += c * held->second(rest_[v]).cast<Real>();
            }
        }
        return split;
    }

    /// M_i u as a row, or W u where a handle prescribes W.
    Split gradient_times(Index i, const Real3& u) const {
        if (held_.count(i) > 0) return {{}, held_.at(i).linear.cast<Real>() * u};
        Row row;
        for (const auto& [v, g] : stencils_[i]) row[v] += g.dot(u);
        return known(row);
    }

    /// weight |row x + M_p.first p.second - M_i u|^2.
    void add_difference(LeastSquares& system, double weight, const Row& row,
                        const std::pair<Index, Real3>& plus, Index i, const Real3& u) const {
        Split total = known(row);
        const auto add = [&](const Split& part, Real sign) {
            for (const auto& [v, c] : part.unknown) total.unknown[v] += sign * c;
            total.known += sign * part.known;
        };
        if (row.empty()) add(gradient_times(plus.first, plus.second), 1.0L);
        add(gradient_times(i, u), -1.0L);
        system.add(weight, total, Real3::Zero());
    }

    std::vector<Vec3> solved(const LeastSquares& system) const {
        const auto x = system.solve();
        std::vector<Vec3> result;
        for (Index v = 0; v < size(); ++v) {
            const auto held = held_.find(v);
            result.push_back(held != held_.end()
                                 ? held->second(rest_[v])
                                 : Vec3(x.row(unknown_.at(v)).transpose().cast<double>()));
        }
        return result;
    }

    Mat3 rotation_and_scale(const Mat3& m) const {
        const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
        Mat3 u = svd.matrixU();
        if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
        const double scale =
            options_.local_size == LocalSize::scale ? m.norm() / std::sqrt(3.0) : 1.0;
        return scale * u * svd.matrixV().transpose();
    }

    /// S_i: where lengths count, a held vertex is as large as its handle makes it.
    Mat3 transform_of(Index i, const Mat3& gradient) const {
        const bool whole = held_.count(i) > 0 && options_.second != SecondSystem::laplacian;
        return whole ? gradient : rotation_and_scale(gradient);
    }

    /// RMS distance of the surface to its centroid.
    double radius() const {
        double area = 0.0, moment = 0.0;
        Vec3 center = Vec3::Zero();
        for (const auto& t : faces_) {
            const Vec3 &a = rest_[t[0]], &b = rest_[t[1]], &c = rest_[t[2]];
            const double w = 0.5 * (b - a).cross(c - a).norm();
            area += w;
            center += w * (a + b + c) / 3.0;
            moment +=
                w *
                ((a + b + c).squaredNorm() + a.squaredNorm() + b.squaredNorm() + c.squaredNorm()) /
                12.0;
        }
        return std::sqrt(moment / area - (center / area).squaredNorm());
    }

    /// l^2 of the second system.
    double laplacian_factor() const {
        if (options_.second == SecondSystem::laplacian) return 1.0;
        if (options_.second == SecondSystem::poisson) return 0.0;
        double edges = 0.0, length = 0.0;
        for (Index i = 0; i < size(); ++i) {
            for (const Index j : rings_[i]) {
                edges += 1.0;
                length += (rest_[i] - rest_[j]).norm();
            }
        }
        const double l = std::max(0.06 * radius(), 3.0 * length / edges);
        return l * l;
    }

    /// How much of l^2 a blend leaves at each vertex.
    void find_fading(const Mesh& mesh) {
        faded_.assign(rest_.size(), 1.0);
        if (options_.second != SecondSystem::blend) return;
        const double reach = 0.06 * radius();
        std::vector<std::pair<Index, double>> sources;
        for (const auto& entry : held_) sources.emplace_back(entry.first, 0.0);
        const Patch patch = build_patch(mesh, Region::all(mesh.shared_topology()), 1);
        const std::vector<double> distance = patch_distances(patch, sources, 3.0 * reach);
        for (Index i = 0; i < size(); ++i) {
            const double near = std::exp(-std::pow(distance[i] / reach, 2.0));
            faded_[i] = std::pow(0.08 + 0.92 * near, 2.0);
        }
    }

    std::map<Index, Affine> held_;
    DeformOptions options_;
    std::vector<Vec3> rest_, displaced_;
    std::vector<std::array<Index, 3>> faces_;
    std::vector<std::set<Index>> rings_;
    std::map<std::pair<Index, Index>, double> cotangent_;
    std::vector<double> area_, faded_;
    std::vector<std::map<Index, Real3>> stencils_;
    std::map<Index, Index> unknown_;
};

}  // namespace lissom::test
