#include "tests/unit/c/allocator/host_heap.h"

#include "tests/unit/c/memory/failing_malloc.h"

namespace lissom::test {
namespace {

// Stands before each block.
struct Before {
    HostHeap* heap;
    std::size_t size, alignment;
};

}  // namespace

lissom_memory_options HostHeap::options(std::size_t min_bytes) {
    lissom_memory_options options = lissom_default_memory_options();
    options.user = this;
    options.allocate = [](void* user, std::size_t size, std::size_t alignment) {
        return static_cast<HostHeap*>(user)->allocate(size, alignment);
    };
    options.release = [](void* user, void* block, std::size_t size, std::size_t alignment) {
        static_cast<HostHeap*>(user)->release(block, size, alignment);
    };
    options.min_bytes = min_bytes;
    return options;
}

void* HostHeap::allocate(std::size_t size, std::size_t alignment) {
    if (left_ >= 0 && left_.fetch_sub(1) == 0) return nullptr;
    if (size < smallest_) smallest_ = size;
    ++live_;
    ++made_;
    bytes_ += size;
    auto* const block = static_cast<char*>(block_aside(alignment, size + alignment));
    *reinterpret_cast<Before*>(block) = {this, size, alignment};
    return block + alignment;
}

void HostHeap::release(void* block, std::size_t size, std::size_t alignment) {
    auto* const before = reinterpret_cast<Before*>(static_cast<char*>(block) - alignment);
    wrong_ += before->heap != this || before->size != size || before->alignment != alignment;
    --live_;
    free_aside(before);
}

}  // namespace lissom::test
