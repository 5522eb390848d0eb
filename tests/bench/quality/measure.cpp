#include "tests/bench/quality/measure.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom::bench {
namespace {

// Stands for the anisotropy of a triangle that has collapsed.
constexpr double kCollapsed = 1e6;

double cotangent(const Vec3& at, const Vec3& a, const Vec3& b) {
    const double sine = (a - at).cross(b - at).norm();
    return sine > 0.0 ? (a - at).dot(b - at) / sine : 0.0;
}

// Signed angle between the planes of the two faces at the edge from a to b.
double dihedral(const Vec3& a, const Vec3& b, const Vec3& left, const Vec3& right) {
    const Vec3 axis = (b - a).normalized();
    const Vec3 n = (b - a).cross(left - a), m = (right - a).cross(b - a);
    return std::atan2(n.cross(m).dot(axis), n.dot(m));
}

// Edge vectors of a triangle in its plane.
Eigen::Matrix2d flattened(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a;
    const Vec3 x = u.normalized(), y = u.cross(v).cross(u).normalized();
    Eigen::Matrix2d m;
    m << u.dot(x), v.dot(x), 0.0, v.dot(y);
    return m;
}

double percentile(std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

// The vertex of the triangle `face` that is neither a nor b.
Index opposite(const Topology& topology, Index face, Index a, Index b) {
    for (const Index v : topology.face(face)) {
        if (v != a && v != b) return v;
    }
    return kNoIndex;
}

// The two faces at the edge from a to b, or kNoIndex.
std::pair<Index, Index> faces_at(const Topology& topology, Index a, Index b) {
    std::pair<Index, Index> faces{kNoIndex, kNoIndex};
    for (const Index f : topology.faces_around(a)) {
        const auto face = topology.face(f);
        for (std::size_t k = 0; k < 3; ++k) {
            if (face[k] == a && face[(k + 1) % 3] == b) faces.first = f;
            if (face[k] == b && face[(k + 1) % 3] == a) faces.second = f;
        }
    }
    return faces;
}

}  // namespace

QualityMeasure::QualityMeasure(const Mesh& rest, const std::vector<Index>& held) : rest_(rest) {
    const Topology& topology = rest.topology();
    std::vector<char> is_held(static_cast<std::size_t>(rest.vertex_count()), 0);
    for (const Index v : held) is_held[v] = 1;
    std::vector<char> is_free_face(static_cast<std::size_t>(rest.face_count()), 0);
    for (Index f = 0; f < rest.face_count(); ++f) {
        for (const Index v : topology.face(f)) is_free_face[f] |= static_cast<char>(!is_held[v]);
        if (is_free_face[f]) free_faces_.push_back(f);
    }
    for (Index a = 0; a < rest.vertex_count(); ++a) {
        for (const Index b : topology.neighbors(a)) {
            if (b < a) continue;
            const auto [f, g] = faces_at(topology, a, b);
            Edge edge{a, b, kNoIndex, kNoIndex, 0.0, 0.0, false};
            const Vec3 &p = rest.position(a), &q = rest.position(b);
            if (f != kNoIndex) {
                edge.left = opposite(topology, f, a, b);
                edge.weight += 0.5 * cotangent(rest.position(edge.left), p, q);
            }
            if (g != kNoIndex) {
                edge.right = opposite(topology, g, a, b);
                edge.weight += 0.5 * cotangent(rest.position(edge.right), p, q);
            }
            edge.weight = std::max(0.0, edge.weight);
            edge.length_squared = (p - q).squaredNorm();
            edge.at_border = f != kNoIndex && g != kNoIndex && (is_held[a] || is_held[b]) &&
                             (is_free_face[f] || is_free_face[g]);
            rest_energy_ += 2.0 * edge.weight * edge.length_squared;
            edges_.push_back(edge);
        }
    }
    rest_volume_ = volume(rest);
}

double QualityMeasure::energy(std::span<const Vec3> positions) const {
    std::vector<Mat3> covariance(positions.size(), Mat3::Zero());
    std::vector<double> squares(positions.size(), 0.0);
    for (const Edge& e : edges_) {
        const Vec3 before = rest_.position(e.b) - rest_.position(e.a);
        const Vec3 after = positions[e.b] - positions[e.a];
        const Mat3 product = e.weight * after * before.transpose();
        const double square = e.weight * (e.length_squared + after.squaredNorm());
        for (const Index v : {e.a, e.b}) {
            covariance[v] += product;
            squares[v] += square;
        }
    }
    double sum = 0.0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Mat3 r = nearest_rotation(covariance[v]);
        sum += std::max(0.0, squares[v] - 2.0 * r.cwiseProduct(covariance[v]).sum());
    }
    return sum / rest_energy_;
}

std::vector<double> QualityMeasure::anisotropies(std::span<const Vec3> positions) const {
    std::vector<double> result;
    for (const Index f : free_faces_) {
        const auto t = rest_.topology().face(f);
        const Eigen::Matrix2d before =
            flattened(rest_.position(t[0]), rest_.position(t[1]), rest_.position(t[2]));
        const Eigen::Matrix2d after = flattened(positions[t[0]], positions[t[1]], positions[t[2]]);
        if (!(before.determinant() > 0.0)) continue;
        const Eigen::Matrix2d map = after * before.inverse();
        const Eigen::Vector2d values = Eigen::JacobiSVD<Eigen::Matrix2d>(map).singularValues();
        const double least = values[0] / kCollapsed;
        result.push_back(values[1] > least ? values[0] / values[1] : kCollapsed);
    }
    return result;
}

std::vector<double> QualityMeasure::creases(std::span<const Vec3> positions) const {
    std::vector<double> result;
    for (const Edge& e : edges_) {
        if (!e.at_border) continue;
        const auto angle = [&](std::span<const Vec3> x) {
            return dihedral(x[e.a], x[e.b], x[e.left], x[e.right]);
        };
        const double change = std::abs(angle(positions) - angle(rest_.positions()));
        result.push_back(std::min(change, 2.0 * kPi - change) * 180.0 / kPi);
    }
    return result;
}

Quality QualityMeasure::of(const std::vector<Vec3>& positions) const {
    Quality quality;
    quality.energy = energy(positions);
    std::vector<double> values = anisotropies(positions);
    quality.anisotropy_median = percentile(values, 0.5);
    quality.anisotropy_p99 = percentile(values, 0.99);
    quality.anisotropy_max = percentile(values, 1.0);
    values = creases(positions);
    quality.crease_p99 = percentile(values, 0.99);
    quality.crease_max = percentile(values, 1.0);
    Mesh deformed = rest_;
    deformed.set_positions(positions);
    quality.volume = volume(deformed) / rest_volume_;
    return quality;
}

}  // namespace lissom::bench
