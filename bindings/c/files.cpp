#include "bindings/c/files.h"

namespace lissom::c {

std::filesystem::path path_of(const std::string& text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

}  // namespace lissom::c
