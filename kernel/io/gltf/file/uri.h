/// URIs in glTF files: data inside the text, and files beside it; private to kernel/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/core/context.h"

namespace lissom {

/// Bytes that several owners may refer to.
using SharedBytes = std::shared_ptr<const std::string>;

/// The content of a data URI.
struct UriData {
    std::string bytes;
    std::string media_type;
};

/// Returns the data in `uri`, or nothing if it is not a data URI. Errors: file_syntax.
std::optional<UriData> decode_data_uri(std::string_view uri);

/// Returns a data URI of `bytes`.
std::string make_data_uri(std::string_view bytes);

/// True for http and https.
bool is_on_the_web(std::string_view uri);

/// The files in one folder, each read once.
class GltfFolder {
  public:
    /// An empty path is no folder: no file can be opened then.
    GltfFolder(std::filesystem::path folder, const Context& context)
        : folder_(std::move(folder)), context_(context) {}

    /// Returns the first `length` bytes, if it has as many, of the file at the relative `uri`.
    /// Errors: unsafe_path if it is not inside the folder; unsupported for the web; file_not_found;
    /// file_truncated; file_too_large if no memory can hold as many; those of require_file.
    SharedBytes read(std::string_view uri, std::uint64_t length);
    /// Returns all of a file, or null if there is none. Errors: as `read`; file_too_large.
    SharedBytes read_if_there(std::string_view uri);

    /// Bytes that were read.
    std::size_t bytes_read() const { return bytes_read_; }

  private:
    std::filesystem::path path_of(const std::filesystem::path& relative,
                                  std::string_view uri) const;
    SharedBytes read_path(const std::filesystem::path& path, std::size_t length);
    SharedBytes read_from_host(const std::filesystem::path& path);

    std::filesystem::path folder_;
    const Context& context_;
    std::map<std::filesystem::path, SharedBytes> content_;
    std::size_t bytes_read_ = 0;
};

}  // namespace lissom
