/// Overlapping patches of thickness pairs; private to kernel/deform.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/volume/thickness.h"

namespace lissom {

/// The pairs of a patch with their shares in it. The shares of one pair in all patches add up to 1.
using PairPatch = std::vector<std::pair<Index, double>>;

/// Spreads at most `count` patches over the pairs, each around a seed: pairs whose vertices look
/// elsewhere belong to others, so that both sides of a thin part have patches of their own.
std::vector<PairPatch> spread_patches(std::span<const ThicknessPair> pairs,
                                      const WorkingPatch& work, Index count);

}  // namespace lissom
