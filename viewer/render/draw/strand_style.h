/// Appearance of strands. Plain data.
#pragma once

#include <optional>

#include "kernel/core/geometry.h"
#include "viewer/render/draw/image/color.h"

namespace lissom {

/// A brown that is neither dark nor blond.
inline constexpr Color kHairColor{0.547, 0.425, 0.304};

/// One of the two reflections of a strand (Kajiya and Kay 1989; Marschner et al. 2003).
struct HairLobe {
    /// Part of the light that it reflects at its brightest; at least 0.
    double strength = 0.0;
    /// Sharpness: the power of the cosine; at least 0.
    double exponent = 0.0;
    /// Radians by which the reflection leans towards the tip (positive) or the root.
    double shift = 0.0;

    bool operator==(const HairLobe&) const = default;
};

struct StrandStyle {
    /// Replaces the strands' own colours; without either, `kHairColor`.
    std::optional<Color> color = std::nullopt;
    /// Part of the strands that is drawn, the first of them, above 0 and at most 1; the fewer, the
    /// wider each, so that they cover as much.
    double level = 1.0;
    /// The same as a number of strands, instead of `level`.
    std::optional<Index> count = std::nullopt;
    /// Metres in one unit of the picture's world; strands are in metres. Positive.
    double unit = 1.0;

    /// White, from the surface of the strand, and coloured, from inside it. As wide as on real
    /// hair, with a roughness of 6 and 9 degrees (Marschner et al. 2003: 5 to 10, and 1.5 to 2
    /// times as much): narrower ones break up into specks where strands lie across.
    HairLobe primary{0.14, 26.0, 0.10};
    HairLobe secondary{0.42, 10.0, -0.15};
    /// Radians by which both lean more or less, from strand to strand.
    double shift_jitter = 0.05;

    /// Random variation of brightness of strands, and of clumps of them; 0 to 1.
    double strand_tone = 0.12;
    double clump_tone = 0.1;
    /// Size of a clump on the scalp in metres; positive.
    double clump_size = 0.005;
    /// Factors of the colour at the root and at the tip; at least 0.
    double root_tone = 0.72;
    double tip_tone = 1.18;

    /// Strength of the shadows of strands on each other and the meshes: 0 is none, 1 looks like
    /// hair.
    double shadow = 1.0;
    /// Blend of the scalp with the colour of the hair at dense roots; 0 to 1.
    double scalp_tint = 0.7;

    bool operator==(const StrandStyle&) const = default;
};

}  // namespace lissom
