/// Remeshing of a sheet to wanted lengths of edges; private to kernel/merge.
#pragma once

#include <functional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/merge/sheet/sheet_flip.h"
#include "kernel/merge/sheet/sheet_rest.h"
#include "kernel/merge/sheet/sheet_star.h"
#include "kernel/merge/sheet/sheet_triangles.h"

namespace lissom {

/// The edge length wanted at a point.
using SheetSize = std::function<double(const Vec3&)>;

/// Makes edges as long as `size` wants, in rounds of splits, collapses, flips and moves on the
/// surface of `rest` (Botsch and Kobbelt 2004, with the sizes of Dunyach et al. 2013). Flips obey
/// `flips`, all else `limits`. Errors: cancelled.
void remesh(SheetTriangles& sheet, const SheetRest& rest, FlipMemory& memory, const SheetSize& size,
            const SheetLimits& limits, const SheetLimits& flips, const Context& context);

}  // namespace lissom
