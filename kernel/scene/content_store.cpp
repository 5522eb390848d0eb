#include "kernel/scene/content_store.h"

#include <algorithm>

namespace lissom {

// Looks through all entries only when there are twice as many as were alive the last time.
void ContentStore::forget_dead() {
    if (kept_.size() < forget_at_) return;
    std::erase_if(kept_, [](const auto& entry) { return entry.second.expired(); });
    forget_at_ = std::max<std::size_t>(64, 2 * kept_.size());
}

std::size_t bytes_of(std::vector<const KeptBytes*> list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    std::size_t bytes = 0;
    for (const KeptBytes* kept : list) bytes += kept->charge.bytes();
    return bytes;
}

}  // namespace lissom
