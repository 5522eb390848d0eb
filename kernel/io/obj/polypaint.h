/// Colours of vertices in the comments of OBJ files (ZBrush's polypaint); private to kernel/io.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "kernel/io/record/skipped_content.h"

namespace lissom {

/// Reads the comments "#MRGB ": up to 64 colours a line for the vertices in their order, each a
/// mask, red, green and blue of two hexadecimal digits. Returns three bytes a colour. Masks other
/// than ff and invalid colours are counted in `skipped`.
std::vector<std::uint8_t> read_polypaint(std::string_view text, SkippedContent& skipped);

}  // namespace lissom
