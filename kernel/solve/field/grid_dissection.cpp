#include "kernel/solve/field/grid_dissection.h"

#include <array>

namespace lissom {
namespace {

// Planes that part two halves, and the points below which parting gains nothing.
constexpr Index kSeparator = 2;
constexpr Index kMinPoints = 64;

struct Part {
    std::array<Index, 3> begin, end;

    Index length(int axis) const { return end[axis] - begin[axis]; }
    Index count() const { return length(0) * length(1) * length(2); }
    int longest() const {
        int axis = 0;
        for (int a = 1; a < 3; ++a) axis = length(a) > length(axis) ? a : axis;
        return axis;
    }
};

void list(const GridSize& size, const Part& part, std::vector<Index>& order) {
    for (Index z = part.begin[2]; z < part.end[2]; ++z) {
        for (Index y = part.begin[1]; y < part.end[1]; ++y) {
            for (Index x = part.begin[0]; x < part.end[0]; ++x) {
                order.push_back(size.index({x, y, z}));
            }
        }
    }
}

void dissect(const GridSize& size, const Part& part, std::vector<Index>& order) {
    const int axis = part.longest();
    if (part.count() <= kMinPoints || part.length(axis) <= 2 * kSeparator) {
        list(size, part, order);
        return;
    }
    Part low = part, middle = part, high = part;
    low.end[axis] = middle.begin[axis] = part.begin[axis] + (part.length(axis) - kSeparator) / 2;
    middle.end[axis] = high.begin[axis] = middle.begin[axis] + kSeparator;
    dissect(size, low, order);
    dissect(size, high, order);
    list(size, middle, order);
}

}  // namespace

std::vector<Index> dissect_grid(const GridSize& size) {
    std::vector<Index> order;
    order.reserve(size.count());
    dissect(size, {{0, 0, 0}, {size.nx, size.ny, size.nz}}, order);
    return order;
}

}  // namespace lissom
