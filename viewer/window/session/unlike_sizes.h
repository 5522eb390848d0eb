/// unlike_sizes: a word about models that were made in different units.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viewer/render/draw/drawing.h"

namespace lissom::window {

/// Returns a warning if the largest of some meshes, called `names`, is so much larger than
/// the smallest that this is hardly seen beside it; "" if all can be seen. Vertices that are not
/// finite do not count.
std::string unlike_sizes(std::span<const DrawnMesh> meshes, std::span<const std::string> names);

}  // namespace lissom::window
