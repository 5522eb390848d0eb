/// The two forms of a glTF file: JSON text, or GLB with chunks of JSON and of binary data; private
/// to kernel/io.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lissom {

/// The parts of a file.
struct GltfContainer {
    std::string_view json;
    /// The binary chunk of a GLB.
    std::optional<std::string_view> binary;
};

/// Takes a file apart; its form is told by its content.
/// Errors: file_truncated; file_syntax; unsupported for GLB of other versions than 2.
GltfContainer open_gltf_container(std::string_view bytes);

/// Throws file_syntax if arrays and objects of `json` are nested so deep that it may not be parsed.
void require_shallow(std::string_view json);

/// Returns a GLB of JSON and binary data. Errors: file_too_large beyond 4 GiB.
std::string make_glb(const std::string& json, const std::string& binary);

/// `size` up to a multiple of 4, as chunks and accessors begin.
inline std::size_t padded(std::size_t size) {
    return (size + 3) / 4 * 4;
}

}  // namespace lissom
