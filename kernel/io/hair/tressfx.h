/// .tfx, the strands of AMD's TressFX 3 to 5; private to kernel/io.
///
/// Little-endian: a header of 160 bytes with an f32 version, u32 numbers of strands and of points
/// of each, and u32 offsets of five arrays from the start of the file, 0 for none: points (xyz and
/// 0 for a point that does not move, else 1), texture coordinates of the roots, those of the
/// points, thickness of the strands, and colours of the points (rgba); 32 numbers are reserved.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/file_hair.h"

namespace lissom {

/// Points of a strand that TressFX simulates: a power of two from 4 to 64.
inline constexpr Index kTressFxLeastPoints = 4, kTressFxMostPoints = 64;

/// Returns the number of points that TressFX has for strands of at most `points`.
Index tressfx_points(Index points);

/// Reads points, texture coordinates of roots, thickness as width, and colours, whose alpha is
/// opacity. Texture coordinates of points are left out, with a warning of the log. Errors:
/// file_syntax, file_truncated, file_too_large; not_finite naming the strand; cancelled,
/// memory_limit.
FileHair read_tressfx(std::string_view bytes, const Context& context);

/// Writes the data that `read_tressfx` reads, as version 4. All strands have equally many points;
/// roots do not move. Widths are those of the roots.
void write_tressfx(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
