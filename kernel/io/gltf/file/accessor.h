/// Reads the numbers of accessors; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Numbers of a file without gaps and with sparse values in place.
struct PackedNumbers {
    std::size_t count = 0;
    Index width = 1;
    ScalarType type = ScalarType::float32;
    bool normalized = false;
    /// In the document, or in `own`, which keeps its place when this is moved.
    std::string_view bytes;
    std::vector<char> own;

    PackedNumbers() = default;
    PackedNumbers(PackedNumbers&&) = default;
    PackedNumbers& operator=(PackedNumbers&&) = default;
    PackedNumbers(const PackedNumbers&) = delete;
    PackedNumbers& operator=(const PackedNumbers&) = delete;
};

/// Writes all numbers, `width` for each of `count` elements, from `to` on. Normalised integers
/// become fractions.
void unpack(const PackedNumbers& packed, double* to);

/// Values of an accessor, `width` for each of `count` elements.
struct AccessorValues {
    std::size_t count = 0;
    Index width = 1;
    ScalarType type = ScalarType::float32;
    bool normalized = false;
    std::vector<double> values;
};

/// Reads accessors of one document. All functions charge the elements to the budget before they
/// take memory. Errors: file_syntax naming the accessor, file_too_large.
class AccessorReader {
  public:
    AccessorReader(const GltfDocument& document, GltfBudget& budget)
        : document_(document), budget_(budget) {}

    PackedNumbers packed(int accessor) const;
    /// Normalised integers become fractions.
    AccessorValues values(int accessor) const;
    /// Indices of vertices. Errors: also face_index if one is not below `vertex_count`.
    std::vector<Index> indices(int accessor, std::size_t vertex_count) const;

  private:
    const tinygltf::Accessor& find(int accessor) const;

    const GltfDocument& document_;
    GltfBudget& budget_;
};

}  // namespace lissom
