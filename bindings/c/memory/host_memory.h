/// Memory of the process as the host wants it: its allocator, large pages; private to bindings/c.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bindings/c/lissom.h"

namespace lissom::c {

/// An allocator of a host. One that was given stays for ever, as its blocks name it.
struct HostAllocator {
    void* user = nullptr;
    void* (*allocate)(void* user, std::size_t size, std::size_t alignment) = nullptr;
    void (*release)(void* user, void* block, std::size_t size, std::size_t alignment) = nullptr;
    std::size_t min_bytes = 0;

    bool operator==(const HostAllocator&) const = default;
};

/// Stands before each block of a host, and tells it from blocks of the C runtime.
struct BlockHeader {
    std::uint64_t size : 56;
    std::uint64_t allocator : 8;
    std::uint64_t mark;
};

/// Alignment of the blocks that a host is asked for. Its header is half as long, so that a block
/// never begins at a page: the bytes before any pointer that is looked at are there.
constexpr std::size_t kHostAlignment = 2 * sizeof(BlockHeader);

/// Returns the allocator of new blocks of this size, or null for the C runtime's.
const HostAllocator* allocator_for(std::size_t size) noexcept;

/// Returns a block of the host, or null if it has none.
void* take_host_block(const HostAllocator& allocator, std::size_t size) noexcept;

/// Returns the header of a host's block, or null for any other block of this process.
BlockHeader* header_of(void* block) noexcept;

/// Gives a block back to the allocator that made it.
void release_host_block(BlockHeader* header) noexcept;

/// Advises large pages for a new block, if all blocks are to have them.
void advise_pages(void* block, std::size_t size) noexcept;

/// Says that malloc and free of the library come here: a host may give an allocator.
void enable_host_memory() noexcept;

}  // namespace lissom::c
