#include "kernel/io/gltf/file/container.h"

#include <cstdint>
#include <limits>

#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

constexpr std::string_view kGltfMagic = "glTF";
constexpr std::size_t kGltfHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr int kDeepestJson = 64;

[[noreturn]] void refuse_short(std::size_t announced, std::size_t found) {
    refuse(ErrorCode::file_truncated, "the GLB file announces " + std::to_string(announced) +
                                          " bytes, but ends after " + std::to_string(found));
}

void require_version(std::uint32_t version) {
    if (version == kVersion) return;
    refuse(ErrorCode::unsupported, "the file is glTF " + std::to_string(version) +
                                       ".0, but only glTF 2.0 is read; convert it first");
}

void take_chunk(std::uint32_t type, std::string_view data, bool is_first, GltfContainer& result) {
    if (is_first != (type == kJsonChunk)) {
        refuse(ErrorCode::file_syntax, "a GLB file starts with a chunk of JSON and has only one");
    }
    if (is_first) {
        result.json = data;
    } else if (type == kBinaryChunk) {
        if (result.binary) {
            refuse(ErrorCode::file_syntax, "the GLB file has two chunks of binary data");
        }
        result.binary = data;
    }
}

GltfContainer open_glb(std::string_view bytes) {
    if (bytes.size() < kGltfHeaderBytes) refuse_short(kGltfHeaderBytes, bytes.size());
    ByteReader header(bytes.substr(kGltfMagic.size()), Endianness::little);
    require_version(header.read<std::uint32_t>());
    const std::size_t length = header.read<std::uint32_t>();
    if (length > bytes.size()) refuse_short(length, bytes.size());
    if (length < kGltfHeaderBytes + kChunkHeaderBytes) {
        refuse(ErrorCode::file_syntax, "the GLB file has no chunk of JSON");
    }
    GltfContainer result;
    for (std::size_t at = kGltfHeaderBytes; at < length;) {
        if (length - at < kChunkHeaderBytes) refuse_short(at + kChunkHeaderBytes, length);
        ByteReader chunk(bytes.substr(at, kChunkHeaderBytes), Endianness::little);
        const std::size_t size = chunk.read<std::uint32_t>();
        const auto type = chunk.read<std::uint32_t>();
        const bool is_first = at == kGltfHeaderBytes;
        at += kChunkHeaderBytes;
        if (size > length - at) refuse_short(at + size, length);
        take_chunk(type, bytes.substr(at, size), is_first, result);
        at += size;
    }
    return result;
}

void append_u32(std::string& bytes, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

void append_chunk(std::string& bytes, std::uint32_t type, const std::string& data, char padding) {
    append_u32(bytes, padded(data.size()));
    append_u32(bytes, type);
    bytes += data;
    bytes.append(padded(data.size()) - data.size(), padding);
}

// After the byte-order mark that some programs write.
bool begins_as_json(std::string_view bytes) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (bytes.starts_with(kMark)) bytes.remove_prefix(kMark.size());
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && (bytes[first] == '{' || bytes[first] == '[');
}

}  // namespace

GltfContainer open_gltf_container(std::string_view bytes) {
    if (bytes.starts_with(kGltfMagic)) return open_glb(bytes);
    if (begins_as_json(bytes)) return {bytes, std::nullopt};
    refuse(ErrorCode::file_syntax,
           "this is no glTF file: it begins neither with 'glTF', as a GLB does, nor with '{'");
}

void require_shallow(std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth <= kDeepestJson) continue;
            refuse(ErrorCode::file_syntax,
                   "the JSON is nested deeper than " + std::to_string(kDeepestJson) + " levels");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

std::string make_glb(const std::string& json, const std::string& binary) {
    std::size_t length = kGltfHeaderBytes + kChunkHeaderBytes + padded(json.size());
    if (!binary.empty()) length += kChunkHeaderBytes + padded(binary.size());
    if (length > std::numeric_limits<std::uint32_t>::max()) {
        refuse(ErrorCode::file_too_large,
               "a GLB file cannot be larger than 4 GiB; save the mesh in parts");
    }
    std::string bytes(kGltfMagic);
    bytes.reserve(length);
    append_u32(bytes, kVersion);
    append_u32(bytes, length);
    append_chunk(bytes, kJsonChunk, json, ' ');
    if (!binary.empty()) append_chunk(bytes, kBinaryChunk, binary, '\0');
    return bytes;
}

}  // namespace lissom
