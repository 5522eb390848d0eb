/// Lengths in messages; private to kernel/hair.
#pragma once

#include <sstream>
#include <string>

namespace lissom {

/// Three digits: "0.0123".
inline std::string length_text(double length) {
    std::ostringstream text;
    text.precision(3);
    text << length;
    return text.str();
}

}  // namespace lissom
