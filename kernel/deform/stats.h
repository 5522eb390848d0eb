/// Sizes and times of a preparation.
#pragma once

#include <cstddef>

#include "kernel/core/index.h"

namespace lissom {

/// Sizes and times of the last preparation. Times are in seconds, sizes in bytes.
struct DeformStats {
    Index region_vertices = 0, free_vertices = 0, constrained_vertices = 0, handles = 0;
    /// Degenerate vertices displaced, vertices inserted at corners of the boundary, zero-area
    /// faces.
    Index displaced_vertices = 0, inserted_vertices = 0, zero_area_faces = 0;
    /// Flat vertices with an unknown of their own beside them.
    Index extended_vertices = 0;
    /// Vertices that a refinement of coarse borders added.
    Index refined_vertices = 0;
    /// Vertices of the thinned surface (DeformOptions::level_vertices); 0 on one level.
    Index level_vertices = 0;
    std::size_t first_nonzeros = 0, second_nonzeros = 0, factor_bytes = 0;
    double assemble_seconds = 0, first_factor_seconds = 0, second_factor_seconds = 0;
    double basis_seconds = 0;
    /// Factorisations since construction: dragging adds none.
    Index factorizations = 0;
};

class Deformer;
DeformStats stats_of(const Deformer& deformer);

}  // namespace lissom
