/// Mirror images of constraints; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/options.h"

namespace lissom {

/// Returns the reflection in a plane. Errors: invalid_argument if its normal has no direction.
Affine reflection(const MirrorPlane& plane);

/// For each of `vertices` the one of `candidates` that lies nearest to its mirror image, no farther
/// than `tolerance`, or kNoIndex; none is taken twice.
std::vector<Index> counterparts(std::span<const Vec3> positions, std::span<const Index> vertices,
                                std::span<const Index> candidates, const Affine& mirror,
                                double tolerance);

}  // namespace lissom
