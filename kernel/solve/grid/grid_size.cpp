#include "kernel/solve/grid/grid_size.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// The bytes of larger grids overflow addresses of 32 bits.
constexpr Index kMaxPoints =
    sizeof(std::size_t) < sizeof(std::int64_t) ? kMaxGridPoints / 16 : kMaxGridPoints;

}  // namespace

void require_valid(const GridSize& size) {
    const std::string name = "a grid of " + std::to_string(size.nx) + " x " +
                             std::to_string(size.ny) + " x " + std::to_string(size.nz) + " points ";
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] < 1 || size[axis] > kLongestAxis) {
            throw Error(ErrorCode::invalid_argument, name +
                                                         "cannot be made; each axis needs 1 to " +
                                                         std::to_string(kLongestAxis) + " points");
        }
    }
    if (std::int64_t{size.nx} * size.ny * size.nz > kMaxPoints) {
        throw Error(ErrorCode::invalid_argument,
                    name + "is too large; use at most " + std::to_string(kMaxPoints));
    }
}

}  // namespace lissom
