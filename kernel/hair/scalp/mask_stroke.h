/// Masks of a scalp as the strokes that painted them: factors of length and density.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

enum class MaskKind {
    length,   ///< factors of the length of hair
    density,  ///< relative density of roots
};

/// Stroke of a round brush. Lengths and points are in metres of the scalp's frame, so that a mask
/// fits any head.
struct MaskStroke {
    MaskKind kind = MaskKind::length;
    /// Path of the brush over the head; one point is a dab.
    std::vector<Vec3> points;
    /// Painted value: 0 to kMaxLengthMask, for a density to 1. 1 erases.
    double value = 0.5;
    /// Radius of the brush, above 0.
    double radius = 0.02;
    /// The share of the radius, at its rim, over which the brush fades; 0 to 1.
    double softness = 0.5;

    bool operator==(const MaskStroke&) const = default;
};

inline constexpr double kMaxLengthMask = 4.0;

/// Errors: not_finite, naming the point; invalid_argument without points, or for options out of
/// range.
void require_mask(const MaskStroke& stroke);

/// The strokes of one kind as a function on the head.
class ScalpMask {
  public:
    /// Takes the strokes of `kind`, in their order.
    ScalpMask(std::span<const MaskStroke> strokes, MaskKind kind);

    bool is_empty() const { return layers_.empty(); }
    /// Returns the mask at a point: 1 without strokes; each stroke moves the value before it
    /// towards its own. Does not depend on the vertices of the head.
    double at(const Vec3& point) const;

  private:
    struct Layer {
        Box reach;
        MaskStroke stroke;
    };
    std::vector<Layer> layers_;
};

}  // namespace lissom
