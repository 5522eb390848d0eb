#include "kernel/core/large_pages.h"

#include <atomic>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lissom {
namespace {

std::atomic<LargePages> used_pages{LargePages::automatic};

}  // namespace

void use_large_pages(LargePages pages) noexcept {
    used_pages = pages;
}

LargePages large_pages() noexcept {
    return used_pages.load(std::memory_order_relaxed);
}

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (large_pages() == LargePages::never) return;
    constexpr std::uintptr_t kLargePage = std::uintptr_t{2} << 20;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t skipped = (kLargePage - begin % kLargePage) % kLargePage;
    if (bytes < skipped + kLargePage) return;
    const std::size_t whole = (bytes - skipped) / kLargePage * kLargePage;
    // If it fails, pages keep their size.
    (void)madvise(static_cast<char*>(memory) + skipped, whole, MADV_HUGEPAGE);
#endif
}

}  // namespace lissom
