// An allocator of the host: all that the library takes comes from it and returns to it.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "tests/unit/c/allocator/host_heap.h"
#include "tests/unit/c/allocator/work.h"
#include "tests/unit/c/memory/failing_malloc.h"

namespace lissom::test {
namespace {

// Takes the library's memory from a heap, until the scope ends.
class HeapInUse {
  public:
    explicit HeapInUse(HostHeap& heap, std::size_t min_bytes = 0) {
        const lissom_memory_options options = heap.options(min_bytes);
        REQUIRE(lissom_set_memory(&options) == LISSOM_OK);
    }
    ~HeapInUse() { lissom_set_memory(nullptr); }
    HeapInUse(const HeapInUse&) = delete;
    HeapInUse& operator=(const HeapInUse&) = delete;
};

using Work = void(lissom_context*);

struct Share {
    const char* name;
    Work* work;
};

// What a host cannot see: below a fiftieth of all bytes. The work itself takes a few lists.
constexpr double kShare = 0.98;

void check_share(const Share& one) {
    CAPTURE(std::string(one.name));
    HostHeap heap;
    double host = 0.0, others = 0.0;
    {
        const HeapInUse in_use(heap);
        const WorkContext context;
        const long before = allocated_bytes();
        one.work(context);
        others = static_cast<double>(allocated_bytes() - before);
        host = static_cast<double>(heap.bytes());
    }
    if (std::getenv("LISSOM_SHOW_MEMORY")) {
        MESSAGE(std::string(one.name), ": ", heap.made(), " blocks, ", host / 1e6,
                " MB of the host, ", others / 1e6, " MB beside");
    }
    CHECK(host > 1e5);
    CHECK(host / (host + others) > kShare);
    CHECK(heap.live() == 0);
    CHECK(heap.wrong() == 0);
}

// Kilobytes of this process for which large pages were asked for; -1 if the system has none.
long advised_kilobytes() {
    if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled")) return -1;
    std::ifstream maps("/proc/self/smaps");
    long size = 0, advised = 0;
    for (std::string line; std::getline(maps, line);) {
        if (line.rfind("Size:", 0) == 0) size = std::stol(line.substr(5));
        if (line.rfind("VmFlags:", 0) == 0 && line.find(" hg") != line.npos) advised += size;
    }
    return advised;
}

// Those after a deformation. Blocks that were freed keep the advice, and serve the next call.
long advised_by(lissom_large_pages pages) {
    lissom_memory_options options = lissom_default_memory_options();
    options.large_pages = pages;
    REQUIRE(lissom_set_memory(&options) == LISSOM_OK);
    const WorkContext context;
    deform_ball(context, 82, 1);
    lissom_set_memory(nullptr);
    return advised_kilobytes();
}

}  // namespace

TEST_CASE("large pages are asked for as the host wants them") {
    if (advised_kilobytes() < 0) {
        MESSAGE("skipped: this system has no transparent huge pages");
        return;
    }
    CHECK(advised_by(LISSOM_LARGE_PAGES_NEVER) == 0);
    const long automatic = advised_by(LISSOM_LARGE_PAGES_AUTOMATIC);
    CHECK(automatic > 0);
    CHECK(advised_by(LISSOM_LARGE_PAGES_ALWAYS) > automatic);
}

TEST_CASE("all memory of the library is the host's, and comes back once contexts are gone") {
    for (const Share& one : {Share{"deformation", [](lissom_context* c) { deform_ball(c, 24, 3); }},
                             Share{"merge", [](lissom_context* c) { merge_balls(c, 16); }},
                             Share{"hair", [](lissom_context* c) { grow_hair(c, 300); }},
                             Share{"script", [](lissom_context* c) { run_script(c, 20000); }}}) {
        check_share(one);
    }
    HostHeap heap;
    {
        const HeapInUse in_use(heap);
        const WorkContext context;
        code_files(context, 12);
    }
    CHECK(heap.made() > 1000);
    CHECK(heap.live() == 0);
    CHECK(heap.wrong() == 0);
}

TEST_CASE("contexts of several threads share the host's heap, with threads of their own") {
    HostHeap heap;
    {
        const HeapInUse in_use(heap);
        const auto work = [] {
            const WorkContext context(2);
            deform_ball(context, 20, 2);
            grow_hair(context, 50);
        };
        std::thread first(work), second(work);
        first.join();
        second.join();
    }
    CHECK(heap.made() > 1000);
    CHECK(heap.live() == 0);
    CHECK(heap.wrong() == 0);
}

TEST_CASE("each block goes back to the heap that made it, whichever is set then") {
    HostHeap first, second;
    const long before = live_blocks();
    {
        const WorkContext early;
        merge_balls(early, 4);
        const lissom_mesh old = shape(early, "shapes.sphere", "[]");
        {
            const HeapInUse in_use(first);
            const WorkContext context;
            deform_ball(context, 10, 2);
            run_script(early, 100);
            {
                const HeapInUse now(second);
                deform_ball(context, 10, 2);
                run_script(context, 100);
                std::uint64_t moved = 0;
                CHECK(lissom_move(early, old.id, context, &moved) == LISSOM_OK);
                const lissom_mesh mine = shape(context, "shapes.sphere", "[]");
                CHECK(lissom_move(context, mine.id, early, &moved) == LISSOM_OK);
            }
            // The C runtime's from here on: both heaps still have blocks.
            CHECK(first.live() > 0);
            CHECK(second.live() > 0);
        }
        merge_balls(early, 4);
    }
    for (const HostHeap* heap : {&first, &second}) {
        CHECK(heap->made() > 100);
        CHECK(heap->live() == 0);
        CHECK(heap->wrong() == 0);
    }
    CHECK(live_blocks() - before < 40);
}

TEST_CASE("small blocks stay with the C runtime if the host wants large ones alone") {
    HostHeap heap;
    {
        const HeapInUse in_use(heap, 4096);
        const WorkContext context;
        deform_ball(context, 16, 2);
        run_script(context, 1000);
    }
    CHECK(heap.made() > 10);
    CHECK(heap.smallest() >= 4096);
    CHECK(heap.live() == 0);
    CHECK(heap.wrong() == 0);
}

TEST_CASE("a heap of the host without memory is a status, and the next call works") {
    HostHeap heap;
    const HeapInUse in_use(heap);
    const WorkContext context;
    const double origin[] = {0, 0.1, 0}, normal[] = {0, 1, 0};
    const lissom_mesh ball = shape(context, "shapes.sphere", "[{\"segments\": 4}]");
    lissom_mesh half{};
    const auto cut = [&] {
        return lissom_cut_by_plane(context, ball, origin, normal, nullptr, &half, nullptr);
    };
    REQUIRE(cut() == LISSOM_OK);
    REQUIRE(lissom_mesh_release(context, half) == LISSOM_OK);
    const long live = heap.live();
    int refused = 0;
    for (int n = 0; n < 400; ++n) {
        CAPTURE(n);
        heap.fail_at(n);
        const lissom_status status = cut();
        heap.fail_at(-1);
        refused += status == LISSOM_MEMORY_LIMIT;
        CHECK((status == LISSOM_OK || status == LISSOM_MEMORY_LIMIT));
        if (status == LISSOM_OK) CHECK(lissom_mesh_release(context, half) == LISSOM_OK);
        // The error has a text and a few numbers.
        CHECK(heap.live() <= live + 4);
    }
    CHECK(refused > 100);
    CHECK(cut() == LISSOM_OK);
}

TEST_CASE("unusable memory options are refused, and change nothing") {
    HostHeap heap;
    const HeapInUse in_use(heap);
    lissom_memory_options options = heap.options();
    options.release = nullptr;
    CHECK(lissom_set_memory(&options) == LISSOM_INVALID_ARGUMENT);
    options = lissom_default_memory_options();
    options.large_pages = static_cast<lissom_large_pages>(7);
    CHECK(lissom_set_memory(&options) == LISSOM_INVALID_ARGUMENT);
    options = {};
    CHECK(lissom_set_memory(&options) == LISSOM_BAD_STRUCT);
    const WorkContext context;
    CHECK(heap.live() > 0);
}

TEST_CASE("a process has at most 255 different allocators, and the same one again is none") {
    static HostHeap heaps[300];
    int accepted = 0;
    for (HostHeap& heap : heaps) {
        const lissom_memory_options options = heap.options();
        const lissom_status status = lissom_set_memory(&options);
        accepted += status == LISSOM_OK;
        CHECK((status == LISSOM_OK || status == LISSOM_OUT_OF_RANGE));
    }
    CHECK(accepted > 200);
    CHECK(accepted < 256);
    const lissom_memory_options again = heaps[0].options();
    for (int i = 0; i < 300; ++i) CHECK(lissom_set_memory(&again) == LISSOM_OK);
    lissom_set_memory(nullptr);
}

}  // namespace lissom::test
