/// Names in files whose grammar leaves no room for all of them, written with percent signs as in
/// addresses of the web; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

namespace lissom {

/// `name` with blanks, control characters, '%', '\\', '#', '"' and, unless `keeps_utf8`, bytes
/// beyond ASCII as %HH.
std::string percent_encoded(std::string_view name, bool keeps_utf8 = false);

/// Returns the value of a hexadecimal digit, or -1.
int hex_digit(char c);

/// Returns one byte as %HH.
std::string percent_encoded_byte(char byte);

/// The inverse; a '%' without two hexadecimal digits after it stands for itself.
std::string percent_decoded(std::string_view text);

}  // namespace lissom
