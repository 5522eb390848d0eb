/// Cutting strands to shapes, and removing strands.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Metres that a point is inside of a shape, negative outside; `point` counts over all strands.
/// Called on several threads.
using CutShape = std::function<double(const Vec3& place, Index point)>;

/// The side of a plane that its normal, of any length but 0, points away from.
CutShape inside_plane(const Vec3& point, const Vec3& normal);
/// An ellipsoid along the axes.
CutShape inside_ellipsoid(const Vec3& center, const Vec3& radii);

/// Height of a hem in a direction around the head: azimuth in radians, 0 at +z and positive towards
/// +x.
struct HemPlace {
    double azimuth, height;
};
/// Above a hem: y is at least the height, linear between the places in their order. If no azimuth
/// is negative, the hem of the other side is the same. Errors: invalid_argument without places.
CutShape above_hem(std::vector<HemPlace> places);

struct StrandCutOptions : StrandOperatorOptions {
    /// Strands are cut where they first leave it.
    CutShape inside;
    /// Maps the points of strands to those that `inside` is asked for; its scale maps metres.
    Affine frame = {};
    /// Each strand, and each guide with all its strands, meets the shape moved by up to this,
    /// either way, at random; in metres of the shape.
    double jitter = 0.0, guide_jitter = 0.0;
    /// No strand becomes shorter than this, in metres, unless it was; positive.
    double least = 0.001;
};

/// Cuts strands off where they leave a shape; a new last point lies on the old strand. The factor
/// and the mask are the part of the rest that is cut off. Strands with nothing to cut stay to the
/// bit. Errors: invalid_argument for options out of range or without a shape; memory_limit,
/// cancelled.
void cut(Strands& strands, const StrandCutOptions& options, const Context& context = {});

/// Removes the strands that are marked, and with `locks` all strands of their guides too. Errors:
/// invalid_argument if there is not one mark a strand.
void cull(Strands& strands, std::span<const char> marks, bool locks = false);

/// Marks strands at random: this part of them, 0 to 1, by their ids. Errors: invalid_argument.
std::vector<char> random_marks(const Strands& strands, double part, std::uint64_t seed);

}  // namespace lissom
