/// Keys: points of two boundaries, or directions of two meshes, that the user lets meet.
#pragma once

#include <variant>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

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

}  // namespace lissom
