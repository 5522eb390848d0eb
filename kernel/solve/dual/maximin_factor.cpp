#include "kernel/solve/dual/maximin_factor.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <unordered_map>

#include "kernel/core/error.h"
#include "kernel/core/numbers/bits.h"
#include "kernel/solve/sparse/dense_kernels.h"

namespace lissom {
namespace {

// Maximum of entries in a column. Lower with so many rows that each has close neighbours in all
// directions; then the count of rows at which this begins.
constexpr std::size_t kNeighbors = 48, kFewNeighbors = 24, kManyRows = 50000;
static_assert(kNeighbors <= at(kPanelColumns));

// Cells around a row's own, in each direction, in which its neighbours are looked for.
constexpr Index kReach = 2;

// Columns that a thread computes at a time.
constexpr Index kColumnGrain = 64;

std::size_t neighbors_for(std::size_t rows) {
    return rows < kManyRows ? kNeighbors : kFewNeighbors;
}

// Numbers in no relation to its position, so that the choice of a cell's representative is fair.
std::uint64_t scrambled(std::uint64_t x) {
    x = (x ^ (x >> 31)) * 0x7fb5d329728ea185u;
    x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44du;
    return x ^ (x >> 33);
}

// The cell of side 2^level that a point lies in, as one number.
std::uint64_t cell_key(Index x, Index y, Index z) {
    return (static_cast<std::uint64_t>(x) << 42) | (static_cast<std::uint64_t>(y) << 21) |
           static_cast<std::uint64_t>(z);
}

using Cells = std::unordered_map<std::uint64_t, Index>;

// The hierarchy: levels[l] maps cells of side 2^l to the row that represents each.
struct Hierarchy {
    std::vector<Cells> levels;
    std::vector<Index> level_of;
};

Hierarchy build_hierarchy(const GridSize& size, const ConstraintRows& rows) {
    Hierarchy h;
    h.level_of.assign(rows.size(), 0);
    std::vector<std::uint64_t> rank;
    for (const GridPoint& p : rows.point) {
        rank.push_back(scrambled(static_cast<std::uint64_t>(size.index(p)) + 1));
    }
    std::vector<Index> survivors(rows.size());
    std::iota(survivors.begin(), survivors.end(), 0);
    for (Index level = 0;; ++level) {
        Cells cells;
        for (const Index i : survivors) {
            const GridPoint& p = rows.point[i];
            const auto at =
                cells.try_emplace(cell_key(p.x >> level, p.y >> level, p.z >> level), i);
            Index& best = at.first->second;
            if (rank[i] < rank[best]) best = i;
        }
        std::vector<Index> next;
        for (const Index i : survivors) {
            const GridPoint& p = rows.point[i];
            if (cells.at(cell_key(p.x >> level, p.y >> level, p.z >> level)) == i) {
                next.push_back(i);
                h.level_of[i] = level;
            }
        }
        survivors = std::move(next);
        h.levels.push_back(std::move(cells));
        if (survivors.size() == 1) return h;
    }
}

struct Neighbor {
    std::int64_t distance;
    Index place;
    bool operator<(const Neighbor& other) const {
        return distance != other.distance ? distance < other.distance : place < other.place;
    }
    bool operator==(const Neighbor& other) const { return place == other.place; }
};

// Rows that come before `row` and represent cells near it, at `level`.
void gather(const Hierarchy& h, const ConstraintRows& rows, const std::vector<Index>& place_of,
            Index row, Index level, std::vector<Neighbor>& found) {
    const GridPoint& p = rows.point[row];
    const GridPoint own{p.x >> level, p.y >> level, p.z >> level};
    const Cells& cells = h.levels[level];
    for (Index z = std::max(0, own.z - kReach); z <= own.z + kReach; ++z) {
        for (Index y = std::max(0, own.y - kReach); y <= own.y + kReach; ++y) {
            for (Index x = std::max(0, own.x - kReach); x <= own.x + kReach; ++x) {
                const auto at = cells.find(cell_key(x, y, z));
                if (at == cells.end() || place_of[at->second] >= place_of[row]) continue;
                const GridPoint& q = rows.point[at->second];
                const std::int64_t dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
                found.push_back({dx * dx + dy * dy + dz * dz, place_of[at->second]});
            }
        }
    }
}

// The places of the nearest rows before `row`, nearest first.
std::vector<Neighbor> neighbors(const Hierarchy& h, const ConstraintRows& rows,
                                const std::vector<Index>& place_of, Index row, std::size_t most) {
    std::vector<Neighbor> found;
    for (std::size_t level = h.level_of[row]; level < h.levels.size() && found.size() < most;
         ++level) {
        gather(h, rows, place_of, row, index_of(level), found);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }
    found.resize(std::min(found.size(), most));
    return found;
}

// u of L^T u = the last unit vector; L is a lower triangle of `size` columns, one behind the other.
void solve_last_unit(const double* block, Index size, double* u) {
    for (Index j = size - 1; j >= 0; --j) {
        const double* column = block + std::ptrdiff_t{j} * size;
        double sum = j == size - 1 ? 1.0 : 0.0;
        for (Index k = j + 1; k < size; ++k) sum -= column[k] * u[k];
        u[j] = sum / column[j];
    }
}

}  // namespace

std::size_t MaximinFactor::bytes(std::size_t rows) {
    return rows * (neighbors_for(rows) * (sizeof(Index) + sizeof(double)) + 200);
}

void MaximinFactor::fill_pattern(const GridSize& size, const ConstraintRows& rows, Columns& columns,
                                 const Context& context) {
    const Hierarchy h = build_hierarchy(size, rows);
    context.checkpoint();
    const auto count = count_of(rows);
    columns.row.resize(rows.size());
    std::iota(columns.row.begin(), columns.row.end(), 0);
    std::vector<Index> grid_index;
    for (const GridPoint& p : rows.point) grid_index.push_back(size.index(p));
    std::sort(columns.row.begin(), columns.row.end(), [&](Index a, Index b) {
        if (h.level_of[a] != h.level_of[b]) return h.level_of[a] > h.level_of[b];
        return grid_index[a] < grid_index[b];
    });
    std::vector<Index> place_of(rows.size());
    for (Index i = 0; i < count; ++i) {
        const Index row = columns.row[i];
        place_of[row] = i;
        columns.point.push_back(grid_index[row]);
        columns.weight.push_back(rows.weight[row]);
    }
    const std::size_t most = neighbors_for(rows.size()) - 1;
    std::vector<Index> found(rows.size() * (most + 1));
    std::vector<Index> counts(rows.size());
    context.parallel_for(0, count, kColumnGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            Index* to = found.data() + i * (most + 1);
            for (const Neighbor& n : neighbors(h, rows, place_of, columns.row[i], most)) {
                *to++ = n.place;
            }
            *to++ = i;
            counts[i] = index_of(to - found.data() - std::ptrdiff_t{i} * (most + 1));
        }
    });
    for (Index i = 0; i < count; ++i) {
        const auto from = found.begin() + (i * (most + 1));
        columns.index.insert(columns.index.end(), from, from + counts[i]);
        columns.begin.push_back(columns.index.size());
    }
    columns.value.resize(columns.index.size());
}

