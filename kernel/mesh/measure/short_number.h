/// Numbers in messages; private to kernel/mesh.
#pragma once

#include <cstdio>
#include <string>

namespace lissom {

/// Three digits: "0.0123".
inline std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace lissom
