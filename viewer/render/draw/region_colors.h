/// The named regions of meshes, each in a colour of its own, with the names for a legend.
#pragma once

#include <string>
#include <vector>

#include "viewer/render/draw/drawing.h"
#include "viewer/render/draw/legend.h"

namespace lissom {

/// Colours the regions of `names`, or all if that is empty. Regions of one name have one colour
/// on all meshes; small ones lie over large ones. Returns the names that meshes have, with their
/// colours.
std::vector<LegendPart> color_regions(std::vector<DrawnMesh>& meshes,
                                      const std::vector<std::string>& names = {});

}  // namespace lissom
