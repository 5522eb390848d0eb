/// .hair, the format of Cem Yuksel's hair models; private to kernel/io.
///
/// Little-endian: "HAIR", counts of strands and points, bits that say which arrays follow, values
/// for all points if there is none, and 88 bytes of text; then u16 segments of each strand, and for
/// each point xyz, thickness, transparency and rgb.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/stream/byte_source.h"

namespace lissom {

/// Reads all arrays. Thickness is the width, the text the comment. Bytes after the arrays are
/// passed over, with a warning in the log. Errors: file_syntax, file_truncated, file_too_large;
/// unsupported if there are no points; not_finite naming the strand; cancelled, memory_limit.
Strands read_cyhair(ByteSource& source, const Context& context);

/// Writes the data that `read_cyhair` reads, but only arrays that differ between strands or points.
/// Errors: file_too_large naming strands of more than 65,535 segments.
void write_cyhair(const Strands& strands, std::string& bytes);

}  // namespace lissom
