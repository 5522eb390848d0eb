/// Recognises mesh files by their content; private to kernel/io.
#pragma once

#include <string_view>

namespace lissom {

/// Name of the format that the content of a file has for certain ("PLY"), or nothing if that cannot
/// be told.
std::string_view sniff_format(std::string_view bytes);

}  // namespace lissom
