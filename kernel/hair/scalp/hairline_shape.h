/// Changes of a hairline by the words of a hairdresser: forehead, recession, widow's peak,
/// sideburns, nape; and hairlines that are drawn on a head. A hairline with negative azimuths has
/// sides that differ; its points ascend within [-pi, pi]. One that is not the default counts before
/// the region "scalp" of a mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/shapes/hairline.h"

namespace lissom {

/// Metres of an average head; 0 leaves the hairline as it is. Within kMaxHairlineChange.
struct HairlineShape {
    /// Height that the line over the forehead rises; negative lowers it.
    double forehead = 0.0;
    /// Depth of the bays beside the middle of the forehead; negative fills them.
    double recession = 0.0;
    /// Depth of a widow's peak, which points down in the middle of the forehead.
    double peak = 0.0;
    /// Length added to the hair in front of the ears; negative shortens it.
    double sideburns = 0.0;
    /// Length added to the hair at the nape; negative raises the line.
    double nape = 0.0;
    /// Height by which the line wanders up and down as it goes around the head, differently on both
    /// sides; 0 or more.
    double irregular = 0.0;

    bool operator==(const HairlineShape&) const = default;
};

inline constexpr double kMaxHairlineChange = 0.1;

/// Returns a hairline changed by `shape`, in points 2 degrees apart. Errors: invalid_argument for
/// a number out of range, or a hairline that is none.
std::vector<HairlinePoint> shaped_hairline(const std::vector<HairlinePoint>& hairline,
                                           const HairlineShape& shape);

/// Returns a hairline that runs through a drawn line, points in metres of the scalp's frame, and
/// beyond its ends over 10 degrees into `hairline`. A line that stays on one side of the head
/// counts for both; one that crosses the middle in front or behind counts as drawn. Errors:
/// not_finite; invalid_argument for fewer than two azimuths.
std::vector<HairlinePoint> drawn_hairline(const std::vector<HairlinePoint>& hairline,
                                          std::span<const Vec3> line);

}  // namespace lissom
