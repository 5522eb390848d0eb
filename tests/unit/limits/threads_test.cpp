// Several contexts at once, and who does the work of one.
#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/limits/operations.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Those that deform, merge and grow, with their hashes when they run alone.
std::vector<std::pair<const Operation*, std::uint64_t>> long_operations() {
    std::vector<std::pair<const Operation*, std::uint64_t>> list;
    for (const Operation& operation : operations()) {
        const std::string_view name = operation.name;
        if (name == "deform" || name == "merge" || name == "grow hair") {
            list.emplace_back(&operation, operation.run(Context()).hash);
        }
    }
    return list;
}

// Threads of this process; 0 where the system does not tell.
std::size_t thread_count() {
    std::size_t count = 0;
    std::error_code failed;
    for (std::filesystem::directory_iterator at("/proc/self/task", failed), end;
         !failed && at != end; at.increment(failed)) {
        ++count;
    }
    return count;
}

}  // namespace

TEST_CASE("threads: ten contexts on ten threads make what one makes alone") {
    const auto list = long_operations();
    REQUIRE(list.size() == 3);
    std::atomic<int> same{0};
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 10; ++i) {
            threads.emplace_back([&list, &same, i] {
                const Context context;
                for (std::size_t k = 0; k < list.size(); ++k) {
                    const auto& [operation, hash] = list[(k + static_cast<std::size_t>(i)) % 3];
                    if (operation->run(context).hash == hash) ++same;
                }
            });
        }
    }
    CHECK(same == 30);
}

TEST_CASE("threads: the host's loop does all the work that is done in parallel") {
    const std::size_t before = thread_count();
    for (const auto& [operation, hash] : long_operations()) {
        const std::string name = operation->name;
        CAPTURE(name);
        std::size_t loops = 0, chunks = 0, max_threads = 0;
        ContextOptions options;
        options.threads = 8;
        options.parallel_for = [&](std::size_t count,
                                   const std::function<void(std::size_t)>& chunk) {
            ++loops;
            // Backwards: the order must not matter.
            for (std::size_t i = count; i-- > 0;) chunk(i);
            chunks += count;
            max_threads = std::max(max_threads, thread_count());
        };
        CHECK(operation->run(Context(options)).hash == hash);
        CHECK(loops > 0);
        CHECK(chunks > loops);
        CHECK(max_threads == before);
    }
}

TEST_CASE("threads: without a loop of the host's, and one thread, none is started") {
    const std::size_t before = thread_count();
    for (const auto& [operation, hash] : long_operations()) {
        CHECK(operation->run(Context()).hash == hash);
    }
    CHECK(thread_count() == before);
}
