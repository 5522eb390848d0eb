/// Parts that fit: boundaries that are one curve, with surfaces that go on across it; private to
/// kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/curve_fit.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The two sides of one join: loops of the meshes that run the same way.
struct FitSides {
    const Mesh& source;
    const Mesh& target;
    const Loop& source_loop;
    const Loop& target_loop;
};

/// Finds the fit of the parts of a join: as they lie, if the surface turns by less than 105 degrees
/// across the seam in the median; in the free configuration also under a similarity, if it turns by
/// less than 15 degrees. On a bent surface only the turn beyond its own bend counts. Returns
/// nothing if they do not fit, or not with `keys`; without keys only as they lie.
std::optional<CurveFit> part_fit(const FitSides& sides, std::span<const ParameterPair> keys,
                                 Configuration configuration);

/// The similarity of parts that fit under one alone, wherever it turns the source.
std::optional<CurveFit> only_part_fit(const FitSides& sides);

/// The same for parts that meet about at `key`.
std::optional<CurveFit> part_fit_near(const FitSides& sides, const ParameterPair& key);

/// Whether parts fit in one way at least, wherever keys may be.
bool parts_may_fit(const FitSides& sides, Configuration configuration);

/// Returns the fit that all joins share; nothing if one has none, or another.
std::optional<CurveFit> common_fit(std::span<const std::optional<CurveFit>> fits,
                                   std::span<const Loop> sources, std::span<const Loop> targets);

/// Whether source and target lie on the same side of their boundaries: the surface that goes into
/// the source goes back into the target, by the mean along the loops.
bool on_same_side(const Loop& source, const Loop& target, const LoopPair& pair);

}  // namespace lissom
