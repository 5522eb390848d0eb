/// GltfBinary: the buffer of a glTF file being written, with its views and accessors; private to
/// kernel/io and not installed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Numbers for an accessor: `width` (1 to 4) for each element.
struct WrittenNumbers {
    Index width = 1;
    /// float32, or an integer type of at most 16 bits; indices also uint32.
    ScalarType type = ScalarType::float32;
    bool normalized = false;
    std::vector<double> values;
    /// Values are rounded to multiples of this power of two; 0 leaves them.
    double step = 0.0;
};

/// Returns the numbers as packed little-endian bytes, elements `stride` bytes apart.
std::string encoded(const WrittenNumbers& numbers, std::size_t stride);

/// Rounds the values to their step. Errors: none; a step too small for 24 bits is doubled until
/// all values fit.
void round_to_step(WrittenNumbers& numbers);

/// Use of an accessor.
enum class BufferUse { vertices, indices };

class GltfBinary {
  public:
    /// With `compressed`, views of vertices and indices are compressed by EXT_meshopt_compression.
    explicit GltfBinary(bool compressed = false) : compressed_(compressed) {}

    /// Adds numbers and returns the accessor's number. Elements of vertices start at multiples of 4
    /// bytes. `with_bounds` adds the least and largest values.
    std::size_t add(const WrittenNumbers& numbers, BufferUse use, bool with_bounds = false);
    /// Adds an accessor of numbers that stand elsewhere, and returns its number.
    std::size_t add_without_view(const WrittenNumbers& numbers, bool with_bounds);
    /// Adds the numbers that are not zero, if that takes fewer bytes, and returns the accessor's
    /// number. Compressed views hold all numbers: zeros take hardly any room there.
    std::size_t add_sparse(const WrittenNumbers& numbers, bool with_bounds = false);
    /// Adds an accessor with given bytes; `use` is that of their view.
    std::size_t add(Json accessor, std::string_view bytes, std::optional<BufferUse> use = {});
    /// Adds bytes and returns the number of their view.
    std::size_t add_view(std::string_view bytes);

    const std::string& bytes() const { return bytes_; }
    /// Moves views and accessors into a document.
    void finish(Json& document);

  private:
    Json described(const WrittenNumbers& numbers, bool with_bounds) const;
    std::size_t add_compressed(const WrittenNumbers& numbers, BufferUse use, std::size_t stride);

    Json views_ = Json::array(), accessors_ = Json::array();
    std::string bytes_;
    bool compressed_ = false;
    // Bytes that the compressed views have when decompressed.
    std::size_t decompressed_bytes_ = 0;
};

}  // namespace lissom
