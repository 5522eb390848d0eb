#include "bindings/c/memory/host_memory.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>

#include "bindings/c/context.h"
#include "kernel/core/large_pages.h"

namespace lissom::c {
namespace {

constexpr std::uint64_t kMark = 0x6c6973736f6d1e5d;
// Blocks from this size on have pages of their own.
constexpr std::size_t kLargeBlock = std::size_t{4} << 20;

// All allocators that were given, and that of new blocks, with how many there are.
struct Allocators {
    std::mutex mutex;
    std::array<HostAllocator, 255> given;
    std::atomic<std::size_t> count{0};
    std::atomic<const HostAllocator*> current{nullptr};
};

constinit Allocators allocators;
bool hooked = false;

std::uint64_t mark_at(const void* block) {
    return kMark ^ reinterpret_cast<std::uintptr_t>(block);
}

// The place of an allocator in the list, to which it is added. Errors: OUT_OF_RANGE.
const HostAllocator* kept(const HostAllocator& allocator) {
    const std::size_t count = allocators.count;
    for (std::size_t i = 0; i < count; ++i) {
        if (allocators.given[i] == allocator) return &allocators.given[i];
    }
    if (count == allocators.given.size()) {
        throw Error(ErrorCode::out_of_range, "a process has at most 255 different allocators");
    }
    allocators.given[count] = allocator;
    allocators.count = count + 1;
    return &allocators.given[count];
}

LargePages pages_of(lissom_large_pages pages) {
    switch (pages) {
        case LISSOM_LARGE_PAGES_AUTOMATIC:
            return LargePages::automatic;
        case LISSOM_LARGE_PAGES_NEVER:
            return LargePages::never;
        case LISSOM_LARGE_PAGES_ALWAYS:
            return LargePages::always;
    }
    throw Error(ErrorCode::invalid_argument, "large_pages is none of lissom_large_pages");
}

void set_memory(const lissom_memory_options& options) {
    require(!options.allocate == !options.release, "allocate and release belong together");
    const LargePages pages = pages_of(options.large_pages);
    if (!hooked && (options.allocate || pages == LargePages::always)) {
        throw Error(ErrorCode::unsupported,
                    "only the shared library on Linux takes an allocator; a program that links the "
                    "static library replaces operator new and malloc by its own");
    }
    const std::lock_guard lock(allocators.mutex);
    allocators.current =
        options.allocate
            ? kept({options.user, options.allocate, options.release, options.min_bytes})
            : nullptr;
    use_large_pages(pages);
}

}  // namespace

const HostAllocator* allocator_for(std::size_t size) noexcept {
    const HostAllocator* const host = allocators.current.load(std::memory_order_acquire);
    return host && size >= host->min_bytes ? host : nullptr;
}

void* take_host_block(const HostAllocator& allocator, std::size_t size) noexcept {
    const std::size_t whole = size + sizeof(BlockHeader);
    if (whole < size || std::uint64_t{size} >> 56 != 0) return nullptr;
    void* const base = allocator.allocate(allocator.user, whole, kHostAlignment);
    if (!base) return nullptr;
    if (reinterpret_cast<std::uintptr_t>(base) % kHostAlignment != 0) {
        allocator.release(allocator.user, base, whole, kHostAlignment);
        return nullptr;
    }
    auto* const header = static_cast<BlockHeader*>(base);
    header->size = size;
    header->allocator = static_cast<std::uint8_t>(&allocator - allocators.given.data());
    header->mark = mark_at(header + 1);
    return header + 1;
}

BlockHeader* header_of(void* block) noexcept {
    if (allocators.count.load(std::memory_order_relaxed) == 0) return nullptr;
    if (reinterpret_cast<std::uintptr_t>(block) % kHostAlignment != sizeof(BlockHeader)) {
        return nullptr;
    }
    auto* const header = static_cast<BlockHeader*>(block) - 1;
    return header->mark == mark_at(block) ? header : nullptr;
}

void release_host_block(BlockHeader* header) noexcept {
    const HostAllocator& allocator = allocators.given[header->allocator];
    header->mark = 0;
    allocator.release(allocator.user, header, header->size + sizeof(BlockHeader), kHostAlignment);
}

void advise_pages(void* block, std::size_t size) noexcept {
    if (size < kLargeBlock || !block || large_pages() != LargePages::always) return;
    prefer_large_pages(block, size);
}

void enable_host_memory() noexcept {
    hooked = true;
}

}  // namespace lissom::c

using namespace lissom::c;

extern "C" {

lissom_memory_options lissom_default_memory_options(void) {
    lissom_memory_options options{};
    options.struct_size = sizeof options;
    return options;
}

lissom_status lissom_set_memory(const lissom_memory_options* options) {
    CallError error;
    error.guard([&] { set_memory(take_options(options, lissom_default_memory_options())); });
    return error.status;
}

}  // extern "C"
