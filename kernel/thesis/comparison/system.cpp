#include "kernel/thesis/comparison/system.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/extended.h"
#include "kernel/deform/patch/row_accumulator.h"
#include "kernel/deform/system/firm_factor.h"

namespace lissom {
namespace {

// Unknowns assembled between two looks at whether to stop.
constexpr Index kStride = 4096;

}  // namespace

LeastSquares::LeastSquares(Index unknowns, Index per_vertex) : per_vertex_(per_vertex) {
    rows_.columns = unknowns;
}

void LeastSquares::add(Index column, double coefficient) {
    rows_.column.push_back(column);
    rows_.value.push_back(coefficient);
}

void LeastSquares::end_row(double weight) {
    rows_.begin.push_back(count_of(rows_.column));
    weight_.push_back(weight);
}

void LeastSquares::factor(std::span<const char> known, const Context& context) {
    row_of_.assign(known.size(), kNoIndex);
    for (Index i = 0; i < rows_.columns; ++i) {
        if (known[i]) continue;
        row_of_[i] = count_of(free_);
        free_.push_back(i);
    }
    transpose();
    if (free_.empty()) return;
    assemble(known, context);
    try {
        factor_firmly(system_, matrix_, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        Elements vertices = error.elements();
        for (Index& id : vertices.ids) id = free_[id] / per_vertex_;
        throw Error(error.code(), error.message(), std::move(vertices));
    }
}

void LeastSquares::transpose() {
    const std::size_t size = rows_.columns;
    columns_.columns = rows_.rows();
    columns_.begin.assign(size + 1, 0);
    for (const Index c : rows_.column) ++columns_.begin[c + 1];
    for (std::size_t i = 0; i < size; ++i) columns_.begin[i + 1] += columns_.begin[i];
    columns_.column.resize(rows_.column.size());
    columns_.value.resize(rows_.value.size());
    std::vector<Index> fill(columns_.begin.begin(), columns_.begin.end() - 1);
    for (Index r = 0; r < rows_.rows(); ++r) {
        for (Index e = rows_.begin[r]; e < rows_.begin[r + 1]; ++e) {
            const Index at = fill[rows_.column[e]]++;
            columns_.column[at] = r;
            columns_.value[at] = rows_.value[e];
        }
    }
}

// The free part of A^T W A, on and below the diagonal.
void LeastSquares::assemble(std::span<const char> known, const Context& context) {
    RowAccumulator<double> sum(rows_.columns);
    for (const Index i : free_) {
        if (row_of_[i] % kStride == 0) context.checkpoint();
        sum.add(i, 0.0);
        for (Index t = columns_.begin[i]; t < columns_.begin[i + 1]; ++t) {
            const Index r = columns_.column[t];
            const double factor = weight_[r] * columns_.value[t];
            for (Index e = rows_.begin[r]; e < rows_.begin[r + 1]; ++e) {
                const Index j = rows_.column[e];
                if (j >= i && !known[j]) sum.add(j, factor * rows_.value[e]);
            }
        }
        sum.drain([&](Index j, double value) {
            matrix_.row.push_back(row_of_[j]);
            matrix_.value.push_back(value);
        });
        matrix_.begin.push_back(count_of(matrix_.row));
    }
}

// W (b - A x); an empty `b` is zero.
std::vector<double> LeastSquares::weighted_residual(std::span<const double> b,
                                                    std::span<const double> x) const {
    std::vector<double> residual(at(rows_.rows()));
    for (Index r = 0; r < rows_.rows(); ++r) {
        double sum = b.empty() ? 0.0 : b[r];
        for (Index e = rows_.begin[r]; e < rows_.begin[r + 1]; ++e) {
            sum -= rows_.value[e] * x[rows_.column[e]];
        }
        residual[r] = weight_[r] * sum;
    }
    return residual;
}

void LeastSquares::solve(std::span<const double> b, std::span<double> x, Index columns,
                         const Context& context) const {
    if (free_.empty()) return;
    const std::size_t unknowns = rows_.columns, rows = rows_.rows(), count = free_.size();
    std::vector<Extended> right;
    right.reserve(count * columns);
    for (Index c = 0; c < columns; ++c) {
        context.checkpoint();
        const std::span<double> values = x.subspan(c * unknowns, unknowns);
        for (const Index i : free_) values[i] = 0.0;
        const std::vector<double> residual =
            weighted_residual(b.empty() ? b : b.subspan(c * rows, rows), values);
        for (const Index i : free_) {
            Extended sum = 0.0;
            for (Index t = columns_.begin[i]; t < columns_.begin[i + 1]; ++t) {
                sum += static_cast<Extended>(columns_.value[t]) * residual[columns_.column[t]];
            }
            right.push_back(sum);
        }
    }
    std::vector<double> solution(right.size());
    system_.solve_refined(matrix_, right, solution, columns);
    for (Index c = 0; c < columns; ++c) {
        for (std::size_t f = 0; f < count; ++f) {
            x[c * unknowns + free_[f]] = solution[c * count + f];
        }
    }
}

}  // namespace lissom
