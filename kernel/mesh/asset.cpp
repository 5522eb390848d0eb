#include "kernel/mesh/asset.h"

#include <utility>

namespace lissom {

// Here, so that one object file holds the class's virtual table.
Asset::~Asset() = default;

void Asset::count_on(const std::shared_ptr<MemoryAccount>& account) const {
    if (hold_.account()) return;
    MemoryHold next(account, "the contents of a file beside its surface");
    next.resize(memory_bytes());
    hold_ = std::move(next);
}

}  // namespace lissom
