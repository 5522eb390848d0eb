#include "tests/unit/c/memory/failing_malloc.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

// The functions of glibc that malloc and its kin stand for.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

constexpr long kNever = -1;
std::atomic<long> left{kNever}, live{0}, made{0}, bytes{0};
std::atomic<bool> fails_on{false}, has_failed{false};

// Whether this allocation of so many bytes fails.
bool fails(std::size_t size) {
    made.fetch_add(1, std::memory_order_relaxed);
    bytes.fetch_add(static_cast<long>(size), std::memory_order_relaxed);
    if (left.load(std::memory_order_relaxed) == kNever) return false;
    const long before = left.fetch_sub(1);
    if (before > 0) return false;
    if (before == 0) has_failed = true;
    if (fails_on.load()) {
        left = 0;
    } else {
        left = kNever;
    }
    return before == 0;
}

void* counted(void* block) {
    if (block) live.fetch_add(1, std::memory_order_relaxed);
    return block;
}

void* no_memory() {
    errno = ENOMEM;
    return nullptr;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
    return fails(size) ? no_memory() : counted(__libc_malloc(size));
}

void* calloc(std::size_t count, std::size_t size) {
    return fails(count * size) ? no_memory() : counted(__libc_calloc(count, size));
}

void* realloc(void* block, std::size_t size) {
    if (fails(size)) return no_memory();
    if (!block) return counted(__libc_realloc(nullptr, size));
    void* moved = __libc_realloc(block, size);
    if (!moved && size == 0) live.fetch_sub(1, std::memory_order_relaxed);
    return moved;
}

void* memalign(std::size_t alignment, std::size_t size) {
    return fails(size) ? no_memory() : counted(__libc_memalign(alignment, size));
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
    void* made = memalign(alignment, size);
    if (!made) return ENOMEM;
    *block = made;
    return 0;
}

void free(void* block) {
    if (block) live.fetch_sub(1, std::memory_order_relaxed);
    __libc_free(block);
}

}  // extern "C"

namespace lissom::test {

void fail_at(long n, bool all) {
    has_failed = false;
    fails_on = all;
    left = n;
}

bool stop_failing() {
    left = kNever;
    return has_failed;
}

long allocations() {
    return made;
}

long live_blocks() {
    return live;
}

long allocated_bytes() {
    return bytes;
}

void* block_aside(std::size_t alignment, std::size_t size) {
    return __libc_memalign(alignment, size);
}

void free_aside(void* block) {
    __libc_free(block);
}

}  // namespace lissom::test
