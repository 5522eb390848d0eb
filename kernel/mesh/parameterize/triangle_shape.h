/// Triangles of a chart by their own shape, each in a plane of its own; private to kernel/mesh.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/parameterize/chart.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// Width of a triangle over its length from which on it is `degenerate`.
inline constexpr double kMinWidth = 1e-4;

/// The corners of a triangle in its plane, counter-clockwise. One that is narrower than kMinWidth
/// of its length is drawn out to that width: its cotangents stay finite.
struct TriangleShape {
    std::array<Vec2, 3> corner;
    /// At each corner, and so for the edge opposite to it.
    std::array<double, 3> cotangent{};
    double area = 0.0;
    bool degenerate = false;

    /// From corner k to the next.
    Vec2 side(int k) const { return corner[at((k + 1) % 3)] - corner[at(k)]; }
    /// Cotangent opposite to `side(k)`.
    double opposite(int k) const { return cotangent[at((k + 2) % 3)]; }
};

/// Returns all triangles of the chart.
std::vector<TriangleShape> triangle_shapes(const Chart& chart);

/// Returns the matrix of sum over edges of w |x_i - x_j|^2, with w half the cotangents opposite to
/// the edge.
SymmetricMatrix chart_laplacian(const Chart& chart, const std::vector<TriangleShape>& shapes);

/// Derivative of the map that takes a triangle to `a`, `b` and `c`, as its parts that keep angles
/// and mirror them: it is z -> same z + mirrored conj(z) in complex numbers. Its singular values
/// are the sum and the difference of their lengths.
struct MapDerivative {
    Vec2 same, mirrored;
    double greatest() const { return same.norm() + mirrored.norm(); }
    double least() const { return std::abs(same.norm() - mirrored.norm()); }
};
MapDerivative map_derivative(const TriangleShape& shape, const Vec2& a, const Vec2& b,
                             const Vec2& c);

/// Twice the signed area of a triangle in the plane.
inline double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    return u.x() * v.y() - u.y() * v.x();
}

}  // namespace lissom
