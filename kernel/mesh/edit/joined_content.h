/// Contents of meshes being joined; private to the kernel.
#pragma once

#include <functional>
#include <map>
#include <span>
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

/// Values of an attribute on the side that lacks it: none; or, of colors and texture coordinates,
/// one that can be shown.
enum class AbsentValues { none, shown };

/// Returns the contents of the mesh that `append` makes, without its asset. `renames` holds the
/// labels of `other` that mean something else in `mesh`. Errors: as require_complete_attributes;
/// cancelled.
JoinedContent joined_content(const Mesh& mesh, const Mesh& other, const LabelRenames& renames,
                             const Context& context, AbsentValues absent = AbsentValues::shown);

/// Appends with such values and without warnings. Errors: as `append`.
void append_with(Mesh& mesh, const Mesh& other, AbsentValues absent, const Context& context);

/// Returns the number that a color (1: white, opaque) or texture coordinate (0) gets on a side
/// without it; kNone for other attributes.
double shown_value(const Attribute& attribute);

/// A mesh that is joined with others, and how a user knows it.
struct NamedSide {
    std::string name;
    const Mesh* mesh = nullptr;
};

/// Returns a warning for each color and texture coordinate that some of the meshes have and others
/// lack, with the value that it gets there.
std::vector<std::string> absence_warnings(std::span<const NamedSide> sides);

}  // namespace lissom
