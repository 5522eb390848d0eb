/// The codec of KHR_draco_mesh_compression; private to kernel/io and not installed. Needs Draco at
/// build time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// An attribute to read: its number in the compressed mesh, and the form that its accessor asks
/// for.
struct DracoWanted {
    std::uint32_t id = 0;
    Index width = 1;
    ScalarType type = ScalarType::float32;
};

/// A decoded primitive.
struct DracoPrimitive {
    std::size_t vertex_count = 0;
    /// Three for each triangle.
    std::vector<std::uint32_t> indices;
    /// Packed little-endian numbers of each attribute wanted.
    std::vector<std::string> attributes;
};

/// An attribute to write: packed little-endian numbers, one row a vertex.
struct DracoAttribute {
    std::string_view bytes;
    Index width = 1;
    ScalarType type = ScalarType::float32;
    bool normalized = false;
    bool is_position = false;
    /// Bits of each number; 0 keeps them exactly.
    int bits = 0;
    /// Least number of each component and size of the range that the bits divide. Empty: those of
    /// the numbers.
    std::vector<float> least;
    float range = 0.0f;
};

/// Returns whether this build has the codec.
bool has_draco();

/// Decodes a mesh of triangles. Errors: unsupported if the build has no codec, for point clouds and
/// for streams older than Draco 2.2; file_syntax for corrupt bytes and attributes that are not
/// there; file_too_large for more elements than so many bytes can hold.
DracoPrimitive decode_draco(std::string_view bytes, const std::vector<DracoWanted>& wanted);

/// Encodes triangles; vertices and faces keep their order. The attributes get the numbers 0, 1, ...
/// Errors: unsupported.
std::string encode_draco(const std::vector<std::uint32_t>& indices,
                         const std::vector<DracoAttribute>& attributes);

}  // namespace lissom
