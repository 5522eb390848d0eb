#include "kernel/solve/dual/bordered_cholesky.h"

#include <algorithm>
#include <cstddef>

#include "kernel/core/error.h"
#include "kernel/core/lanes.h"
#include "kernel/core/numbers/bits.h"
#include "kernel/solve/sparse/dense_kernels.h"

namespace lissom {
namespace {

// Columns filled, and rows computed, by a thread at a time; a multiple of the rows that the kernels
// take together.
constexpr Index kFillGrain = 16, kRowGrain = 72, kRowStep = 12;

using Scratch = std::unique_ptr<double[]>;

Scratch make_scratch() {
    return unfilled<double[]>(kPackedSize);
}

// A column more than there are rows at most, and never a multiple of a large power of two, which
// would put all entries of a row into the same few lines of a cache.
Index stride_for(Index size) {
    const Index slack = std::max<Index>(32, size / 8);
    return (size + slack + 15) / 16 * 16 + 8;
}

// For few new rows, so that two threads share them.
Index row_grain(Index rows) {
    const Index half = (rows + 1) / 2;
    return std::min(kRowGrain, (half + kRowStep - 1) / kRowStep * kRowStep);
}

struct Factor {
    const double* value;
    std::ptrdiff_t stride;
    Index size;
};

// L y = b, then L^T x = y: column by column, which is how the factor lies in memory.
LISSOM_INLINE void solve_factor(const Factor& factor, double* values) {
    auto* x = reinterpret_cast<Lanes<double>*>(values);
    for (Index j = 0; j < factor.size; ++j) {
        const double* column = factor.value + j * factor.stride;
        const Lanes<double> own = (1.0 / column[j]) * x[j];
        x[j] = own;
        for (Index i = j + 1; i < factor.size; ++i) x[i] -= column[i] * own;
    }
    for (Index j = factor.size - 1; j >= 0; --j) {
        const double* column = factor.value + j * factor.stride;
        Lanes<double> sum[4] = {x[j], {}, {}, {}};
        Index i = j + 1;
        for (; i + 4 <= factor.size; i += 4) {
            for (int k = 0; k < 4; ++k) sum[k] -= column[i + k] * x[i + k];
        }
        for (; i < factor.size; ++i) sum[0] -= column[i] * x[i];
        sum[0] += sum[1];
        sum[2] += sum[3];
        sum[0] += sum[2];
        x[j] = (1.0 / column[j]) * sum[0];
    }
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void solve_with_avx2(const Factor& factor, double* values) {
    solve_factor(factor, values);
}
#endif

void solve_anywhere(const Factor& factor, double* values) {
    solve_factor(factor, values);
}

}  // namespace

std::size_t BorderedCholesky::bytes(Index size) {
    const std::size_t stride = stride_for(size);
    return stride * stride * sizeof(double);
}

void BorderedCholesky::truncate(Index size) {
    size_ = std::min(size_, size);
}

void BorderedCholesky::reserve(Index size, const Context& context) {
    if (size <= stride_) return;
    MemoryCharge charge = context.charge(bytes(size), "the factor of the constraints");
    const Index stride = stride_for(size);
    auto value = unfilled<double[]>(bytes(size) / sizeof(double));
    for (Index j = 0; j < size_; ++j) {
        std::copy_n(entry(j, j), size_ - j, value.get() + j + std::ptrdiff_t{j} * stride);
    }
    value_ = std::move(value);
    stride_ = stride;
    charge_ = std::move(charge);
}

void BorderedCholesky::extend(Index size, const Fill& fill, const Context& context) {
    if (size <= size_) return;
    // Sums end with panels: with the same panels as in a factor from nothing they are the same.
    truncate(size_ / kPanelColumns * kPanelColumns);
    reserve(size, context);
    fill_rows(size, fill, context);
    border_old_columns(size, context);
    eliminate_new_columns(size, context);
    size_ = size;
}

void BorderedCholesky::fill_rows(Index size, const Fill& fill, const Context& context) {
    context.parallel_for(0, size, kFillGrain, [&](Index begin, Index end) {
        for (Index j = begin; j < end; ++j) {
            const Index first = std::max(j, size_);
            fill(j, first, size, entry(first, j));
        }
    });
}

// The new rows below the old columns: each is computed from itself and the old rows alone.
void BorderedCholesky::border_old_columns(Index size, const Context& context) {
    if (size_ == 0) return;
    const DenseKernels kernels = dense_kernels(best_processor());
    context.parallel_for(size_, size, row_grain(size - size_), [&](Index begin, Index end) {
        const Scratch packed = make_scratch();
        for (Index first = 0; first < size_; first += kPanelColumns) {
            context.checkpoint();
            const Index columns = std::min(kPanelColumns, size_ - first);
            if (first > 0) {
                kernels.multiply({entry(begin, 0), entry(first, 0), entry(begin, first), stride_,
                                  stride_, end - begin, columns, first, begin, true, packed.get()});
            }
            kernels.solve_rows({value_.get(), stride_, first, columns, packed.get()}, begin, end);
        }
    });
}

void BorderedCholesky::eliminate_new_columns(Index size, const Context& context) {
    const DenseKernels kernels = dense_kernels(best_processor());
    const Scratch own = make_scratch();
    for (Index first = size_; first < size; first += kPanelColumns) {
        const Index columns = std::min(kPanelColumns, size - first), below = first + columns;
        const DensePanel panel{value_.get(), stride_, first, columns, own.get()};
        const auto subtract = [&](Index begin, Index end, double* packed) {
            if (first == 0) return;
            kernels.multiply({entry(begin, 0), entry(first, 0), entry(begin, first), stride_,
                              stride_, end - begin, columns, first, begin, true, packed});
        };
        subtract(first, below, own.get());
        if (const Index failed = kernels.eliminate(panel); failed != kNoIndex) {
            throw Error(ErrorCode::not_positive_definite,
                        "the constraints of the grid cannot be told apart in double precision; "
                        "use weights that differ less",
                        {ElementKind::row, 1, {failed}});
        }
        context.parallel_for(below, size, kRowGrain, [&](Index begin, Index end) {
            const Scratch packed = make_scratch();
            subtract(begin, end, packed.get());
            DensePanel part = panel;
            part.packed = packed.get();
            kernels.solve_rows(part, begin, end);
        });
    }
}

void BorderedCholesky::solve(double* values) const {
    const Factor factor{value_.get(), stride_, size_};
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) {
        solve_with_avx2(factor, values);
        return;
    }
#endif
    solve_anywhere(factor, values);
}

}  // namespace lissom
