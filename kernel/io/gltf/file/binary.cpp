#include "kernel/io/gltf/file/binary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernel/io/gltf/file/container.h"
#include "kernel/io/gltf/file/meshopt.h"
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

// Numbers of the filter EXPONENTIAL: 24 bits times a power of two, both signed.
std::string exponential(const WrittenNumbers& numbers) {
    constexpr std::uint32_t kMantissa = 0xffffff;
    const int exponent = std::ilogb(numbers.step);
    const std::uint32_t high = static_cast<std::uint32_t>(exponent) << 24;
    std::string bytes;
    bytes.reserve(numbers.values.size() * sizeof(std::uint32_t));
    for (const double value : numbers.values) {
        const auto whole = static_cast<std::int32_t>(std::lround(std::ldexp(value, -exponent)));
        append_number(bytes, (static_cast<std::uint32_t>(whole) & kMantissa) | high,
                      Endianness::little);
    }
    return bytes;
}

const char* mode_name(BufferUse use) {
    return use == BufferUse::indices ? "INDICES" : "ATTRIBUTES";
}

std::string compressed_bytes(const WrittenNumbers& numbers, BufferUse use, std::size_t stride) {
    if (use == BufferUse::indices) {
        const std::vector<std::uint32_t> indices(numbers.values.begin(), numbers.values.end());
        return encode_meshopt_indices(indices);
    }
    return encode_meshopt_vertices(
        numbers.step > 0.0 ? exponential(numbers) : encoded(numbers, stride), stride);
}

// The elements that have a number other than zero.
std::vector<double> elements_with_values(const WrittenNumbers& numbers) {
    std::vector<double> elements;
    const std::size_t width = numbers.width;
    for (std::size_t i = 0; i < numbers.values.size() / width; ++i) {
        const auto first = numbers.values.begin() + static_cast<std::ptrdiff_t>(i * width);
        if (std::any_of(first, first + numbers.width, [](double x) { return x != 0.0; })) {
            elements.push_back(static_cast<double>(i));
        }
    }
    return elements;
}

}  // namespace

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

void round_to_step(WrittenNumbers& numbers) {
    constexpr double kLargest = 8388607.0;
    if (numbers.step <= 0.0) return;
    double largest = 0.0;
    for (const double value : numbers.values) largest = std::max(largest, std::abs(value));
    while (largest > kLargest * numbers.step) numbers.step *= 2.0;
    for (double& value : numbers.values) {
        value = std::round(value / numbers.step) * numbers.step + 0.0;
    }
}

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

Json GltfBinary::described(const WrittenNumbers& numbers, bool with_bounds) const {
    Json accessor =
        json_object({{"componentType", component_type(numbers.type)},
                     {"count", numbers.values.size() / static_cast<std::size_t>(numbers.width)},
                     {"type", type_name(numbers.width)}});
    if (numbers.normalized) accessor["normalized"] = true;
    if (with_bounds) add_bounds(numbers, accessor);
    return accessor;
}

std::size_t GltfBinary::add(const WrittenNumbers& numbers, BufferUse use, bool with_bounds) {
    const bool is_indices = use == BufferUse::indices;
    const std::size_t size = numbers.width * size_of(numbers.type);
    const std::size_t stride = is_indices ? size : padded(size);
    Json accessor = described(numbers, with_bounds);
    if (compressed_ && !numbers.values.empty()) {
        accessor["bufferView"] = add_compressed(numbers, use, stride);
        accessors_.push_back(std::move(accessor));
        return accessors_.size() - 1;
    }
    const std::size_t added = add(std::move(accessor), encoded(numbers, stride), use);
    if (!is_indices && stride != size) views_.back()["byteStride"] = stride;
    return added;
}

// The view has a place in a buffer without bytes, for programs that know only plain views.
std::size_t GltfBinary::add_compressed(const WrittenNumbers& numbers, BufferUse use,
                                       std::size_t stride) {
    const std::string bytes = compressed_bytes(numbers, use, stride);
    const std::size_t count = numbers.values.size() / static_cast<std::size_t>(numbers.width);
    Json extension = json_object({{"buffer", 0},
                                  {"byteOffset", bytes_.size()},
                                  {"byteLength", bytes.size()},
                                  {"byteStride", stride},
                                  {"count", count},
                                  {"mode", mode_name(use)}});
    if (use == BufferUse::vertices && numbers.step > 0.0) extension["filter"] = "EXPONENTIAL";
    bytes_ += bytes;
    bytes_.append(padded(bytes_.size()) - bytes_.size(), '\0');
    Json view = json_object({{"buffer", 1},
                             {"byteOffset", decompressed_bytes_},
                             {"byteLength", count * stride},
                             {"target", target_for(use)}});
    if (use == BufferUse::vertices) view["byteStride"] = stride;
    view["extensions"]["EXT_meshopt_compression"] = std::move(extension);
    decompressed_bytes_ += padded(count * stride);
    views_.push_back(std::move(view));
    return views_.size() - 1;
}

std::size_t GltfBinary::add_without_view(const WrittenNumbers& numbers, bool with_bounds) {
    accessors_.push_back(described(numbers, with_bounds));
    return accessors_.size() - 1;
}

std::size_t GltfBinary::add_sparse(const WrittenNumbers& numbers, bool with_bounds) {
    const std::size_t width = numbers.width;
    const WrittenNumbers elements{1, ScalarType::uint32, false, elements_with_values(numbers)};
    const std::size_t count = elements.values.size();
    const bool is_shorter = (width + 1) * count < numbers.values.size();
    if (compressed_ || !is_shorter) return add(numbers, BufferUse::vertices, with_bounds);
    Json accessor = described(numbers, with_bounds);
    if (count > 0) {
        WrittenNumbers values{numbers.width, numbers.type, numbers.normalized, {}};
        for (const double element : elements.values) {
            const auto first =
                numbers.values.begin() + static_cast<std::ptrdiff_t>(element) * numbers.width;
            values.values.insert(values.values.end(), first, first + numbers.width);
        }
        const std::size_t places = add_view(encoded(elements, sizeof(std::uint32_t)));
        const std::size_t contents = add_view(encoded(values, width * size_of(values.type)));
        Json indices = json_object(
            {{"bufferView", places}, {"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}});
        Json contents_at = json_object({{"bufferView", contents}});
        accessor["sparse"] = json_object({{"count", count},
                                          {"indices", std::move(indices)},
                                          {"values", std::move(contents_at)}});
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

void GltfBinary::finish(Json& document) {
    if (!accessors_.empty()) document["accessors"] = std::move(accessors_);
    if (!views_.empty()) document["bufferViews"] = std::move(views_);
    if (!bytes_.empty())
        list_in(document, "buffers").push_back(json_object({{"byteLength", bytes_.size()}}));
    if (decompressed_bytes_ == 0) return;
    Json stand_in = json_object({{"byteLength", decompressed_bytes_}});
    stand_in["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    list_in(document, "buffers").push_back(std::move(stand_in));
}

}  // namespace lissom
