/// RIB, the scene files of RenderMan; private to kernel/io.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Writes linear Curves, one for each group, in an attribute block with its name; the strands of no
/// group are called "hair". Widths are diameters: "constantwidth", or "width" at each point.
void write_rib(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
