/// Regions, handles and values to show on the meshes of a picture, given by scripts and the command
/// line by name or as objects.
#pragma once

#include <string_view>
#include <vector>

#include "viewer/render/picture.h"

namespace lissom {

/// Gives a mesh a colour, as parse_color reads it, and with "#rrggbbaa" or "#rgba" an opacity.
/// Errors: as parse_color.
void paint_mesh(MeshStyle& style, std::string_view color);

/// Draws a region in blue, or a handle in purple, on every mesh that has it: by name, the meshes
/// with a region of that name; as an object, the meshes with its topology. Errors: out_of_range if
/// no mesh has the name; topology_mismatch if no mesh has the topology.
void paint_region(Picture& picture, std::string_view name);
void paint_region(Picture& picture, const Region& region);
/// Throws out_of_range if no mesh has a region of this name.
void require_region(const Picture& picture, std::string_view name);
void paint_handle(Picture& picture, std::string_view name);
void paint_handle(Picture& picture, const Region& handle);

/// Draws an attribute of vertices, one number each, on every mesh that has it; its name stands
/// above the colour scale. Errors: out_of_range if no mesh has it; invalid_argument for other
/// attributes.
void paint_values(Picture& picture, std::string_view attribute);
/// Draws numbers on every mesh with as many vertices. Errors: invalid_argument if there is none.
void paint_values(Picture& picture, const std::vector<double>& values);

}  // namespace lissom
