/// Smoothing of a seam; private to kernel/merge.
#pragma once

#include <unordered_map>

#include "kernel/merge/sew/seam_patch.h"

namespace lissom {

/// Moves the vertices of the patch's seams and, half as far, those next to them by the umbrella
/// operator (Kobbelt et al. 1998): half of the way to the mean of their neighbours, `times` times.
/// Vertices on open boundaries stay.
void smooth_seams(SeamPatch& patch, Index times);

}  // namespace lissom
