#include "kernel/io/stream/text_writer.h"

namespace lissom {

std::string one_line(std::string_view name) {
    std::string line(name);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20) c = '_';
    }
    if (line.ends_with('\\')) line.back() = '_';
    return line;
}

}  // namespace lissom
