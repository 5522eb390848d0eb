/// GltfDocument: a glTF file opened and checked; private to kernel/io and not installed.
///
/// tinygltf parses the text once it was checked and freed of buffers and images, so that it opens
/// no file and decodes nothing. Its model places numbers and shapes; a defect that it finds in the
/// rest is an error. The rest is kept as JSON, and is complete when it is saved again.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/file/uri.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Limit of a file's size in memory, in elements (vertices, corners, nodes). A small file that
/// refers to the same bytes many times is refused when it would exceed it.
class GltfBudget {
  public:
    explicit GltfBudget(std::size_t bytes_read);
    /// Errors: file_too_large.
    void charge(std::size_t elements);
    /// Refuses as `charge` does, but takes nothing.
    void require(std::size_t elements) const;
    bool allows(std::size_t elements) const { return elements <= left_; }

  private:
    std::size_t left_;
};

struct GltfDocument {
    Json json;
    tinygltf::Model model;
    /// Content of each buffer; empty if it has none. Views into the file or `owned`.
    std::vector<std::string_view> buffers;
    std::vector<SharedBytes> owned;
    /// Content of each image that is there.
    std::vector<SharedBytes> images;
    /// Bytes of the file and of its referenced files.
    std::size_t bytes_read = 0;
    /// Of its values, and of the bytes of all files.
    MemoryCharge values, charge;
    /// Of buffers that were decompressed.
    std::vector<MemoryCharge> decompressed;
};

/// Returns the bytes of a buffer view. Errors: file_syntax naming it if they are not in its buffer.
std::string_view bytes_of_view(const GltfDocument& document, std::size_t view);

/// Opens a file. Missing images are reported; the elements of images get their media type.
/// Errors: as `read_gltf`.
GltfDocument open_gltf(const FileInput& file, Report& report, const Context& context);

}  // namespace lissom
