/// Strands that are cut and go on along another way; private to kernel/hair.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// A strand, and its last point that is kept.
struct CutStrand {
    Index strand, last;
};

/// Calls tail(i, points) on several threads for the points that follow each end; other strands
/// stay. Errors: not_finite naming strands that would exceed 32-bit numbers; memory_limit;
/// cancelled. After one the strands are as they were.
void carry_on(Strands& strands, const std::vector<CutStrand>& ends,
              const std::function<void(std::size_t i, std::vector<Vec3>& points)>& tail,
              const Context& context);

}  // namespace lissom
