/// Hair as lines of OBJ; private to kernel/io.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Writes all points as vertices and each strand as one line element, strands of a group after its
/// "g" statement. Groups follow one another as their strands do.
void write_obj_strands(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
