/// Paths that scripts give.
#pragma once

#include <filesystem>
#include <string>

namespace lissom::lua {

/// The path of a script's UTF-8 text. Inside Call::attempt only.
inline std::filesystem::path file_path(const char* text) {
    const std::string bytes(text);
    return std::filesystem::path(std::u8string(bytes.begin(), bytes.end()));
}

}  // namespace lissom::lua
