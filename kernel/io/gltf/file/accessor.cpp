#include "kernel/io/gltf/file/accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_accessor(int accessor, const std::string& problem) {
    refuse(ErrorCode::file_syntax, "accessor " + std::to_string(accessor) + " " + problem);
}

ScalarType scalar_type(int component_type, int accessor) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return ScalarType::int8;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return ScalarType::uint8;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return ScalarType::int16;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return ScalarType::uint16;
        case TINYGLTF_COMPONENT_TYPE_INT:
            return ScalarType::int32;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return ScalarType::uint32;
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return ScalarType::float32;
        case TINYGLTF_COMPONENT_TYPE_DOUBLE:
            return ScalarType::float64;
        default:
            refuse_accessor(accessor, "has an unknown type of numbers");
    }
}

// Elements of one size: `stride` apart, from the start of `bytes`.
struct ElementRange {
    std::string_view bytes;
    std::size_t stride = 0, size = 0;

    const char* at(std::size_t i) const { return bytes.data() + i * stride; }
};

ElementRange elements_of_view(const GltfDocument& document, int accessor, int view_number,
                              std::size_t offset, std::size_t count, std::size_t size,
                              bool may_stride) {
    if (view_number < 0) refuse_accessor(accessor, "has no buffer view");
    const std::size_t number = view_number;
    const std::string_view view = bytes_of_view(document, number);
    const std::size_t announced = document.model.bufferViews[number].byteStride;
    const std::size_t stride = may_stride && announced > 0 ? announced : size;
    const bool fits = stride >= size && offset <= view.size() && size <= view.size() - offset &&
                      (count == 0 || (count - 1) <= (view.size() - offset - size) / stride);
    if (!fits && count > 0) {
        refuse_accessor(accessor, "reaches beyond its buffer view " + std::to_string(view_number));
    }
    return {count == 0 ? std::string_view() : view.substr(offset), stride, size};
}

void copy_elements(const ElementRange& from, std::size_t count, char* to) {
    if (from.stride == from.size) {
        if (count > 0) std::memcpy(to, from.bytes.data(), count * from.size);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i * from.size, from.at(i), from.size);
}

std::size_t read_unsigned(const char* at, ScalarType type) {
    return static_cast<std::size_t>(ByteReader({at, size_of(type)}, Endianness::little).read(type));
}

void apply_sparse(const GltfDocument& document, int number, const tinygltf::Accessor& accessor,
                  std::size_t element_size, std::vector<char>& bytes) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || at(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0) {
        refuse_accessor(number, "has sparse values that do not fit it");
    }
    const std::size_t count = sparse.count;
    const ScalarType type = scalar_type(sparse.indices.componentType, number);
    if (!is_integer(type)) refuse_accessor(number, "has sparse indices that are not integers");
    const ElementRange indices =
        elements_of_view(document, number, sparse.indices.bufferView, sparse.indices.byteOffset,
                         count, size_of(type), false);
    const ElementRange values =
        elements_of_view(document, number, sparse.values.bufferView, sparse.values.byteOffset,
                         count, element_size, false);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t index = read_unsigned(indices.at(i), type);
        if (index >= accessor.count) {
            refuse_accessor(number, "has a sparse value for element " + std::to_string(index) +
                                        ", but only " + std::to_string(accessor.count) +
                                        " elements");
        }
        std::memcpy(bytes.data() + index * element_size, values.at(i), element_size);
    }
}

// Calls use(number, i) with all numbers in order.
template <typename Use>
void for_each_number(const PackedNumbers& packed, const Use& use) {
    with_scalar(packed.type, [&](auto zero) {
        using T = decltype(zero);
        const std::size_t count = packed.count * packed.width;
        for (std::size_t i = 0; i < count; ++i) {
            use(from_bytes<T>(packed.bytes.data() + i * sizeof(T), Endianness::little), i);
        }
    });
}

}  // namespace

void unpack(const PackedNumbers& packed, double* to) {
    const double largest = packed.normalized ? range_of(packed.type).max : 1.0;
    for_each_number(packed, [&](auto value, std::size_t i) {
        const auto number = static_cast<double>(value);
        to[i] = packed.normalized ? std::max(number / largest, -1.0) : number;
    });
}

const tinygltf::Accessor& AccessorReader::find(int accessor) const {
    if (accessor < 0 || at(accessor) >= document_.model.accessors.size()) {
        refuse_accessor(accessor, "does not exist");
    }
    return document_.model.accessors[accessor];
}

PackedNumbers AccessorReader::packed(int number) const {
    const tinygltf::Accessor& accessor = find(number);
    budget_.require(accessor.count);
    PackedNumbers packed;
    packed.count = accessor.count;
    packed.width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    packed.type = scalar_type(accessor.componentType, number);
    packed.normalized = accessor.normalized && is_integer(packed.type);
    const std::size_t size = packed.width * size_of(packed.type);
    // Matrices count as the vectors they are made of.
    budget_.charge(packed.count * std::max<Index>(packed.width / 4, 1));
    ElementRange elements;
    if (accessor.bufferView >= 0) {
        elements = elements_of_view(document_, number, accessor.bufferView, accessor.byteOffset,
                                    packed.count, size, true);
    }
    if (accessor.bufferView >= 0 && elements.stride == size && !accessor.sparse.isSparse) {
        packed.bytes = elements.bytes.substr(0, packed.count * size);
        return packed;
    }
    packed.own.resize(packed.count * size);
    if (accessor.bufferView >= 0) copy_elements(elements, packed.count, packed.own.data());
    if (accessor.sparse.isSparse) apply_sparse(document_, number, accessor, size, packed.own);
    packed.bytes = {packed.own.data(), packed.own.size()};
    return packed;
}

AccessorValues AccessorReader::values(int number) const {
    const PackedNumbers packed = this->packed(number);
    AccessorValues result{packed.count, packed.width, packed.type, packed.normalized, {}};
    result.values.resize(packed.count * packed.width);
    unpack(packed, result.values.data());
    return result;
}

std::vector<Index> AccessorReader::indices(int number, std::size_t vertex_count) const {
    const PackedNumbers packed = this->packed(number);
    const bool is_right = packed.width == 1 && !packed.normalized &&
                          (packed.type == ScalarType::uint8 || packed.type == ScalarType::uint16 ||
                           packed.type == ScalarType::uint32);
    if (!is_right) refuse_accessor(number, "does not hold indices");
    const double restart = range_of(packed.type).max;
    std::vector<Index> indices(packed.count);
    std::uint64_t largest = 0;
    for_each_number(packed, [&](auto value, std::size_t i) {
        if constexpr (std::is_unsigned_v<decltype(value)>) {
            indices[i] = static_cast<Index>(value);
            largest = std::max<std::uint64_t>(largest, value);
        }
    });
    const bool all_fit = largest < vertex_count && largest < restart;
    if (all_fit || packed.count == 0) return indices;
    for_each_number(packed, [&](auto value, std::size_t) {
        const auto index = static_cast<double>(value);
        if (index == restart) {
            refuse_accessor(
                number, "has the index " + std::to_string(value) + ", which glTF does not allow");
        }
        if (index >= vertex_count) {
            refuse(ErrorCode::face_index, "accessor " + std::to_string(number) +
                                              " refers to vertex " + std::to_string(value) +
                                              ", but there are only " +
                                              std::to_string(vertex_count));
        }
    });
    return indices;
}

}  // namespace lissom
