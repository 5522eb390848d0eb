#include "kernel/mesh/parameterize/rigid_map.h"

#include <utility>

#include "kernel/mesh/parameterize/map_quality.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// It ends where the energy falls by less than this part of it, or of that of a doubled length.
constexpr double kEnergyFall = 1e-6, kNoEnergy = 1e-24;

class RigidIteration {
  public:
    RigidIteration(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   const Context& context)
        : chart_(chart), shapes_(shapes), turn_(shapes.size()) {
        SymmetricMatrix matrix = chart_laplacian(chart, shapes);
        // Holds the first vertex at the origin, which takes nothing from the others: the right
        // sides sum to zero.
        matrix.value[0] *= 2.0;
        system_.analyze(matrix, context);
        system_.factor(matrix, context);
        for (const TriangleShape& shape : shapes) total_ += shape.area;
    }

    // The best rotations for a map, and the energy that is left.
    double rotate(std::span<const Vec2> uv) {
        double energy = 0.0;
        for (std::size_t t = 0; t < shapes_.size(); ++t) {
            const auto [a, b, c] = chart_.triangles[t];
            const TriangleShape& shape = shapes_[t];
            const MapDerivative map = map_derivative(shape, uv[a], uv[b], uv[c]);
            const double length = map.same.norm();
            turn_[t] = length > 0.0 ? Vec2(map.same / length) : Vec2(1.0, 0.0);
            energy +=
                2.0 * shape.area * ((length - 1.0) * (length - 1.0) + map.mirrored.squaredNorm());
        }
        return energy / total_;
    }

    // The best map for these rotations.
    std::vector<Vec2> move() {
        const std::size_t n = chart_.positions.size();
        right_.assign(2 * n, 0.0);
        for (std::size_t t = 0; t < shapes_.size(); ++t) {
            for (int k = 0; k < 3; ++k) {
                const Vec2 side = shapes_[t].side(k);
                const double w = 0.5 * shapes_[t].opposite(k);
                add(chart_.triangles[t][k], chart_.triangles[t][(k + 1) % 3],
                    {w * (turn_[t].x() * side.x() - turn_[t].y() * side.y()),
                     w * (turn_[t].y() * side.x() + turn_[t].x() * side.y())});
            }
        }
        system_.solve(right_, right_, 2);
        std::vector<Vec2> uv;
        uv.reserve(n);
        for (std::size_t v = 0; v < n; ++v) uv.emplace_back(right_[v], right_[n + v]);
        return uv;
    }

  private:
    void add(Index from, Index to, const Vec2& value) {
        for (const int axis : {0, 1}) {
            double* right = right_.data() + at(axis) * chart_.positions.size();
            right[to] += value[axis];
            right[from] -= value[axis];
        }
    }

    const Chart& chart_;
    const std::vector<TriangleShape>& shapes_;
    SparseSystem system_;
    // The rotation of each triangle, by the cosine and the sine of its angle.
    std::vector<Vec2> turn_;
    std::vector<double> right_;
    double total_ = 0.0;
};

}  // namespace

RigidMap rigid_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   std::vector<Vec2> start, Index maximum_iterations, const Context& context) {
    RigidIteration iteration(chart, shapes, context);
    RigidMap result;
    result.energy.push_back(iteration.rotate(start));
    result.uv = std::move(start);
    const std::span faces(chart.triangles.data(), chart.face.size());
    for (Index i = 1; i <= maximum_iterations; ++i) {
        context.checkpoint();
        std::vector<Vec2> next = iteration.move();
        const double before = result.energy.back(), energy = iteration.rotate(next);
        result.energy.push_back(energy);
        if (flipped_triangles(faces, next).empty()) {
            result.uv = std::move(next);
            result.iterations = i;
        }
        if (energy < kNoEnergy || before - energy < kEnergyFall * before) break;
    }
    return result;
}

}  // namespace lissom
