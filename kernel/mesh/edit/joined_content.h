/// Contents of meshes being joined; private to the kernel.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/asset.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Contents of two meshes, by their element ids after one is appended.
struct JoinedContent {
    /// With the labels.
    AttributeSet attributes;
    /// The vertices of named regions.
    std::map<std::string, std::vector<Index>, std::less<>> regions;
    std::vector<std::string> material_libraries;
};

/// Returns the contents of the mesh that `append` makes, without its asset. `renames` holds the
/// labels of `other` that mean something else in `mesh`. Errors: as require_complete_attributes;
/// cancelled.
JoinedContent joined_content(const Mesh& mesh, const Mesh& other, const LabelRenames& renames,
                             const Context& context);

}  // namespace lissom
