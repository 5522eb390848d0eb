/// Correspondence of two boundary loops: keys that the user gives, and arc length between them
/// (thesis section 3.3.1).
#pragma once

#include <span>
#include <vector>

#include "kernel/merge/loop/keys.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"

namespace lissom {

/// Parameters of two loops that meet, each ascending cyclically.
struct ParameterPair {
    double source = 0.0, target = 0.0;
};

/// The parameters of keys, sorted along the target's loop. Both loops run the same way around the
/// seam.
/// Errors, naming the keys by number (from 1) and the vertices: key_conflict for a vertex off the
/// loop, for a point farther from it than a tenth of its length, for two keys at one place, and for
/// three or more keys whose cyclic order differs between the loops.
std::vector<ParameterPair> key_parameters(const Loop& source, const Loop& target,
                                          std::span<const KeyPair> keys);

/// Returns the pair of loops with places by arc length between `keys`; there must be at least
/// one. With `snap` a vertex of the source that comes closer to one of the target than .3 of the
/// smaller spacing there meets it; without, only if the two coincide but for rounding.
LoopPair corresponding(const Loop& source, const Loop& target, std::span<const ParameterPair> keys,
                       bool snap = true);

}  // namespace lissom
