/// Named parts in one file: an uncompressed tar archive (POSIX ustar), which common tools list and
/// unpack; private to kernel/scene.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace lissom {

class PartWriter {
  public:
    /// `name` has at most 99 bytes. Errors: file_too_large for 8 GiB or more, which the format
    /// cannot tell.
    void add(std::string_view name, std::string_view bytes);
    /// The archive.
    std::string finish() &&;

  private:
    std::string bytes_;
};

/// The parts of an archive in memory, which must outlive it.
class PartReader {
  public:
    /// Errors: file_syntax where it is none or a part is damaged; file_truncated.
    explicit PartReader(std::string_view archive);

    /// The bytes of a part. Errors: file_truncated where it is missing.
    std::string_view find(std::string_view name) const;

  private:
    std::map<std::string, std::string_view, std::less<>> parts_;
};

}  // namespace lissom
