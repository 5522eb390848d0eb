#include "kernel/mesh/parameterize/triangle_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

double mean_side(const Chart& chart) {
    double sum = 0.0;
    for (const Triangle& t : chart.triangles) {
        for (int k = 0; k < 3; ++k) {
            sum += (chart.positions[t[(k + 1) % 3]] - chart.positions[t[k]]).norm();
        }
    }
    return sum / (3.0 * static_cast<double>(chart.triangles.size()));
}

// Corners from the longest side on: the apex lies `height` above a place along it.
void lay_out(TriangleShape& shape, int longest, double length, double along, double height) {
    shape.degenerate = !(height >= kMinWidth * length);
    height = std::max(height, kMinWidth * length);
    shape.corner[longest] = Vec2::Zero();
    shape.corner[(longest + 1) % 3] = Vec2(length, 0.0);
    shape.corner[(longest + 2) % 3] = Vec2(along, height);
    shape.area = 0.5 * length * height;
    for (int k = 0; k < 3; ++k) {
        const Vec2 u = shape.side(k), v = -shape.side((k + 2) % 3);
        shape.cotangent[k] = 0.5 * u.dot(v) / shape.area;
    }
}

// `unit` stands for the length of a triangle whose corners are one point.
TriangleShape shape_of(const std::array<Vec3, 3>& p, double unit) {
    std::array<double, 3> length{};
    for (int k = 0; k < 3; ++k) length[k] = (p[(k + 1) % 3] - p[k]).norm();
    const auto longest =
        static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
    TriangleShape shape;
    if (!(length[longest] > 1e-12 * unit)) {
        lay_out(shape, 0, kMinWidth * unit, 0.5 * kMinWidth * unit, 0.0);
        return shape;
    }
    const Vec3 base = p[(longest + 1) % 3] - p[longest], side = p[(longest + 2) % 3] - p[longest];
    lay_out(shape, longest, length[longest], base.dot(side) / length[longest],
            base.cross(side).norm() / length[longest]);
    return shape;
}

}  // namespace

std::vector<TriangleShape> triangle_shapes(const Chart& chart) {
    const double mean = mean_side(chart), unit = mean > 0.0 ? mean : 1.0;
    std::vector<TriangleShape> shapes;
    shapes.reserve(chart.triangles.size());
    for (Index t = 0; t < chart.triangle_count(); ++t) {
        const auto [a, b, c] = chart.triangles[t];
        shapes.push_back(
            shape_of({chart.positions[a], chart.positions[b], chart.positions[c]}, unit));
    }
    return shapes;
}

SymmetricMatrix chart_laplacian(const Chart& chart, const std::vector<TriangleShape>& shapes) {
    std::vector<Triplet> entries;
    entries.reserve(9 * shapes.size());
    for (std::size_t t = 0; t < shapes.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Index a = chart.triangles[t][k], b = chart.triangles[t][(k + 1) % 3];
            const double w = 0.5 * shapes[t].opposite(k);
            entries.push_back({a, a, w});
            entries.push_back({b, b, w});
            entries.push_back({std::max(a, b), std::min(a, b), -w});
        }
    }
    return symmetric_from_triplets(chart.vertex_count(), entries);
}

MapDerivative map_derivative(const TriangleShape& shape, const Vec2& a, const Vec2& b,
                             const Vec2& c) {
    Eigen::Matrix2d from, to;
    from << shape.side(0), -shape.side(2);
    to << b - a, c - a;
    const Eigen::Matrix2d j = to * from.inverse();
    return {0.5 * Vec2(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1)),
            0.5 * Vec2(j(0, 0) - j(1, 1), j(1, 0) + j(0, 1))};
}

}  // namespace lissom
