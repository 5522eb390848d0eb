#include "kernel/solve/grid/cosine_transform.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "kernel/core/numbers/bits.h"
#include "kernel/solve/sparse/dense_kernels.h"

namespace lissom {
namespace {

// Columns of a product that are computed together, and how many such blocks a thread takes.
constexpr Index kBlock = kPanelColumns, kBlockGrain = 4;

// Buffers of one thread.
struct TransformScratch {
    explicit TransformScratch(Index n)
        : packed(unfilled<double[]>(kPackedSize)), halves(unfilled<double[]>(at(n + 1) * kBlock)) {}
    std::unique_ptr<double[]> packed, halves;
};

// Calls body(component, first column, columns, scratch) for every block of columns.
template <typename Body>
void for_each_block(Index columns, Index n, const Context& context, const Body& body) {
    const Index blocks = (columns + kBlock - 1) / kBlock;
    context.parallel_for(0, blocks, kBlockGrain, [&](Index begin, Index end) {
        TransformScratch scratch(n);
        for (Index b = begin; b < end; ++b) {
            const Index first = b * kBlock;
            for (int c = 0; c < kComponents; ++c) {
                body(c, first, std::min(kBlock, columns - first), scratch);
            }
        }
    });
}

// The sums and differences of mirrored entries of `columns` columns, `n` rows at `stride`.
void fold(const double* from, std::ptrdiff_t stride, Index n, Index columns, double* sums,
          double* differences) {
    for (Index j = 0; j < n / 2; ++j) {
        const double *low = from + j * stride, *high = from + (n - 1 - j) * stride;
        double *sum = sums + j * columns, *difference = differences + j * columns;
        for (Index c = 0; c < columns; ++c) {
            sum[c] = low[c] + high[c];
            difference[c] = low[c] - high[c];
        }
    }
    if (n % 2 == 1) std::copy_n(from + n / 2 * stride, columns, sums + n / 2 * columns);
}

// Undoes `fold` for one column: write(i, value) for every row.
template <typename Write>
void unfold(const double* even, const double* odd, Index n, const Write& write) {
    for (Index j = 0; j < n / 2; ++j) write(j, even[j] + odd[j]);
    if (n % 2 == 1) write(n / 2, even[n / 2]);
    for (Index j = n / 2 - 1; j >= 0; --j) write(n - 1 - j, even[j] - odd[j]);
}

void write_column(const FieldSink& sink, int component, std::size_t count, std::size_t first,
                  const double* even, const double* odd, Index n) {
    const double constant = sink.constant[component];
    if (sink.components) {
        double* to = sink.components + component * count + first;
        unfold(even, odd, n, [&](Index i, double value) { to[i] = value + constant; });
    } else if (sink.vectors) {
        Vec3* to = sink.vectors + first;
        unfold(even, odd, n, [&](Index i, double value) { to[i][component] = value + constant; });
    } else {
        float* to = sink.quads + 4 * first + component;
        unfold(even, odd, n,
               [&](Index i, double value) { to[4 * i] = static_cast<float>(value + constant); });
    }
}

}  // namespace

CosineTransform::Axis::Axis(Index points) : n(points), even((points + 1) / 2), odd(points / 2) {
    const auto entries = [](Index a, Index b) { return at(a) * b; };
    basis.resize(entries(n, n));
    for (Index q = 0; q < n; ++q) {
        const Index k = frequency(q, n);
        const double scale = std::sqrt((k == 0 ? 1.0 : 2.0) / n);
        for (Index j = 0; j < n; ++j) {
            // Reduced first, so that the argument is exact for any frequency.
            const std::int64_t quarter = (std::int64_t{2} * j + 1) * k % (std::int64_t{4} * n);
            basis[q + entries(n, j)] = scale * std::cos(kPi * quarter / (2.0 * n));
        }
    }
    forward_even.resize(entries(even, even));
    inverse_even.resize(entries(even, even));
    forward_odd.resize(entries(odd, odd));
    inverse_odd.resize(entries(odd, odd));
    for (Index q = 0; q < even; ++q) {
        for (Index j = 0; j < even; ++j) {
            forward_even[q + entries(even, j)] = -basis[q + entries(n, j)];
            inverse_even[j + entries(even, q)] = -basis[q + entries(n, j)];
        }
    }
    for (Index q = 0; q < odd; ++q) {
        for (Index j = 0; j < odd; ++j) {
            forward_odd[q + entries(odd, j)] = -basis[even + q + entries(n, j)];
            inverse_odd[j + entries(odd, q)] = -basis[even + q + entries(n, j)];
        }
    }
}

CosineTransform::CosineTransform(const GridSize& size)
    : size_(size), axes_{Axis(size.nx), Axis(size.ny), Axis(size.nz)} {}

std::size_t CosineTransform::bytes(const GridSize& size) {
    std::size_t entries = 0;
    for (int axis = 0; axis < 3; ++axis) entries += 2 * at(size[axis]) * size[axis];
    return entries * sizeof(double);
}

Index CosineTransform::frequency(Index q, Index n) {
    const Index even = (n + 1) / 2;
    return q < even ? 2 * q : 2 * (q - even) + 1;
}

// Transforms the slowest axis, which becomes the fastest.
void CosineTransform::forward_step(const Axis& axis, const double* from, double* to,
                                   const Context& context) const {
    const DenseKernels kernels = dense_kernels(best_processor());
    const Index total = size_.count(), stride = total / axis.n;
    for_each_block(stride, axis.n, context,
                   [&](int c, Index first, Index columns, TransformScratch& s) {
                       const std::size_t shift = at(c) * total;
                       double *sums = s.halves.get(), *differences = sums + axis.even * columns;
                       fold(from + shift + first, stride, axis.n, columns, sums, differences);
                       DenseProduct product;
                       product.packed = s.packed.get();
                       product.columns = columns;
                       product.b_stride = columns;
                       product.c_stride = axis.n;
                       product.c = to + shift + std::ptrdiff_t{first} * axis.n;
                       product.a = axis.forward_even.data();
                       product.b = sums;
                       product.rows = product.depth = axis.even;
                       product.stride = axis.even;
                       kernels.multiply(product);
                       if (axis.odd == 0) return;
                       product.c += axis.even;
                       product.a = axis.forward_odd.data();
                       product.b = differences;
                       product.rows = product.depth = axis.odd;
                       product.stride = axis.odd;
                       kernels.multiply(product);
                   });
}

void CosineTransform::inverse_step(const Axis& axis, const double* from, const FieldSink& sink,
                                   const Context& context) const {
    const DenseKernels kernels = dense_kernels(best_processor());
    const Index total = size_.count(), stride = total / axis.n;
    for_each_block(stride, axis.n, context,
                   [&](int c, Index first, Index columns, TransformScratch& s) {
                       const double* block = from + at(c) * total + first;
                       double *even = s.halves.get(), *odd = even + axis.even * columns;
                       DenseProduct product;
                       product.packed = s.packed.get();
                       product.columns = columns;
                       product.b_stride = stride;
                       product.a = axis.inverse_even.data();
                       product.b = block;
                       product.c = even;
                       product.rows = product.depth = axis.even;
                       product.stride = product.c_stride = axis.even;
                       kernels.multiply(product);
                       if (axis.odd > 0) {
                           product.a = axis.inverse_odd.data();
                           product.b = block + std::ptrdiff_t{axis.even} * stride;
                           product.c = odd;
                           product.rows = product.depth = axis.odd;
                           product.stride = product.c_stride = axis.odd;
                           kernels.multiply(product);
                       }
                       for (Index i = 0; i < columns; ++i) {
                           write_column(sink, c, total, at(first + i) * axis.n,
                                        even + i * axis.even, odd + i * axis.odd, axis.n);
                       }
                   });
}

void CosineTransform::forward(double* from, double* to, const Context& context) const {
    forward_step(axes_[2], from, to, context);
    forward_step(axes_[1], to, from, context);
    forward_step(axes_[0], from, to, context);
}

// The first step of a forward transform, of which most columns are zero.
void CosineTransform::scatter(std::span<const GridPoint> points, std::span<const Vec3> values,
                              double* to, const Context& context) const {
    const Axis& axis = axes_[2];
    const std::size_t total = size_.count();
    context.parallel_for(0, kComponents, 1, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
            double* field = to + c * total;
            std::fill_n(field, total, 0.0);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const GridPoint& p = points[i];
                const double value = values[i][c];
                const double* basis = axis.basis.data() + std::ptrdiff_t{p.z} * axis.n;
                double* column = field + (p.x + std::ptrdiff_t{p.y} * size_.nx) * axis.n;
                for (Index q = 0; q < axis.n; ++q) column[q] += value * basis[q];
            }
        }
    });
}

void CosineTransform::forward_at(std::span<const GridPoint> points, std::span<const Vec3> values,
                                 double* scratch, double* to, const Context& context) const {
    scatter(points, values, to, context);
    forward_step(axes_[1], to, scratch, context);
    forward_step(axes_[0], scratch, to, context);
}

void CosineTransform::inverse(double* from, double* scratch, const FieldSink& sink,
                              const Context& context) const {
    FieldSink between;
    between.components = scratch;
    inverse_step(axes_[2], from, between, context);
    between.components = from;
    inverse_step(axes_[1], scratch, between, context);
    inverse_step(axes_[0], from, sink, context);
}

}  // namespace lissom
