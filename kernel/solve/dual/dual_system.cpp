#include "kernel/solve/dual/dual_system.h"

#include <algorithm>

namespace lissom {

DualSystem::DualSystem(const GridGreen& green, Index dense_limit, double tolerance)
    : green_(green), dense_limit_(dense_limit), tolerance_(tolerance) {}

std::size_t DualSystem::bytes(std::size_t rows, Index dense_limit) {
    if (rows > at(dense_limit)) return MaximinFactor::bytes(rows);
    return BorderedCholesky::bytes(index_of(rows));
}

void DualSystem::update(const ConstraintRows& rows, const Context& context) {
    if (rows.size() <= at(dense_limit_)) {
        update_dense(rows, context);
        return;
    }
    if (!iterative_) {
        factor_ = {};
        rows_ = {};
        iterative_ = std::make_unique<ProjectedCG>(green_, tolerance_);
    }
    if (rows_.common(rows) == count_of(rows) && rows_.size() == rows.size()) return;
    iterative_->update(rows, context);
    rows_ = rows;
}

void DualSystem::update_dense(const ConstraintRows& rows, const Context& context) {
    if (iterative_) {
        iterative_.reset();
        rows_ = {};
    }
    const Index common = rows_.common(rows);
    factor_.truncate(common);
    rows_.point.resize(common);
    rows_.weight.resize(common);
    const std::span<const GridPoint> points = rows.point;
    const auto fill = [&](Index column, Index begin, Index end, double* entries) {
        const std::size_t count = end - begin;
        green_.column(points[column], points.subspan(begin, count), entries);
        for (std::size_t i = 0; i < count; ++i) entries[i] += green_.shift();
        if (begin == column) entries[0] += 1.0 / (rows.weight[column] * rows.weight[column]);
    };
    factor_.extend(count_of(rows), fill, context);
    rows_ = rows;
}

DualSolution DualSystem::solve(std::span<const Vec3> g, const Vec3& total,
                               FieldWorkspace& workspace, const Context& context) const {
    if (iterative_) return iterative_->solve(g, total, workspace, context);
    return solve_dense(g, total);
}

// M lambda + 1 a = g + shift 1 total, because the shift multiplies 1' lambda, which is known. The
// fourth right-hand side is 1, which gives a.
DualSolution DualSystem::solve_dense(std::span<const Vec3> g, const Vec3& total) const {
    std::vector<double> x(4 * g.size());
    for (std::size_t i = 0; i < g.size(); ++i) {
        for (int c = 0; c < kComponents; ++c) x[4 * i + c] = g[i][c] + green_.shift() * total[c];
        x[4 * i + 3] = 1.0;
    }
    factor_.solve(x.data());
    Vec4 sum = Vec4::Zero();
    for (std::size_t i = 0; i < g.size(); ++i) sum += Eigen::Map<const Vec4>(x.data() + 4 * i);
    DualSolution solution;
    solution.constant = (sum.head<3>() - total) / sum[3];
    solution.multiplier.reserve(g.size());
    for (std::size_t i = 0; i < g.size(); ++i) {
        const double* row = x.data() + 4 * i;
        solution.multiplier.push_back(Vec3(row[0], row[1], row[2]) - row[3] * solution.constant);
    }
    return solution;
}

}  // namespace lissom
