#include "kernel/scene/shared_blocks.h"

#include <algorithm>
#include <cstring>

namespace lissom {

SharedBlocks::SharedBlocks(std::span<const std::byte> bytes, const SharedBlocks& before,
                           const ContentStore& store)
    : size_(bytes.size()) {
    blocks_.reserve((size_ + kBlockBytes - 1) / kBlockBytes);
    for (std::size_t begin = 0; begin < size_; begin += kBlockBytes) {
        const auto content = bytes.subspan(begin, std::min(kBlockBytes, size_ - begin));
        const std::size_t i = blocks_.size();
        const bool shared =
            i < before.blocks_.size() && before.blocks_[i]->bytes.size() == content.size() &&
            std::memcmp(before.blocks_[i]->bytes.data(), content.data(), content.size()) == 0;
        blocks_.push_back(
            shared ? before.blocks_[i]
                   : std::make_shared<const Block>(store.charge(content.size()), content));
    }
}

void SharedBlocks::copy_to(std::span<std::byte> target) const {
    std::byte* to = target.data();
    for (const auto& block : blocks_) to = std::copy(block->bytes.begin(), block->bytes.end(), to);
}

void SharedBlocks::copy_changes_to(std::span<std::byte> target, const SharedBlocks& present) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        if (blocks_[i] == present.blocks_[i]) continue;
        const auto& bytes = blocks_[i]->bytes;
        std::copy(bytes.begin(), bytes.end(), target.data() + i * kBlockBytes);
    }
}

void SharedBlocks::list_kept(std::vector<const KeptBytes*>& list) const {
    for (const auto& block : blocks_) list.push_back(block.get());
}

}  // namespace lissom
