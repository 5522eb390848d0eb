/// Options and reports of a paste.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/parameterize/parameterize.h"

namespace lissom {

/// Place of a part on its target.
struct PastePlacement {
    /// The middle of the feature comes to lie on the point of the target that is nearest to this.
    Vec3 at = Vec3::Zero();
    /// The way on the target that the source's `up` is to point; of any length. Without it `up`
    /// points the same way as on the source, as far as it lies in the surface.
    std::optional<Vec3> toward = std::nullopt;
    /// Direction of the source that `toward` is for.
    Vec3 up = Vec3::UnitY();
    /// Turns the part about the surface's normal, counter-clockwise seen from outside, in radians
    /// from `toward`. Without either it is 0, or, if `up` does not lie in one of the surfaces (it
    /// is within 17 degrees of their normal), the one that fits best, of twelve.
    std::optional<double> angle = std::nullopt;
    /// Size of the part on the target, over its size on the source; above 0.
    double scale = 1.0;
    /// Moves the part in the plane of the target's map, in lengths of the target (the thesis's way
    /// of placing).
    Vec2 offset = Vec2::Zero();
};

/// Quality of the map of a piece of surface into the plane; see Parameterization. If a map that
/// keeps lengths would turn faces over, one onto a disk is taken, which does not.
struct MapQuality {
    Index faces = 0, flipped = 0, flipped_fill = 0, crossings = 0;
    double min_scale = 1.0, max_scale = 1.0;
    ParameterizeMethod method = ParameterizeMethod::arap;
};

enum class PasteStop { converged, iterations, cycle };

/// Result of the search for the boundary. Energies are of the arcs of one loop.
struct PasteSearch {
    /// After each iteration; the first is of the loop that was started from.
    std::vector<double> energy;
    /// Mean misfit of the loop's edges: |sqrt(s) R e - e* / sqrt(s)| over sqrt(s) |e|; no unit.
    std::vector<double> misfit;
    /// Measures of the outline of the marked region, if all of it lies on the target's region.
    std::optional<double> outline_energy, outline_misfit;
    PasteStop stop = PasteStop::converged;
    /// The outline of the region was kept, since nothing better was found.
    bool kept_outline = false;
    /// Measures of the boundary free of edges, if one was found that costs no more than the loop.
    std::optional<double> smooth_energy, smooth_misfit;
    /// Scale of the similarity from the boundary to its image.
    double scale = 1.0;
    Index loop_size = 0;
    /// Rounds of nearest points that were kept.
    Index closest_rounds = 0;
};

/// Features of a target that are removed under a part before it is pasted.
struct PasteClearing {
    /// Their number and their area, of the target as it is split there.
    Index faces = 0;
    double area = 0.0;
    /// Their greatest height over the surface that takes their place, or depth in it.
    double height = 0.0;
};

/// Distortion of the part; see PasteReport.
struct PasteDistortion {
    /// 95th percentile over faces of the ratio of the singular values of the face's map.
    double anisotropy = 1.0;
    /// Mean by area of (s1 / s - 1)^2 + (s2 / s - 1)^2, s1 and s2 the singular values and s the
    /// scale of the part.
    double energy = 0.0;
    Index faces = 0;
};

}  // namespace lissom
