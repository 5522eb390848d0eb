/// The header of a PLY file; private to kernel/io.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/stream/endianness.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

struct PlyProperty {
    std::string name;
    ScalarType type = ScalarType::float32;
    bool is_list = false;
    ScalarType count_type = ScalarType::uint8;
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// Number of the property called `name`, or kNoIndex.
    Index find(std::string_view property) const;
    /// Fewest bytes that one element takes, in binary or in text.
    std::size_t minimum_bytes(bool binary) const;
};

struct PlyHeader {
    bool binary = false;
    Endianness endianness = Endianness::little;
    std::vector<PlyElement> elements;
    /// Content without a place in PLY stands in comments, with percent-encoded names: names of face
    /// labels by kind, as "comment lissom group 0 left%20hand" for the number 0 of the faces'
    /// property "group", and names of material files, as "comment lissom_mtllib a.mtl".
    std::map<std::string, std::vector<std::string>, std::less<>> label_names;
    std::vector<std::string> material_libraries;
    /// Pictures of the surface, as "comment TextureFile skin.png" of other programs names them.
    std::vector<std::string> texture_files;
    /// Offset of the data: bytes and, for text, lines of the header.
    std::size_t size = 0, lines = 0;
};

/// Reads the header of a file. Counts are checked against the size of `bytes`.
/// Errors: file_syntax, file_truncated, file_too_large.
PlyHeader read_ply_header(std::string_view bytes);

/// Returns the header as text, from "ply" to "end_header".
std::string to_text(const PlyHeader& header);

}  // namespace lissom
