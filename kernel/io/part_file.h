/// Part files: features to paste, as a library of parts keeps them. A part is a .glb or .gltf file
/// like others, with the part standing upright (its `up` along y, its `front` along z), with the
/// regions "region", the surroundings of the feature, and perhaps "feature", the feature itself.
/// Any such file is a part, from any program.
#pragma once

#include <filesystem>
#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// A feature with the data for pasting it.
struct Part {
    Mesh mesh;
    Region region;
    /// Absent: the deep part of the region.
    std::optional<Region> feature;
};

/// Directions of a part, in the space of its mesh.
struct PartFrame {
    Vec3 up = Vec3::UnitY(), front = Vec3::UnitZ();
};

/// Writes the surface of the region and three rings of faces around it, with all that it carries,
/// turned as its frame says; its place and its size stay.
/// Errors: topology_mismatch; region_empty; invalid_argument for directions without length or along
/// one line, and for a feature that is not in the region; unsupported for other formats; as
/// save_mesh.
void save_part(const Part& part, const PartFrame& frame, const std::filesystem::path& path,
               const Context& context = {});

/// Reads a part. Errors: unsupported if the file has no region of that name, and for other formats;
/// as load_mesh.
Part load_part(const std::filesystem::path& path, const Context& context = {});

}  // namespace lissom
