/// SharedBlocks: an immutable copy of an array, in blocks that it shares with an earlier copy if
/// both are equal; so a change of an eighth of the array costs an eighth.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/scene/content_store.h"

namespace lissom {

class SharedBlocks {
  public:
    /// Bytes of one block: 4096 positions.
    static constexpr std::size_t kBlockBytes = std::size_t{96} << 10;

    /// No bytes.
    SharedBlocks() = default;
    /// A copy of `bytes`; blocks that equal those of `before`, to the bit, are shared.
    SharedBlocks(std::span<const std::byte> bytes, const SharedBlocks& before,
                 const ContentStore& store);

    std::size_t size() const { return size_; }
    /// Bytes of the list of blocks, without the blocks themselves.
    std::size_t list_bytes() const { return blocks_.size() * sizeof blocks_[0]; }
    /// Writes everything; `target` has `size()` bytes.
    void copy_to(std::span<std::byte> target) const;
    /// Writes the blocks that are not those of `present`, which `target` holds now, and which has
    /// the same size.
    void copy_changes_to(std::span<std::byte> target, const SharedBlocks& present) const;
    void list_kept(std::vector<const KeptBytes*>& list) const;

    /// Whether all blocks are shared.
    bool operator==(const SharedBlocks&) const = default;

  private:
    struct Block : KeptBytes {
        Block(MemoryCharge counted, std::span<const std::byte> content)
            : KeptBytes(std::move(counted)), bytes(content.begin(), content.end()) {}

        std::vector<std::byte> bytes;
    };

    std::size_t size_ = 0;
    std::vector<std::shared_ptr<const Block>> blocks_;
};

/// Returns the bytes of a list of numbers or vectors.
template <typename T>
std::span<const std::byte> byte_view(const std::vector<T>& list) {
    return std::as_bytes(std::span<const T>(list));
}

}  // namespace lissom
