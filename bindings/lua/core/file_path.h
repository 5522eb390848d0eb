/// Paths that scripts give.
#pragma once

#include <filesystem>
#include <string_view>

namespace lissom::lua {

/// The path of a script's UTF-8 text. Inside Call::attempt only.
inline std::filesystem::path file_path(std::string_view text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

}  // namespace lissom::lua
