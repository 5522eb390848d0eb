/// The codec of EXT_meshopt_compression; private to kernel/io and not installed. Needs
/// meshoptimizer at build time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lissom {

/// Content of a compressed buffer view.
enum class MeshoptMode { attributes, triangles, indices };

/// Change of the decoded values.
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// Description of a compressed buffer view.
struct MeshoptView {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    /// Elements, and bytes of each.
    std::size_t count = 0, stride = 0;
};

/// Returns whether this build has the codec.
bool has_meshopt();

/// Returns `count` elements of `stride` bytes. Errors: unsupported if the build has no codec;
/// file_syntax for a description that the extension does not allow and for corrupt bytes;
/// file_too_large for more elements than so many bytes can hold.
std::string decode_meshopt(std::string_view bytes, const MeshoptView& view);

/// Returns the compressed bytes of elements of vertices, `stride` bytes each: a multiple of 4 up to
/// 256. Errors: unsupported.
std::string encode_meshopt_vertices(std::string_view bytes, std::size_t stride);

/// Returns compressed indices, in their order (MeshoptMode::indices). Errors: unsupported.
std::string encode_meshopt_indices(std::span<const std::uint32_t> indices);

}  // namespace lissom
