/// Variation of strands: tones at random, and widths.
#pragma once

#include <vector>

#include "viewer/render/strands/view_strands.h"

namespace lissom {

struct StrandLook {
    /// Factor of the colour.
    float tone = 1.0f;
    /// Radians by which its reflections lean more.
    float shift = 0.0f;
};

/// Returns the look of a strand, at random by its id and its clump, independent of other strands.
StrandLook look_of(const ViewStrands& drawn, Index strand);

/// Returns the factor of the colour along a strand, dark at the root and light at the tip; `t` 0 to
/// 1.
float tone_along(const StrandStyle& style, float t);

/// Returns widths of a strand's points in view units, as far as they cover: less if they are
/// transparent.
void cover_widths(const ViewStrands& drawn, Index strand, std::vector<float>& widths);

}  // namespace lissom
