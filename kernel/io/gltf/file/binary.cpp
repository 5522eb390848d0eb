#include "kernel/io/gltf/file/binary.h"

#include <algorithm>
#include <array>

#include "kernel/io/gltf/file/container.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

int component_type(ScalarType type) {
    switch (type) {
        case ScalarType::int8:
            return TINYGLTF_COMPONENT_TYPE_BYTE;
        case ScalarType::uint8:
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
        case ScalarType::int16:
            return TINYGLTF_COMPONENT_TYPE_SHORT;
        case ScalarType::uint16:
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        case ScalarType::uint32:
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        default:
            return TINYGLTF_COMPONENT_TYPE_FLOAT;
    }
}

const char* type_name(Index width) {
    constexpr std::array<const char*, 4> kNames{"SCALAR", "VEC2", "VEC3", "VEC4"};
    return kNames[width - 1];
}

int target_for(BufferUse use) {
    return use == BufferUse::indices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER
                                     : TINYGLTF_TARGET_ARRAY_BUFFER;
}

// Elements `stride` bytes apart.
std::string encoded(const WrittenNumbers& numbers, std::size_t stride) {
    const std::size_t width = numbers.width;
    const std::size_t count = numbers.values.size() / width;
    std::string bytes(count * stride, '\0');
    with_scalar(numbers.type, [&](auto zero) {
        using T = decltype(zero);
        for (std::size_t i = 0; i < numbers.values.size(); ++i) {
            const auto number = to_bytes(static_cast<T>(numbers.values[i]), Endianness::little);
            std::copy(number.begin(), number.end(),
                      bytes.data() + i / width * stride + i % width * sizeof(T));
        }
    });
    return bytes;
}

void add_bounds(const WrittenNumbers& numbers, Json& accessor) {
    const std::size_t width = numbers.width;
    std::vector<double> least(numbers.values.begin(), numbers.values.begin() + width);
    std::vector<double> largest = least;
    for (std::size_t i = 0; i < numbers.values.size(); ++i) {
        least[i % width] = std::min(least[i % width], numbers.values[i]);
        largest[i % width] = std::max(largest[i % width], numbers.values[i]);
    }
    accessor["min"] = least;
    accessor["max"] = largest;
}

}  // namespace

std::size_t GltfBinary::add_view(std::string_view bytes) {
    views_.push_back(
        json_object({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}}));
    bytes_ += bytes;
    bytes_.append(padded(bytes_.size()) - bytes_.size(), '\0');
    return views_.size() - 1;
}

std::size_t GltfBinary::add(Json accessor, std::string_view bytes, std::optional<BufferUse> use) {
    accessor["bufferView"] = add_view(bytes);
    if (use) views_.back()["target"] = target_for(*use);
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

std::size_t GltfBinary::add(const WrittenNumbers& numbers, BufferUse use, bool with_bounds) {
    const bool is_indices = use == BufferUse::indices;
    const std::size_t width = numbers.width;
    const std::size_t size = width * size_of(numbers.type);
    const std::size_t stride = is_indices ? size : padded(size);
    Json accessor = json_object({{"componentType", component_type(numbers.type)},
                                 {"count", numbers.values.size() / width},
                                 {"type", type_name(numbers.width)}});
    if (numbers.normalized) accessor["normalized"] = true;
    if (with_bounds) add_bounds(numbers, accessor);
    const std::size_t added = add(std::move(accessor), encoded(numbers, stride), use);
    if (!is_indices && stride != size) views_.back()["byteStride"] = stride;
    return added;
}

void GltfBinary::finish(Json& document) {
    if (!accessors_.empty()) document["accessors"] = std::move(accessors_);
    if (!views_.empty()) document["bufferViews"] = std::move(views_);
    if (!bytes_.empty())
        list_in(document, "buffers").push_back(json_object({{"byteLength", bytes_.size()}}));
}

}  // namespace lissom