// Copies the values of column i from the factor so far if its points and weights are unchanged.
// places[i] is the place that column i had.
bool MaximinFactor::keep_column(Columns& columns, Index i, std::span<const Index> places) const {
    const Index old = places[i];
    if (old == kNoIndex) return false;
    const std::size_t from = columns_.begin[old], begin = columns.begin[i];
    const std::size_t size = columns.begin[i + 1] - begin;
    if (columns_.begin[old + 1] - from != size) return false;
    for (std::size_t k = 0; k < size; ++k) {
        if (places[columns.index[begin + k]] != columns_.index[from + k]) return false;
    }
    std::copy_n(columns_.value.begin() + from, size, columns.value.begin() + begin);
    return true;
}

// The place in the factor so far of each column with the same point and weight, or kNoIndex.
std::vector<Index> MaximinFactor::former_places(const Columns& columns) const {
    std::unordered_map<Index, Index> place_of_point;
    for (std::size_t i = 0; i < columns_.point.size(); ++i) {
        place_of_point.emplace(columns_.point[i], index_of(i));
    }
    std::vector<Index> places(columns.point.size(), kNoIndex);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto former = place_of_point.find(columns.point[i]);
        if (former != place_of_point.end() &&
            columns_.weight[former->second] == columns.weight[i]) {
            places[i] = former->second;
        }
    }
    return places;
}

