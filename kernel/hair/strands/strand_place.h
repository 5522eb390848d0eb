/// Placement of strands in the world of a mesh.
#pragma once

#include <optional>
#include <string>

#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Metres in one unit of `mesh`, from how far apart the roots of the strands are and the places on
/// the mesh that they say they are rooted at; nothing if they do not say, or the places are not on
/// this mesh.
std::optional<double> unit_of_roots(const Strands& strands, const Mesh& mesh);

/// Whether the places on `mesh` that the strands say they are rooted at are as far from each other
/// as their roots are, by one factor: the mesh they grew on, wherever both lie by now, but for
/// deformations by more than a tenth. True for fewer than three strands with such places.
bool may_be_rooted_on(const Strands& strands, const Mesh& mesh);

/// Returns the doubt that strands belong on a mesh whose unit is this many metres: they are twenty
/// times smaller or larger. Names the unit that would fit; empty if there is no doubt.
std::string doubt_about_unit(const Strands& strands, const Mesh& mesh, double unit);

}  // namespace lissom
