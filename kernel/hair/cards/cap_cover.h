/// The part of the skin that roots of hair cover; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the density of roots around each vertex of a head, as a part of that around most
/// vertices within the hair: 1 at most, and about a half at the edge of hair of even density.
/// `unit`: metres in one unit of the head. Roots count within 9 mm, or farther in sparse hair.
std::vector<double> cover_of_roots(const Strands& strands, const Mesh& head, double unit,
                                   const Context& context = {});

}  // namespace lissom
