/// Memory for the fields that a solve computes with; private to kernel/solve.
#pragma once

#include <cstddef>
#include <memory>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/core/numbers/bits.h"
#include "kernel/solve/grid/cosine_transform.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// Three fields over a grid, component by component; not initialised.
using FieldBuffer = std::unique_ptr<double[]>;

inline std::size_t field_entries(const GridSize& size) {
    return std::size_t{kComponents} * at(size.count());
}

inline FieldBuffer make_field(const GridSize& size) {
    return unfilled<double[]>(field_entries(size));
}

/// Two buffers that transforms write to, kept because fresh pages cost more than a transform.
struct FieldWorkspace {
    explicit FieldWorkspace(const GridSize& size)
        : first(make_field(size)), second(make_field(size)) {}
    FieldBuffer first, second;
};

/// Returns the vector of a field at `point`.
inline Vec3 vector_at(const double* field, const GridSize& size, Index point) {
    const auto count = at(size.count());
    return {field[point], field[count + at(point)], field[2 * count + at(point)]};
}

}  // namespace lissom
