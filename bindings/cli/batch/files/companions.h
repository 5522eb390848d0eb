/// Files that belong to another: what a job reads with the file that it names.
#pragma once

#include <set>
#include <string>

namespace lissom::cli {

/// Adds the paths of the files that are read with `file`: materials of .obj and their textures,
/// buffers and images of .gltf, all files of a scene's folder. Files that are missing are added
/// too, as they may come. Nothing is added for a file that cannot be read.
void add_companions(const std::string& file, std::set<std::string>& files);

}  // namespace lissom::cli
