/// Named parts in one file: an uncompressed tar archive (POSIX ustar), which common tools list and
/// unpack; private to kernel/scene.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "kernel/scene/file/list_store.h"

namespace lissom {

/// Lists are parts under their paths; the JSON says nothing of them.
class PartWriter : public ListSink {
  public:
    SceneJson put(const ListPlace& place, std::string_view bytes, ListForm form) override;
    /// `name` has at most 99 bytes. Errors: file_too_large for 8 GiB or more, which the format
    /// cannot tell.
    void add(std::string_view name, std::string_view bytes);
    /// Adds all parts of another.
    void append(const PartWriter& other) { bytes_ += other.bytes_; }
    /// Returns the archive.
    std::string finish() &&;

  private:
    std::string bytes_;
};

/// The parts of an archive in memory, which must outlive it.
class PartReader : public ListSource {
  public:
    std::string_view get(const std::string& path, const SceneJson* entry, ListForm form) override;
    /// Errors: file_syntax if it is none or a part is damaged; file_truncated.
    explicit PartReader(std::string_view archive);

    /// Returns the bytes of a part. Errors: file_truncated if it is missing.
    std::string_view find(std::string_view name) const;
    bool has(std::string_view name) const { return parts_.contains(name); }

  private:
    std::map<std::string, std::string_view, std::less<>> parts_;
};

}  // namespace lissom
