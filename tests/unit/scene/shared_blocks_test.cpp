#include "kernel/scene/shared_blocks.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace lissom;

namespace {

// Three whole blocks and a part of one.
std::vector<double> numbers() {
    std::vector<double> list(3 * SharedBlocks::kBlockBytes / sizeof(double) + 7);
    std::iota(list.begin(), list.end(), 0.0);
    return list;
}

}  // namespace

TEST_CASE("shared blocks: a change costs its block, and everything comes back") {
    const ContentStore store;
    std::vector<double> list = numbers();
    const SharedBlocks first(byte_view(list), {}, store);
    CHECK(store.bytes() == list.size() * sizeof(double));
    const std::vector<double> before = list;
    list[SharedBlocks::kBlockBytes / sizeof(double) + 5] = -1.0;
    const SharedBlocks second(byte_view(list), first, store);
    CHECK(store.bytes() == list.size() * sizeof(double) + SharedBlocks::kBlockBytes);
    CHECK(!(second == first));

    std::vector<double> back(list.size());
    first.copy_to(std::as_writable_bytes(std::span(back)));
    CHECK(back == before);
    second.copy_changes_to(std::as_writable_bytes(std::span(back)), first);
    CHECK(back == list);
}

TEST_CASE("shared blocks: equal bytes share all blocks, -0 and 0 differ") {
    const ContentStore store;
    std::vector<double> list = numbers();
    const SharedBlocks first(byte_view(list), {}, store);
    CHECK(SharedBlocks(byte_view(list), first, store) == first);
    list[0] = -0.0;
    CHECK(!(SharedBlocks(byte_view(list), first, store) == first));
}

TEST_CASE("shared blocks: longer and shorter arrays share the blocks that they have in common") {
    const ContentStore store;
    std::vector<double> list = numbers();
    const SharedBlocks whole(byte_view(list), {}, store);
    const std::size_t bytes = store.bytes();
    list.resize(2 * SharedBlocks::kBlockBytes / sizeof(double));
    const SharedBlocks part(byte_view(list), whole, store);
    CHECK(part.size() == 2 * SharedBlocks::kBlockBytes);
    CHECK(store.bytes() == bytes);
    list.clear();
    CHECK(SharedBlocks(byte_view(list), whole, store) == SharedBlocks());
}
