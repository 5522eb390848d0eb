/// SupportSurface: a surface through a curve on which strokes about the curve are drawn (thesis,
/// section 4.5, Figure 4.3 a and b).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/sketch/camera.h"

namespace lissom {

enum class SupportMode {
    /// The lines of sight from the viewpoint through the curve: an edit on it, seen from aside,
    /// keeps how the curve looks from the viewpoint and changes its depth.
    ruled,
    /// Lines across the curve that are orthogonal to the triangle of a segment and the viewpoint:
    /// an edit on it keeps the depth and changes how the curve looks.
    strip
};

/// Lengths in world units.
struct SupportOptions {
    SupportMode mode = SupportMode::strip;
    /// Width to each side of the curve. A strip is narrower if the curve bends more tightly, so
    /// that it does not fold.
    double width = 0.03;
    /// Length of its straight extension beyond the last point.
    double extension = 0.035;
    /// Length of the end of the curve, whose mean direction the extension has.
    double end = 0.015;
};

class SupportSurface {
  public:
    /// A line of the surface, from `center - reach * direction` to `center + reach * direction`.
    struct Ruling {
        Vec3 center = Vec3::Zero(), direction = Vec3::Zero();
        double reach = 0.0;
        /// Arc length from the first point of the curve to the center.
        double along = 0.0;
    };
    /// Hit of a ray on the surface.
    struct Hit {
        Vec3 position = Vec3::Zero();
        /// Distance from the ray's origin.
        double distance = 0.0;
        /// Arc length along the curve, beyond `length()` on the extension, and the way from the
        /// curve along the ruling.
        double along = 0.0, across = 0.0;
    };

    /// Builds the surface of a curve, points in the world, as seen from the viewpoint of `camera`;
    /// one without perspective has its viewpoint far away. Points equal to the one before are left
    /// out. Errors: not_finite; invalid_argument if fewer than two points differ, one of them is at
    /// the viewpoint, or a length is negative or the width 0.
    SupportSurface(std::span<const Vec3> curve, const Camera& camera, const SupportOptions& = {});

    SupportMode mode() const { return mode_; }
    /// Returns the rulings, one a point of the curve, then those of the extension.
    std::span<const Ruling> rulings() const { return rulings_; }
    /// Returns the length of the curve.
    double length() const { return length_; }
    /// Returns the fraction of the curve's length, 0 to 1, that is less than 15 degrees from the
    /// line of sight of the viewpoint: there a surface says little of the curve.
    double end_on() const { return end_on_; }
    /// Returns how squarely a camera sees the surface: the mean over the curve of the cosine
    /// between its normal and the line of sight, 0 for edge-on to 1. Strokes need about 0.3.
    double seen_from(const Camera& camera) const;
    /// Returns the hits of a ray, nearest to its origin first.
    std::vector<Hit> hits(const Ray& ray) const;
    /// Returns a mesh: two vertices a ruling, two triangles between rulings.
    Mesh mesh(const Context& context = {}) const;

  private:
    void add_hits(std::size_t first, const Ray& ray, std::vector<Hit>& hits) const;

    SupportMode mode_ = SupportMode::strip;
    std::vector<Ruling> rulings_;
    // Unit tangents at the rulings.
    std::vector<Vec3> tangents_;
    double length_ = 0.0, end_on_ = 0.0;
};

}  // namespace lissom
