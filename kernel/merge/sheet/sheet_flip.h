/// Flips of edges in a sheet; private to kernel/merge.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/sheet/sheet_star.h"
#include "kernel/merge/sheet/sheet_triangles.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// The triangles on the left and right of an inner edge from a to c, and those after a flip.
struct SheetQuad {
    Index left = kNoIndex, right = kNoIndex, b = kNoIndex, d = kNoIndex;
    std::array<Triangle, 2> after{};
};

/// Returns nothing for an edge on the border.
std::optional<SheetQuad> quad_at(const SheetTriangles& sheet, Index a, Index c);

/// Puts the other diagonal in.
void turn_diagonal(SheetTriangles& sheet, const SheetQuad& quad);

/// Times at which each edge of a triangle was found to be no better flipped: by its two ends,
/// or by all four vertices. Such edges are not measured again until a triangle there has changed.
struct FlipMemory {
    std::vector<std::array<std::uint32_t, 3>> useless, refused;
    /// Limits that `refused` holds for.
    SheetLimits limits;
};

/// Flips edges between triangles if that makes the smallest angle greater, until none does. Returns
/// the number of flips. Errors: cancelled.
Index flip_edges(SheetTriangles& sheet, FlipMemory& memory, const SheetLimits& limits,
                 const Context& context);

}  // namespace lissom
