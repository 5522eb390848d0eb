#include "kernel/solve/sparse/sparse_matrix.h"

#include <algorithm>
#include <string>

#include "kernel/core/error.h"
#include "kernel/core/extended.h"

namespace lissom {

void SymmetricMatrix::multiply(const double* x, double* y, Index columns) const {
    const Index n = size();
    std::fill(y, y + at(n) * columns, 0.0);
    for (Index c = 0; c < columns; ++c) {
        const double* in = x + at(c) * n;
        double* out = y + at(c) * n;
        for (Index j = 0; j < n; ++j) {
            out[j] += value[begin[j]] * in[j];
            for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) {
                out[row[k]] += value[k] * in[j];
                out[j] += value[k] * in[row[k]];
            }
        }
    }
}

void SymmetricMatrix::residual(const Extended* b, const double* x, double* r, Index columns) const {
    const Index n = size();
    std::vector<Extended> sum(n);
    for (Index c = 0; c < columns; ++c) {
        const std::size_t shift = at(c) * n;
        const double* in = x + shift;
        std::copy(b + shift, b + shift + n, sum.begin());
        for (Index j = 0; j < n; ++j) {
            const Extended xj = in[j];
            Extended own = value[begin[j]] * xj;
            for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) {
                const Extended a = value[k];
                sum[row[k]] -= a * xj;
                own += a * in[row[k]];
            }
            sum[j] -= own;
        }
        for (Index j = 0; j < n; ++j) r[shift + j] = static_cast<double>(sum[j]);
    }
}

SymmetricMatrix symmetric_from_triplets(Index size, const std::vector<Triplet>& entries) {
    std::vector<Triplet> lower;
    lower.reserve(entries.size() + size);
    for (const Triplet& e : entries) {
        if (e.row < 0 || e.column < 0 || e.row >= size || e.column >= size) {
            throw Error(ErrorCode::out_of_range,
                        "an entry lies outside the matrix of size " + std::to_string(size),
                        {ElementKind::row, 1, {e.row}});
        }
        if (e.row >= e.column) lower.push_back(e);
    }
    for (Index i = 0; i < size; ++i) lower.push_back({i, i, 0.0});
    std::stable_sort(lower.begin(), lower.end(), [](const Triplet& a, const Triplet& b) {
        return a.column != b.column ? a.column < b.column : a.row < b.row;
    });
    SymmetricMatrix matrix;
    matrix.begin.assign(at(size) + 1, 0);
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const Triplet& e = lower[i];
        if (i > 0 && lower[i - 1].row == e.row && lower[i - 1].column == e.column) {
            matrix.value.back() += e.value;
            continue;
        }
        matrix.row.push_back(e.row);
        matrix.value.push_back(e.value);
        ++matrix.begin[e.column + 1];
    }
    for (Index j = 0; j < size; ++j) matrix.begin[j + 1] += matrix.begin[j];
    return matrix;
}

}  // namespace lissom
