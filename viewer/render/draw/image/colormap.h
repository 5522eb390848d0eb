/// A colour scale for numbers on a surface: perceptually even, readable in grey and by the
/// colour-blind (viridis, after van der Walt and Smith, 2015).
#pragma once

#include "viewer/render/draw/image/color.h"

namespace lissom {

/// Returns the colour of `t`, from 0 (dark violet) over green to 1 (yellow); values outside are
/// clamped.
Color colormap(double t);

/// Colour of surface without a number.
inline constexpr Color kNoValueColor{0.62, 0.62, 0.62};

}  // namespace lissom
