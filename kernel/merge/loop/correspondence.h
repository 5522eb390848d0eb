/// Correspondence of two boundary loops: keys that the user gives, and arc length between them
/// (thesis section 3.3.1).
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"

namespace lissom {

/// A key: a vertex of a boundary, or a point on or near it.
using Key = std::variant<Index, Vec3>;

/// Two keys that meet.
struct KeyPair {
    Key source, target;
};

/// Directions of the source and of the target that are to lie the same way, as the fronts of a head
/// and of a body; of any length above 0.
struct DirectionPair {
    Vec3 source = Vec3::Zero(), target = Vec3::Zero();
};

/// A correspondence that was guessed with less certainty than this is a toss; see JoinReport.
inline constexpr double kCertain = 0.75;

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

/// Returns the pair of loops with places by arc length between `keys`, of which there is at least
/// one. With `snap` a vertex of the source that comes closer to one of the target than .3 of the
/// smaller spacing there meets it; without, only if the two coincide but for rounding.
LoopPair corresponding(const Loop& source, const Loop& target, std::span<const ParameterPair> keys,
                       bool snap = true);

}  // namespace lissom
