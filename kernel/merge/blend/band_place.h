/// A place of a mesh between three of its vertices.
#pragma once

#include <array>

#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Three vertices, joined by a face or part of one, with weights that sum to 1.
struct BandPlace {
    Triangle vertices{kNoIndex, kNoIndex, kNoIndex};
    std::array<double, 3> weights{1.0, 0.0, 0.0};
};

}  // namespace lissom
