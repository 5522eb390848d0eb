/// CurveFit: two boundary loops that are one curve, as they lie or up to a similarity; private to
/// kernel/merge.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The similarity that lays the source's loop onto the target's.
struct CurveFit {
    SimilarityMap map = {};
    /// True for loops that coincide as they lie: no point moves, to the bit.
    bool stays = true;
    /// Vertices of both loops that lie at one place of the curve, and the places of the others.
    LoopPair pair = {};

    Vec3 operator()(const Vec3& p) const { return stays ? p : map(p); }
};

/// Finds whether two loops that run the same way coincide as they lie: each vertex of one lies on
/// the other, within 1e-5 of the length, and arc length agrees.
std::optional<CurveFit> fit_in_place(const Loop& source, const Loop& target);

/// Finds similarities that make two loops coincide within 1e-5 of the target's length, `most` of
/// them at most. They are counted from the target's first vertex.
std::vector<CurveFit> curve_fits(const Loop& source, const Loop& target, std::size_t most);

/// Returns the similarity of `curve_fits` under which `key` is met best; nothing if it is missed by
/// more than .02 of the loop or, if there are several, by more than a tenth of the spacing.
std::optional<CurveFit> fit_near(const Loop& source, const Loop& target, const ParameterPair& key);

/// Whether keys meet under a fit, within .02 of the loop.
bool meets(const CurveFit& fit, const Loop& source, const Loop& target,
           std::span<const ParameterPair> keys);

/// Measures the angle in radians by which the surface turns from the target's face to the source's
/// along the loops once the source is laid on; the median of all vertices. Loops are of the meshes.
double median_turn(const CurveFit& fit, const Mesh& source, const Mesh& target);

}  // namespace lissom
