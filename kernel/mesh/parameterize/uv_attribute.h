/// A map into the plane as texture coordinates.
#pragma once

#include <string_view>

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/parameterize/parameterize.h"

namespace lissom {

/// Placement of a map: scaled into the square from 0 to 1, centered and filled by the longer side,
/// or as it is, in lengths of the mesh.
enum class UvPlacement { unit_square, as_is };

/// Writes a map to the corners of its faces, as the attribute `name` of width 2, which is made if
/// there is none. Other corners keep their values, or have none (NaN); an attribute of the vertices
/// becomes one of the corners, since the map may have a seam around it. Errors: invalid_argument if
/// `name` is empty or that of an attribute of another width or of faces; topology_mismatch if the
/// mesh does not have the faces of the map. Nothing is changed then.
void write_uv(Mesh& mesh, const Parameterization& map, std::string_view name = "uv",
              UvPlacement placement = UvPlacement::unit_square);

}  // namespace lissom
