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
};

/// Use of an accessor.
enum class BufferUse { vertices, indices };

class GltfBinary {
  public:
    /// Adds numbers and returns the accessor's number. Elements of vertices start at multiples of 4
    /// bytes. `with_bounds` adds the least and largest values.
    std::size_t add(const WrittenNumbers& numbers, BufferUse use, bool with_bounds = false);
    /// Adds an accessor with given bytes; `use` is that of their view.
    std::size_t add(Json accessor, std::string_view bytes, std::optional<BufferUse> use = {});
    /// Adds bytes and returns the number of their view.
    std::size_t add_view(std::string_view bytes);

    const std::string& bytes() const { return bytes_; }
    /// Moves views and accessors into a document.
    void finish(Json& document);

  private:
    Json views_ = Json::array(), accessors_ = Json::array();
    std::string bytes_;
};

}  // namespace lissom
