#include "kernel/mesh/parameterize/rigid_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/mesh/parameterize/map_quality.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// It ends if the energy falls by less than this part of it, or of that of a doubled length.
constexpr double kEnergyFall = 1e-6, kNoEnergy = 1e-24;
// Part of the step to the first triangle without area that is taken, and the least useful part of
// an iteration.
constexpr double kWayToFlip = 0.8, kMinWay = 0.02;

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

// The smallest t above 0 if c + b t + a t^2 is 0, c being positive; infinity if there is none.
double first_root(double a, double b, double c) {
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) return std::numeric_limits<double>::infinity();
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    double first = std::numeric_limits<double>::infinity();
    for (const double root : {q / a, c / q}) {
        if (root > 0.0) first = std::min(first, root);
    }
    return first;
}

// Part of the way from one map to another until a triangle has no area, from a map without flips.
double way_to_flip(std::span<const Triangle> triangles, std::span<const Vec2> from,
                   std::span<const Vec2> to) {
    const auto cross = [](const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); };
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : triangles) {
        const Vec2 u = from[b] - from[a], v = from[c] - from[a];
        const Vec2 du = to[b] - to[a] - u, dv = to[c] - to[a] - v;
        least =
            std::min(least, first_root(cross(du, dv), cross(u, dv) + cross(du, v), cross(u, v)));
    }
    return least;
}

}  // namespace

RigidMap rigid_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   std::vector<Vec2> start, RigidSteps steps, Index maximum_iterations,
                   const Context& context) {
    RigidIteration iteration(chart, shapes, context);
    RigidMap result;
    result.energy.push_back(iteration.rotate(start));
    result.uv = start;
    const std::span faces(chart.triangles.data(), chart.face.size());
    bool free = steps == RigidSteps::whole || !flipped_triangles(faces, start).empty();
    std::vector<Vec2> at_hand = std::move(start);
    for (Index i = 1; i <= maximum_iterations; ++i) {
        context.checkpoint();
        std::vector<Vec2> next = iteration.move();
        const double way = free ? 1.0 : kWayToFlip * way_to_flip(faces, at_hand, next);
        if (way < kMinWay) break;
        for (std::size_t v = 0; v < next.size() && way < 1.0; ++v) {
            next[v] = at_hand[v] + way * (next[v] - at_hand[v]);
        }
        at_hand = std::move(next);
        const double before = result.energy.back(), energy = iteration.rotate(at_hand);
        result.energy.push_back(energy);
        if (flipped_triangles(faces, at_hand).empty()) {
            free = steps == RigidSteps::whole;
            result.uv = at_hand;
            result.iterations = i;
        }
        if (energy < kNoEnergy || before - energy < kEnergyFall * before) break;
    }
    return result;
}

}  // namespace lissom
