#include "kernel/solve/grid/grid_green.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "kernel/core/numbers/bits.h"
#include "kernel/solve/sparse/dense_kernels.h"

namespace lissom {
namespace {

// Share of the greatest possible entry that is added to all entries.
constexpr double kShift = 0.015;

// Lines of a spectrum that a thread takes.
constexpr Index kLineGrain = 64;

double term(Index k, Index n) {
    return (2.0 - 2.0 * std::cos(kPi * k / n)) / 6.0;
}

// Entry p + (n + 1) k: -w(k) cos(pi k p / n).
std::vector<double> cosines(Index n) {
    std::vector<double> table(at(n + 1) * n);
    for (Index k = 0; k < n; ++k) {
        const double weight = (k == 0 ? 0.5 : 1.0) / n;
        for (Index p = 0; p <= n; ++p) {
            const std::int64_t turn = std::int64_t{k} * p % (std::int64_t{2} * n);
            table[p + at(k) * (n + 1)] = -weight * std::cos(kPi * turn / n);
        }
    }
    return table;
}

// Sums over the slowest axis of `from`, of n entries, into n + 1 that become the fastest.
std::vector<double> sum_axis(const std::vector<double>& from, Index n, const Context& context) {
    const std::vector<double> table = cosines(n);
    const auto columns = index_of(from.size() / n);
    std::vector<double> to(at(columns) * (n + 1));
    const DenseKernels kernels = dense_kernels(best_processor());
    const Index blocks = (columns + kPanelColumns - 1) / kPanelColumns;
    context.parallel_for(0, blocks, 8, [&](Index begin, Index end) {
        const auto packed = unfilled<double[]>(kPackedSize);
        for (Index first = begin * kPanelColumns; first < std::min(columns, end * kPanelColumns);
             first += kPanelColumns) {
            DenseProduct product;
            product.a = table.data();
            product.stride = product.c_stride = product.rows = n + 1;
            product.b = from.data() + first;
            product.b_stride = columns;
            product.columns = std::min(kPanelColumns, columns - first);
            product.depth = n;
            product.c = to.data() + at(first) * (n + 1);
            product.packed = packed.get();
            kernels.multiply(product);
        }
    });
    return to;
}

// The two places of an axis at which the table is read, times `stride`.
struct Places {
    Index near, far;
};

void find_places(Index n, Index other, Index stride, std::vector<Places>& places) {
    places.resize(n);
    for (Index i = 0; i < n; ++i) {
        const Index sum = i + other + 1;
        places[i] = {std::abs(i - other) * stride, (sum > n ? 2 * n - sum : sum) * stride};
    }
}

double sum_of_eight(const double* table, const Places& x, const Places& y, const Places& z) {
    const double *nn = table + y.near + z.near, *fn = table + y.far + z.near;
    const double *nf = table + y.near + z.far, *ff = table + y.far + z.far;
    return ((nn[x.near] + nn[x.far]) + (fn[x.near] + fn[x.far])) +
           ((nf[x.near] + nf[x.far]) + (ff[x.near] + ff[x.far]));
}

std::size_t table_entries(const GridSize& size) {
    return at(size.nx + 1) * (size.ny + 1) * (size.nz + 1);
}

}  // namespace

GridGreen::GridGreen(const GridSize& size, double tension, const Context& context)
    : transform_(size), tension_(tension) {
    for (int axis = 0; axis < 3; ++axis) {
        const Index n = size[axis];
        for (Index q = 0; q < n; ++q) {
            terms_[axis].push_back(term(CosineTransform::frequency(q, n), n));
        }
    }
    fill_table(context);
}

void GridGreen::fill_table(const Context& context) {
    const auto [nx, ny, nz] = size();
    std::vector<double> values(size().count());
    for (Index z = 0, i = 0; z < nz; ++z) {
        for (Index y = 0; y < ny; ++y) {
            for (Index x = 0; x < nx; ++x, ++i) {
                const double mu = term(x, nx) + term(y, ny) + term(z, nz);
                values[i] = i == 0 ? 0.0 : 1.0 / (mu * mu + tension_ * mu);
            }
        }
        context.checkpoint();
    }
    values = sum_axis(values, nz, context);
    values = sum_axis(values, ny, context);
    table_ = sum_axis(values, nx, context);
    shift_ = kShift * 8.0 * table_.front();
}

std::size_t GridGreen::bytes(const GridSize& size) {
    return CosineTransform::bytes(size) + table_entries(size) * sizeof(double);
}

std::size_t GridGreen::working_bytes(const GridSize& size) {
    return 2 * table_entries(size) * sizeof(double);
}

void GridGreen::column(const GridPoint& other, std::span<const GridPoint> points,
                       double* entries) const {
    const auto [nx, ny, nz] = size();
    std::vector<Places> xs, ys, zs;
    find_places(nx, other.x, 1, xs);
    find_places(ny, other.y, nx + 1, ys);
    find_places(nz, other.z, (nx + 1) * (ny + 1), zs);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const GridPoint& p = points[i];
        entries[i] = sum_of_eight(table_.data(), xs[p.x], ys[p.y], zs[p.z]);
    }
}

double GridGreen::entry(const GridPoint& a, const GridPoint& b) const {
    const auto [nx, ny, nz] = size();
    const auto places = [](Index n, Index i, Index j, Index stride) {
        const Index sum = i + j + 1;
        return Places{std::abs(i - j) * stride, (sum > n ? 2 * n - sum : sum) * stride};
    };
    return sum_of_eight(table_.data(), places(nx, a.x, b.x, 1), places(ny, a.y, b.y, nx + 1),
                        places(nz, a.z, b.z, (nx + 1) * (ny + 1)));
}

// Divides spectra by the eigenvalues; the constant mode becomes zero.
void GridGreen::scale(double* spectra, const Context& context) const {
    const auto [nx, ny, nz] = size();
    const std::size_t total = size().count();
    context.parallel_for(0, ny * nz, kLineGrain, [&, nx = nx, ny = ny](Index begin, Index end) {
        std::vector<double> inverse(nx);
        for (Index line = begin; line < end; ++line) {
            const double rest = terms_[1][line % ny] + terms_[2][line / ny];
            for (Index x = 0; x < nx; ++x) {
                const double mu = terms_[0][x] + rest;
                inverse[x] = 1.0 / (mu * mu + tension_ * mu);
            }
            if (line == 0) inverse[0] = 0.0;
            for (int c = 0; c < kComponents; ++c) {
                double* values = spectra + c * total + at(line) * nx;
                for (Index x = 0; x < nx; ++x) values[x] *= inverse[x];
            }
        }
    });
}

void GridGreen::apply(double* field, double* scratch, const Context& context) const {
    transform_.forward(field, scratch, context);
    scale(scratch, context);
    FieldSink sink;
    sink.components = field;
    transform_.inverse(scratch, field, sink, context);
}

void GridGreen::apply_at(std::span<const GridPoint> points, std::span<const Vec3> values,
                         double* first, double* second, const FieldSink& sink,
                         const Context& context) const {
    transform_.forward_at(points, values, second, first, context);
    scale(first, context);
    transform_.inverse(first, second, sink, context);
}

}  // namespace lissom
