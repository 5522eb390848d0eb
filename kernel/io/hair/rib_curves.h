/// RIB, the scene files of RenderMan; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Writes linear Curves, one for each group, in an attribute block with its name; the strands of no
/// group are called "hair". Widths are diameters: "constantwidth", or "width" at each point. Text
/// around them: rib_scene.h.
void write_rib_curves(const Strands& strands, std::string& bytes, const Context& context);

/// Returns a text in quotes, as RIB has it.
std::string rib_text(std::string_view text);

}  // namespace lissom
