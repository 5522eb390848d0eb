/// Shapes as sums of fewer shapes, by principal components; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"

namespace lissom {

/// Limits of the error of a sum.
struct ShapeTolerance {
    /// Numbers of a shape that are positions, three each; the others are directions.
    std::size_t position_numbers = 0;
    /// Greatest distance of a position, in mesh units.
    double position = 0.0;
    /// Greatest distance of a direction.
    double direction = 0.02;
};

struct ShapeSums {
    /// Shapes to be added up, each as long as those given.
    std::vector<std::vector<float>> parts;
    /// For each shape given, the weight of each part, at most 1 in size.
    std::vector<std::vector<float>> weights;
    /// Greatest distance of a position, and of a direction, from the shapes given.
    double max_error = 0.0, max_direction_error = 0.0;
};

/// Returns the fewest principal components by halving whose sums keep the tolerance. All shapes
/// have the same length, a multiple of 3. Errors: memory_limit; cancelled.
ShapeSums sum_shapes(const std::vector<std::vector<float>>& shapes, const ShapeTolerance& tolerance,
                     const Context& context = {});

}  // namespace lissom
