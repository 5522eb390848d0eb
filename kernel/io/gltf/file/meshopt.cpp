#include "kernel/io/gltf/file/meshopt.h"

#include <algorithm>

#include "kernel/core/error.h"
#include "kernel/io/stream/read_error.h"

#ifdef LISSOM_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace lissom {

#ifdef LISSOM_HAS_MESHOPT
namespace {

// A byte of the codec of vertices holds at most 64 bytes, and one of the codecs of indices at most
// a triangle; the rest is room for short buffers.
constexpr std::size_t kMaxPerByte = 128, kAlwaysAllowed = 65536;
constexpr std::size_t kLargestStride = 256;

bool is_allowed(const MeshoptView& view) {
    if (view.mode != MeshoptMode::attributes) {
        const bool is_index = view.stride == 2 || view.stride == 4;
        const bool is_whole = view.mode == MeshoptMode::indices || view.count % 3 == 0;
        return is_index && is_whole && view.filter == MeshoptFilter::none;
    }
    const bool fits = view.stride > 0 && view.stride % 4 == 0 && view.stride <= kLargestStride;
    switch (view.filter) {
        case MeshoptFilter::octahedral:
            return view.stride == 4 || view.stride == 8;
        case MeshoptFilter::quaternion:
            return view.stride == 8;
        default:
            return fits;
    }
}

void require_plausible(std::string_view bytes, const MeshoptView& view) {
    if (!is_allowed(view)) {
        refuse(ErrorCode::file_syntax, "a view compressed by EXT_meshopt_compression has " +
                                           std::to_string(view.count) + " elements of " +
                                           std::to_string(view.stride) +
                                           " bytes, which its mode or its filter does not allow");
    }
    const std::size_t most = kMaxPerByte * bytes.size() + kAlwaysAllowed;
    if (view.count <= most / view.stride) return;
    refuse(ErrorCode::file_too_large, "a compressed view of " + std::to_string(bytes.size()) +
                                          " bytes cannot hold " + std::to_string(view.count) +
                                          " elements");
}

int decode_into(std::string& result, std::string_view bytes, const MeshoptView& view) {
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    switch (view.mode) {
        case MeshoptMode::triangles:
            return meshopt_decodeIndexBuffer(result.data(), view.count, view.stride, from,
                                             bytes.size());
        case MeshoptMode::indices:
            return meshopt_decodeIndexSequence(result.data(), view.count, view.stride, from,
                                               bytes.size());
        default:
            return meshopt_decodeVertexBuffer(result.data(), view.count, view.stride, from,
                                              bytes.size());
    }
}

void unfilter(std::string& bytes, const MeshoptView& view) {
    switch (view.filter) {
        case MeshoptFilter::octahedral:
            return meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
        case MeshoptFilter::quaternion:
            return meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
        case MeshoptFilter::exponential:
            return meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
        case MeshoptFilter::none:
            return;
    }
}

}  // namespace

bool has_meshopt() {
    return true;
}

std::string decode_meshopt(std::string_view bytes, const MeshoptView& view) {
    require_plausible(bytes, view);
    std::string result(view.count * view.stride, '\0');
    if (view.count == 0) return result;
    if (decode_into(result, bytes, view) != 0) {
        refuse(ErrorCode::file_syntax, "a view compressed by EXT_meshopt_compression is corrupt");
    }
    unfilter(result, view);
    return result;
}

std::string encode_meshopt_vertices(std::string_view bytes, std::size_t stride) {
    const std::size_t count = bytes.size() / stride;
    std::string result(meshopt_encodeVertexBufferBound(count, stride), '\0');
    meshopt_encodeVertexVersion(0);
    result.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(result.data()),
                                             result.size(), bytes.data(), count, stride));
    return result;
}

std::string encode_meshopt_indices(std::span<const std::uint32_t> indices) {
    std::size_t vertex_count = 0;
    for (const std::uint32_t index : indices) {
        vertex_count = std::max<std::size_t>(vertex_count, std::size_t{index} + 1);
    }
    std::string result(meshopt_encodeIndexSequenceBound(indices.size(), vertex_count), '\0');
    meshopt_encodeIndexVersion(1);
    result.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(result.data()),
                                              result.size(), indices.data(), indices.size()));
    return result;
}

#else

namespace {

[[noreturn]] void refuse_meshopt() {
    refuse(ErrorCode::unsupported,
           "EXT_meshopt_compression is not part of this build; build it with meshoptimizer (on "
           "Debian: apt-get install libmeshoptimizer-dev)");
}

}  // namespace

bool has_meshopt() {
    return false;
}

std::string decode_meshopt(std::string_view, const MeshoptView&) {
    refuse_meshopt();
}

std::string encode_meshopt_vertices(std::string_view, std::size_t) {
    refuse_meshopt();
}

std::string encode_meshopt_indices(std::span<const std::uint32_t>) {
    refuse_meshopt();
}

#endif

}  // namespace lissom
