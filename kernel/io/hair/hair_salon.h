/// .data, the strands of HairSalon and the data sets made with it; private to kernel/io.
///
/// Little-endian: i32 number of strands, and for each the i32 number of its points and their xyz.
/// A strand of one point says that there is no hair at its root.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/stream/byte_source.h"

namespace lissom {

/// Reads strands, those of one point too. Strands of no points are left out, and bytes after the
/// last are passed over, each with a warning of the log. Errors: file_syntax, file_truncated,
/// file_too_large; not_finite naming the strand; cancelled, memory_limit.
Strands read_hair_salon(ByteSource& source, const Context& context);

/// Writes the points.
void write_hair_salon(const Strands& strands, std::string& bytes);

}  // namespace lissom
