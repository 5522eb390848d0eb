/// The lists of a history: in blocks, each kept once, so that steps share equal parts; private to
/// kernel/scene.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "kernel/scene/file/list_store.h"
#include "kernel/scene/file/part_archive.h"

namespace lissom {

/// Blocks are parts "blocks/0", "blocks/1", ... of an archive.
class BlockSink : public ListSink {
  public:
    explicit BlockSink(PartWriter& parts) : parts_(parts) {}
    SceneJson put(const ListPlace& place, std::string_view bytes, ListForm form) override;

  private:
    std::size_t number_of(std::string_view block);

    PartWriter& parts_;
    std::deque<std::string> blocks_;
    std::unordered_map<std::string_view, std::size_t> numbers_;
};

class BlockSource : public ListSource {
  public:
    explicit BlockSource(const PartReader& parts) : parts_(parts) {}
    std::string_view get(const std::string& path, const SceneJson* entry, ListForm form) override;

  private:
    const PartReader& parts_;
    std::string bytes_;
};

}  // namespace lissom
