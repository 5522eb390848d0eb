/// Roots: starting points of strands on a scalp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

enum class RootPattern {
    /// Evenly spread: no two of the first n roots are nearer than 0.6 sqrt(a / n) on an open scalp
    /// of area a, weighted with the density over the largest; a little nearer if less room is left.
    poisson,
    /// The cells of a grid of polar angles around the center of the frame, each with a root at a
    /// random place (thesis, section 4.6). Roots are dense at the crown.
    angles,
    /// In equal steps of both polar angles, each moved at random by up to a quarter of a step, as
    /// in section 4.6 of the thesis: the step follows from the count, and the few roots too many
    /// that it gives are left out at random. The first n of a larger count are spread alike, but
    /// are not those of count n.
    steps,
};

struct RootOptions {
    /// 0 to kMaximumRoots.
    Index count = 100000;
    std::uint64_t seed = 1;
    RootPattern pattern = RootPattern::poisson;
    /// Relative density for every vertex of the head, finite and not negative; even if absent.
    /// Multiplied by the thinning at the hairline. Only ratios count.
    std::vector<double> density = {};
    /// Multiply the density; those of lengths have no effect.
    std::vector<MaskStroke> masks = {};

    bool operator==(const RootOptions&) const = default;
};

inline constexpr Index kMaximumRoots = 10'000'000;

struct Root {
    /// Face of the head, and the vertices of its triangle that contains the root.
    Index face = kNoIndex;
    Triangle triangle{kNoIndex, kNoIndex, kNoIndex};
    Vec3 barycentric = Vec3::Zero();
    Vec3 position = Vec3::Zero();
    /// Outward unit normal, interpolated from those of the vertices.
    Vec3 normal = Vec3::Zero();
};

/// Returns roots, the first n spread as evenly as all: with one seed the first n of a larger count
/// are those of count n, except in RootPattern::steps. Threads do not matter. Throws darts at the
/// scalp with a radius that shrinks as roots are added (McCool and Fiume 1992), and grows with
/// lower density. Time is about linear in the count. `head` must be the mesh that
/// `scalp` was made for. Errors: out_of_range for a count; invalid_argument for a density of the
/// wrong size; not_finite; region_empty if the density is 0 on the whole scalp; topology_mismatch;
/// memory_limit; cancelled.
std::vector<Root> make_roots(const Mesh& head, const Scalp& scalp, const RootOptions& options = {},
                             const Context& context = {});

/// Probability that hair grows at a root with the interpolated `margin` (Scalp::margins).
double hairline_thinning(double margin);

}  // namespace lissom
