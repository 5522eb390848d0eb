/// The line below which no hair grows on a head, as elevations around it.
#pragma once

#include <vector>

namespace lissom {

/// A point of the hairline, as seen from the middle of the head: hair grows above `elevation` at
/// the azimuths `azimuth` (0 in front, pi at the back) and -azimuth. Radians.
struct HairlinePoint {
    double azimuth = 0.0, elevation = 0.0;
};

/// Returns the hairline of an adult without receding hair: across the forehead, down in front of
/// the ears, around and below them, and to the nape.
std::vector<HairlinePoint> default_hairline();

/// Elevation of a hairline at an azimuth of any sign; smooth between the points, whose azimuths
/// ascend within [0, pi].
double hairline_elevation(const std::vector<HairlinePoint>& hairline, double azimuth);

}  // namespace lissom
