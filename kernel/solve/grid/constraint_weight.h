/// The weights that constraints of a grid may have.
#pragma once

namespace lissom {

/// Their squares and the inverses of these are far from the ends of double precision.
inline constexpr double kMinConstraintWeight = 1e-6, kMaxConstraintWeight = 1e9;

}  // namespace lissom
