// malloc and free of the shared library. The linker puts them in place of the C runtime's (--wrap)
// in all that is inside: the kernel, Eigen, Lua, and the C++ library, whose operator new and delete
// stand on them. A block goes back to where it came from, so that the C runtime's own are freed
// here too.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "bindings/c/memory/host_memory.h"

extern "C" {

// The names that the linker gives to both.
void* system_malloc(std::size_t size) __asm__("__real_malloc");
void* system_calloc(std::size_t count, std::size_t size) __asm__("__real_calloc");
void* system_realloc(void* block, std::size_t size) __asm__("__real_realloc");
void system_free(void* block) __asm__("__real_free");
int begin_static(std::uint64_t* guard) __asm__("__real___cxa_guard_acquire");
void end_static(std::uint64_t* guard) __asm__("__real___cxa_guard_release");
void abort_static(std::uint64_t* guard) __asm__("__real___cxa_guard_abort");

void* lissom_own_malloc(std::size_t size) __asm__("__wrap_malloc");
void* lissom_own_calloc(std::size_t count, std::size_t size) __asm__("__wrap_calloc");
void* lissom_own_realloc(void* block, std::size_t size) __asm__("__wrap_realloc");
void lissom_own_free(void* block) __asm__("__wrap_free");
int lissom_begin_static(std::uint64_t* guard) __asm__("__wrap___cxa_guard_acquire");
void lissom_end_static(std::uint64_t* guard) __asm__("__wrap___cxa_guard_release");
void lissom_abort_static(std::uint64_t* guard) __asm__("__wrap___cxa_guard_abort");

}  // extern "C"

namespace lissom::c {
namespace {

const bool enabled = (enable_host_memory(), true);

// Statics that this thread is making. The process keeps them, longer than a host may keep its
// allocator: they stand in memory of the C runtime.
thread_local int statics = 0;

const HostAllocator* host_for(std::size_t size) {
    const HostAllocator* const host = allocator_for(size);
    return host && statics == 0 ? host : nullptr;
}

// A block of another size with the same content, wherever it now comes from.
void* moved(BlockHeader* header, std::size_t size) {
    void* const block = lissom_own_malloc(size);
    if (!block) return nullptr;
    std::memcpy(block, header + 1, std::min<std::size_t>(size, header->size));
    release_host_block(header);
    return block;
}

}  // namespace
}  // namespace lissom::c

using namespace lissom::c;

extern "C" {

void* lissom_own_malloc(std::size_t size) {
    if (const HostAllocator* const host = host_for(size)) return take_host_block(*host, size);
    void* const block = system_malloc(size);
    advise_pages(block, size);
    return block;
}

void* lissom_own_calloc(std::size_t count, std::size_t size) {
    std::size_t bytes = 0;
    if (__builtin_mul_overflow(count, size, &bytes)) return nullptr;
    const HostAllocator* const host = host_for(bytes);
    void* const block = host ? take_host_block(*host, bytes) : system_calloc(count, size);
    if (host && block) std::memset(block, 0, bytes);
    if (!host) advise_pages(block, bytes);
    return block;
}

void* lissom_own_realloc(void* block, std::size_t size) {
    if (!block) return lissom_own_malloc(size);
    BlockHeader* const header = header_of(block);
    if (!header) {
        void* const longer = system_realloc(block, size);
        advise_pages(longer, size);
        return longer;
    }
    if (size > 0) return moved(header, size);
    release_host_block(header);
    return nullptr;
}

void lissom_own_free(void* block) {
    if (!block) return;
    if (BlockHeader* const header = header_of(block)) return release_host_block(header);
    system_free(block);
}

int lissom_begin_static(std::uint64_t* guard) {
    const int begun = begin_static(guard);
    if (begun) ++statics;
    return begun;
}

void lissom_end_static(std::uint64_t* guard) {
    --statics;
    end_static(guard);
}

void lissom_abort_static(std::uint64_t* guard) {
    --statics;
    abort_static(guard);
}

}  // extern "C"
