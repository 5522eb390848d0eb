/// The weights that constraints of a grid may have.
#pragma once

namespace lissom {

/// Their squares and the inverses of these are far from the ends of double precision.
inline constexpr double kLeastConstraintWeight = 1e-6, kGreatestConstraintWeight = 1e9;

}  // namespace lissom
