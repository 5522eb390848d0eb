/// Grids, constraints and a reference solution for tests of the grid field.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "kernel/solve/field/grid_field.h"

namespace lissom::test {

using Field = std::vector<Vec3>;

inline double max_difference(const Field& a, const Field& b) {
    double worst = a.size() == b.size() ? 0.0 : 1e300;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (!a[i].allFinite() || !b[i].allFinite()) return 1e300;
        worst = std::max(worst, (a[i] - b[i]).cwiseAbs().maxCoeff());
    }
    return worst;
}

inline Field solved_field(GridField& field, const Context& context = {}) {
    field.solve(context);
    Field result(static_cast<std::size_t>(field.size().count()));
    field.evaluate(std::span<Vec3>(result), context);
    return result;
}

inline Field solved_field(const GridSize& size, const std::vector<GridConstraint>& constraints,
                          const GridFieldOptions& options = {}, const Context& context = {}) {
    GridField field(size, options, context);
    field.set_constraints(0, constraints);
    return solved_field(field, context);
}

inline Vec3 random_vector(std::mt19937& random) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const double x = number(random), y = number(random);
    return {x, y, number(random)};
}

/// `count` different points with random vectors.
inline std::vector<GridConstraint> random_constraints(const GridSize& size, Index count,
                                                      std::mt19937& random, double weight = 100.0) {
    std::uniform_int_distribution<Index> point(0, size.count() - 1);
    std::map<Index, Vec3> chosen;
    while (static_cast<Index>(chosen.size()) < count) {
        chosen.emplace(point(random), random_vector(random));
    }
    std::vector<GridConstraint> constraints;
    for (const auto& entry : chosen) constraints.push_back({entry.first, entry.second, weight});
    return constraints;
}

/// The points near a walk from a random point, with the directions of its steps: a curve.
inline std::vector<GridConstraint> random_curve(const GridSize& size, Index steps,
                                                std::mt19937& random) {
    const auto inside = [](double v, Index n) {
        return std::clamp(static_cast<Index>(std::lround(v)), Index{0}, n - 1);
    };
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Vec3 p(unit(random) * size.nx, unit(random) * size.ny, unit(random) * size.nz);
    Vec3 direction = random_vector(random).normalized();
    std::map<Index, Vec3> chosen;
    for (Index i = 0; i < steps; ++i) {
        direction = (direction + 0.3 * random_vector(random)).normalized();
        p += direction;
        chosen.emplace(
            size.index({inside(p.x(), size.nx), inside(p.y(), size.ny), inside(p.z(), size.nz)}),
            direction);
    }
    std::vector<GridConstraint> constraints;
    for (const auto& entry : chosen) constraints.push_back({entry.first, entry.second});
    return constraints;
}

/// The minimiser of the energy (4.1) with the constraints of (4.2), from the normal equation (4.3)
/// built term by term and eliminated densely in long double. Mirrored neighbours and |N(i)| are
/// taken from their definitions.
inline Field dense_solution(const GridSize& size, const std::vector<GridConstraint>& constraints,
                            GridBoundary boundary, double tension) {
    using Real = long double;
    const auto n = static_cast<std::size_t>(size.count());
    std::vector<std::vector<Real>> a(n, std::vector<Real>(n + 3, 0.0L));
    // Adds weight * row' row for a row given by its entries.
    const auto add_row = [&](const std::map<Index, Real>& row, Real weight) {
        for (const auto& [i, u] : row) {
            for (const auto& [j, v] : row) a[i][j] += weight * u * v;
        }
    };
    for (Index i = 0; i < size.count(); ++i) {
        const GridPoint p = size.point(i);
        std::vector<Index> around;
        const auto visit = [&](Index x, Index y, Index z) {
            if (x < 0 || y < 0 || z < 0 || x >= size.nx || y >= size.ny || z >= size.nz) return;
            around.push_back(size.index({x, y, z}));
        };
        visit(p.x - 1, p.y, p.z);
        visit(p.x + 1, p.y, p.z);
        visit(p.x, p.y - 1, p.z);
        visit(p.x, p.y + 1, p.z);
        visit(p.x, p.y, p.z - 1);
        visit(p.x, p.y, p.z + 1);
        const Real share = boundary == GridBoundary::zero_flux
                               ? 1.0L / 6.0L
                               : 1.0L / static_cast<Real>(around.size());
        std::map<Index, Real> row;
        for (const Index j : around) {
            row[j] += share;
            row[i] -= share;
            if (j > i) add_row({{i, 1.0L}, {j, -1.0L}}, static_cast<Real>(tension) / 6.0L);
        }
        add_row(row, 1.0L);
    }
    for (const GridConstraint& c : constraints) {
        const Real square = static_cast<Real>(c.weight) * c.weight;
        a[c.point][c.point] += square;
        for (int k = 0; k < 3; ++k) a[c.point][n + k] += square * c.value[k];
    }
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = k + 1; i < n; ++i) {
            if (a[i][k] == 0.0L) continue;
            const Real factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n + 3; ++j) a[i][j] -= factor * a[k][j];
        }
    }
    Field field(n);
    for (int c = 0; c < 3; ++c) {
        std::vector<Real> x(n);
        for (std::size_t k = n; k-- > 0;) {
            Real sum = a[k][n + c];
            for (std::size_t j = k + 1; j < n; ++j) sum -= a[k][j] * x[j];
            x[k] = sum / a[k][k];
            field[k][c] = static_cast<double>(x[k]);
        }
    }
    return field;
}

}  // namespace lissom::test
