#include "kernel/hair/field/grid_layout.h"

#include <cmath>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// The least even number of points, at least four, that spans `length` in steps of `step`.
double even_count(double length, double step) {
    return std::max(4.0, 2.0 * std::ceil(0.5 * (length / step + 1.0)));
}

double point_count(const Vec3& size, double step) {
    return even_count(size.x(), step) * even_count(size.y(), step) * even_count(size.z(), step);
}

void require_grid(const Box& box, Index resolution) {
    if (!box.min.allFinite() || !box.max.allFinite()) {
        throw Error(ErrorCode::not_finite, "the box of the grid is NaN or infinite");
    }
    if (!((box.max - box.min).minCoeff() > 0.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "the box of the grid must have an extent along x, y and z");
    }
    if (resolution < kMinimumResolution || resolution > kMaximumResolution) {
        throw Error(ErrorCode::invalid_argument,
                    "the resolution must be " + std::to_string(kMinimumResolution) + " to " +
                        std::to_string(kMaximumResolution) + " grid points, not " +
                        std::to_string(resolution));
    }
}

}  // namespace

Box GridLayout::box() const {
    return {origin, point(counts[0] - 1, counts[1] - 1, counts[2] - 1)};
}

GridLayout fit_grid(const Box& box, Index resolution) {
    require_grid(box, resolution);
    const Vec3 size = box.max - box.min;
    double fine = size.maxCoeff() / resolution, coarse = size.maxCoeff();
    for (int i = 0; i < 200 && fine < coarse * (1.0 - 1e-12); ++i) {
        const double middle = std::sqrt(fine * coarse);
        (point_count(size, middle) > resolution ? fine : coarse) = middle;
    }
    GridLayout grid;
    grid.step = coarse;
    for (int axis = 0; axis < 3; ++axis) {
        grid.counts[axis] = static_cast<Index>(even_count(size[axis], coarse));
        grid.origin[axis] = box.center()[axis] - 0.5 * coarse * (grid.counts[axis] - 1);
    }
    return grid;
}

}  // namespace lissom
