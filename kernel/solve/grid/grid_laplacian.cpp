#include "kernel/solve/grid/grid_laplacian.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "kernel/solve/grid/cosine_transform.h"

namespace lissom {
namespace {

// Lines of the grid that a thread takes.
constexpr Index kLaplacianGrain = 64;

// The neighbours of a point, in ascending order of their indices.
struct Neighborhood {
    std::array<GridPoint, 6> point;
    int count = 0;
};

Neighborhood neighborhood(const GridSize& size, const GridPoint& p) {
    Neighborhood n;
    const auto add = [&](Index x, Index y, Index z) {
        if (x < 0 || y < 0 || z < 0 || x >= size.nx || y >= size.ny || z >= size.nz) return;
        n.point[n.count++] = {x, y, z};
    };
    add(p.x, p.y, p.z - 1);
    add(p.x, p.y - 1, p.z);
    add(p.x - 1, p.y, p.z);
    add(p.x + 1, p.y, p.z);
    add(p.x, p.y + 1, p.z);
    add(p.x, p.y, p.z + 1);
    return n;
}

// to = L from, for one line along x.
void apply_line(const GridSize& size, const double* from, Index y, Index z, double* to) {
    const std::ptrdiff_t row = size.nx, plane = row * size.ny;
    const double* own = from + y * row + z * plane;
    std::fill_n(to, size.nx, 0.0);
    const auto add = [&](const double* other) {
        for (Index x = 0; x < size.nx; ++x) to[x] += own[x] - other[x];
    };
    if (y > 0) add(own - row);
    if (y + 1 < size.ny) add(own + row);
    if (z > 0) add(own - plane);
    if (z + 1 < size.nz) add(own + plane);
    for (Index x = 0; x + 1 < size.nx; ++x) {
        const double step = own[x] - own[x + 1];
        to[x] += step;
        to[x + 1] -= step;
    }
}

// Calls body(line number, y, z, shift of the component) for every line of three fields.
template <typename Body>
void for_each_line(const GridSize& size, const Context& context, const Body& body) {
    const std::size_t total = size.count();
    context.parallel_for(0, size.ny * size.nz, kLaplacianGrain, [&](Index begin, Index end) {
        for (Index line = begin; line < end; ++line) {
            for (int c = 0; c < kComponents; ++c) {
                body(at(line) * size.nx, line % size.ny, line / size.ny, c * total);
            }
        }
    });
}

struct Entries {
    std::vector<Index> row;
    std::vector<double> value;

    void add(Index i, double v) {
        const auto at = std::find(row.begin(), row.end(), i);
        if (at != row.end()) {
            value[at - row.begin()] += v;
            return;
        }
        row.push_back(i);
        value.push_back(v);
    }
};

}  // namespace

Index GridLaplacian::neighbors(const GridPoint& p) const {
    Index count = 0;
    const std::array<Index, 3> place{p.x, p.y, p.z};
    for (int axis = 0; axis < 3; ++axis) {
        count += place[axis] > 0 ? 1 : 0;
        count += place[axis] + 1 < size_[axis] ? 1 : 0;
    }
    return count;
}

double GridLaplacian::square_weight(const GridPoint& p) const {
    if (boundary_ == GridBoundary::zero_flux) return 1.0 / 36.0;
    const double count = std::max<Index>(1, neighbors(p));
    return 1.0 / (count * count);
}

// L (S^2 L x + (tau / 6) x).
void GridLaplacian::apply(const double* x, double* y, double* scratch,
                          const Context& context) const {
    for_each_line(size_, context, [&](std::size_t line, Index j, Index k, std::size_t shift) {
        double* to = scratch + shift + line;
        apply_line(size_, x + shift, j, k, to);
        const double* from = x + shift + line;
        for (Index i = 0; i < size_.nx; ++i) {
            to[i] = square_weight({i, j, k}) * to[i] + tension_ / 6.0 * from[i];
        }
    });
    for_each_line(size_, context, [&](std::size_t line, Index j, Index k, std::size_t shift) {
        apply_line(size_, scratch + shift, j, k, y + shift + line);
    });
}

// Column j of L S^2 L holds the points within two steps along edges from point j.
SymmetricMatrix GridLaplacian::matrix() const {
    SymmetricMatrix matrix;
    for (Index j = 0; j < size_.count(); ++j) {
        Entries column;
        const auto spread = [&](const GridPoint& p, double factor) {
            const Neighborhood around = neighborhood(size_, p);
            const auto add = [&](const GridPoint& q, double v) {
                if (const Index i = size_.index(q); i >= j) column.add(i, v);
            };
            add(p, factor * around.count);
            for (int n = 0; n < around.count; ++n) add(around.point[n], -factor);
        };
        const GridPoint own = size_.point(j);
        const Neighborhood around = neighborhood(size_, own);
        column.add(j, 0.0);
        spread(own, square_weight(own) * around.count + tension_ / 6.0);
        for (int n = 0; n < around.count; ++n) {
            spread(around.point[n], -square_weight(around.point[n]));
        }
        std::vector<std::size_t> order(column.row.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return column.row[a] < column.row[b]; });
        for (const std::size_t k : order) {
            matrix.row.push_back(column.row[k]);
            matrix.value.push_back(column.value[k]);
        }
        matrix.begin.push_back(count_of(matrix.row));
    }
    return matrix;
}

}  // namespace lissom
