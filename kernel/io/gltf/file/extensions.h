/// Supported extensions of glTF; private to kernel/io and not installed.
#pragma once

#include <string>
#include <vector>

#include "kernel/io/gltf/file/json.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Throws unsupported if a file requires an extension that is not understood, or keeps its surface
/// in one.
void require_supported_extensions(const Json& document);

/// Removes parts of a document that would be false once its surface is written anew: extensions
/// that refer to bytes of the file. Reports them, and those of primitives, accessors and buffer
/// views that are not understood.
void drop_bound_extensions(Json& document, Report& report);

/// Returns the names of all extensions that stand somewhere in `document`, sorted.
std::vector<std::string> extensions_inside(const Json& document);

}  // namespace lissom
