/// Tips and pits of the surface beside a seam; private to kernel/merge.
#pragma once

#include <span>

#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the sharpness of the sharpest tip or pit near a seam of that radius: the greatest sum,
/// over the vertices within .15 radii of one, of the angles missing to a full turn around them, in
/// radians. A plane, a cylinder and a straight crease have none, the corner of a cube a quarter
/// turn, a needle a full one. `distance` is that of every vertex from the seam; vertices within
/// half a radius count, those of open boundaries do not.
double band_spike(const Mesh& mesh, std::span<const double> distance, double radius);

}  // namespace lissom