// The covariances among the points of column i, a lower triangle; returns their count.
Index MaximinFactor::fill_block(const GridGreen& green, const Columns& columns, Index i,
                                std::vector<GridPoint>& points, double* block) {
    const std::size_t first = columns.begin[i];
    const auto size = index_of(columns.begin[i + 1] - first);
    points.clear();
    for (Index k = 0; k < size; ++k) {
        points.push_back(green.size().point(columns.point[columns.index[first + k]]));
    }
    for (Index j = 0; j < size; ++j) {
        double* column = block + std::ptrdiff_t{j} * size;
        for (Index k = j; k < size; ++k) {
            column[k] = green.entry(points[k], points[j]) + green.shift();
        }
        const double weight = columns.weight[columns.index[first + j]];
        column[j] += 1.0 / (weight * weight);
    }
    return size;
}

void MaximinFactor::fill_values(const GridGreen& green, Columns& columns,
                                const Context& context) const {
    const std::vector<Index> places = former_places(columns);
    const DenseKernels kernels = dense_kernels(best_processor());
    std::vector<Index> failures(columns.point.size(), kNoIndex);
    context.parallel_for(0, count_of(columns.point), kColumnGrain, [&](Index begin, Index end) {
        const auto packed = unfilled<double[]>(kPackedSize);
        const auto block = unfilled<double[]>(kNeighbors * kNeighbors);
        std::vector<GridPoint> points;
        for (Index i = begin; i < end; ++i) {
            if (keep_column(columns, i, places)) continue;
            const Index size = fill_block(green, columns, i, points, block.get());
            if (kernels.eliminate({block.get(), size, 0, size, packed.get()}) != kNoIndex) {
                failures[i] = i;
                continue;
            }
            solve_last_unit(block.get(), size, columns.value.data() + columns.begin[i]);
        }
    });
    for (const Index failed : failures) {
        if (failed == kNoIndex) continue;
        throw Error(ErrorCode::not_positive_definite,
                    "the constraints of the grid cannot be told apart in double precision; use "
                    "weights that differ less",
                    {ElementKind::row, 1, {columns.row[failed]}});
    }
}

void MaximinFactor::update(const GridGreen& green, const ConstraintRows& rows,
                           const Context& context) {
    MemoryCharge charge = context.charge(bytes(rows.size()), "preconditioning the constraints");
    Columns next;
    fill_pattern(green.size(), rows, next, context);
    fill_values(green, next, context);
    columns_ = std::move(next);
    charge_ = std::move(charge);
}

void MaximinFactor::apply(std::span<const Vec3> from, std::span<Vec3> to) const {
    std::fill(to.begin(), to.end(), Vec3::Zero());
    for (std::size_t i = 0; i < columns_.point.size(); ++i) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = columns_.begin[i]; k < columns_.begin[i + 1]; ++k) {
            sum += columns_.value[k] * from[columns_.row[columns_.index[k]]];
        }
        for (std::size_t k = columns_.begin[i]; k < columns_.begin[i + 1]; ++k) {
            to[columns_.row[columns_.index[k]]] += columns_.value[k] * sum;
        }
    }
}

}  // namespace lissom
