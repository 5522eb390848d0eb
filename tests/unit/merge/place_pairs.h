/// Pairs of parts of real models of which the right turn is known, for the guess of places.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom::test {

/// A part that was cut off, roughened and moved, and what it belongs to, which ends a little below.
struct PlacePair {
    std::string name;
    Mesh source, target;
    Path source_boundary, target_boundary;
    /// Rotates the source as it belongs.
    Mat3 right = Mat3::Identity();
};

/// Up to `limit` parts of one model that stand out from it: heads, limbs, horns. The plane through
/// the target lies a quarter of the boundary's radius deeper and is tilted by six degrees, so that
/// the boundaries are not the same line. Nothing if the model is absent.
std::vector<PlacePair> cut_pairs(const std::string& file, std::size_t limit);

/// Pairs of real_pairs, with the turn that their keys say.
std::vector<PlacePair> keyed_pairs();

/// Heads of models that stand upright and look along z, each with the bodies of three others; and
/// moved.
std::vector<PlacePair> head_pairs();

/// Whether a rotation is the right one but for 30 degrees.
bool is_right(const PlacePair& pair, const Mat3& rotation);

}  // namespace lissom::test
