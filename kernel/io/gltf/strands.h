/// Hair as lines of glTF 2.0; private to kernel/io and not installed.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Writes one mesh "Hair" of one LINES primitive with 32-bit indices, and COLOR_0 if there are
/// colours, as a text with all data inside.
void write_gltf_strands(const Strands& strands, std::string& bytes, const Context& context);

/// Writes as `write_gltf_strands` does, as one binary file. Errors: file_too_large beyond 4 GiB.
void write_glb_strands(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
