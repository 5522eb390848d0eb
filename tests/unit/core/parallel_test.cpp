#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

using Chunks = std::vector<std::pair<Index, Index>>;

Chunks chunks_of(const Context& context, Index begin, Index end, Index grain) {
    Chunks chunks;
    std::mutex mutex;
    context.parallel_for(begin, end, grain, [&](Index from, Index to) {
        const std::lock_guard lock(mutex);
        chunks.emplace_back(from, to);
    });
    std::sort(chunks.begin(), chunks.end());
    return chunks;
}

Context with_threads(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

// A host that runs the chunks from last to first.
Context with_backward_host() {
    ContextOptions options;
    options.parallel_for = [](std::size_t count, const std::function<void(std::size_t)>& chunk) {
        for (std::size_t i = count; i > 0; --i) chunk(i - 1);
    };
    return Context(options);
}

double sum_of_chunk_sums(const Context& context, const std::vector<double>& values) {
    const Index grain = 97, count = static_cast<Index>(values.size());
    std::vector<double> sums(static_cast<std::size_t>((count + grain - 1) / grain), 0.0);
    context.parallel_for(0, count, grain, [&](Index from, Index to) {
        for (Index i = from; i < to; ++i) sums[from / grain] += values[i];
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

TEST_CASE("chunks are the same for one thread, several threads and a host's loop") {
    const Chunks serial = chunks_of(Context(), 3, 1003, 64);
    CHECK(serial.front() == std::pair<Index, Index>{3, 67});
    CHECK(serial.back() == std::pair<Index, Index>{963, 1003});
    CHECK(serial.size() == 16);
    CHECK(chunks_of(with_threads(4), 3, 1003, 64) == serial);
    CHECK(chunks_of(with_backward_host(), 3, 1003, 64) == serial);
}

TEST_CASE("sums kept per chunk are the same to the bit") {
    std::vector<double> values;
    for (int i = 0; i < 10000; ++i) values.push_back(1.0 / (i + 1) * (i % 2 ? -1e6 : 1e6));
    const double serial = sum_of_chunk_sums(Context(), values);
    CHECK(sum_of_chunk_sums(with_threads(2), values) == serial);
    CHECK(sum_of_chunk_sums(with_threads(7), values) == serial);
    CHECK(sum_of_chunk_sums(with_backward_host(), values) == serial);
}

TEST_CASE("an empty range runs nothing and a grain below 1 counts as 1") {
    CHECK(chunks_of(Context(), 5, 5, 8).empty());
    CHECK(chunks_of(Context(), 5, 3, 8).empty());
    CHECK(chunks_of(Context(), 0, 3, 0).size() == 3);
}

TEST_CASE("ranges near the end of Index do not overflow") {
    const Index last = std::numeric_limits<Index>::max();
    const Chunks chunks = chunks_of(Context(), last - 10, last, last);
    REQUIRE(chunks.size() == 1);
    CHECK(chunks[0] == std::pair<Index, Index>{last - 10, last});
}

TEST_CASE("the exception of the first chunk is the one that is seen") {
    for (const Context& context : {Context(), with_threads(4), with_backward_host()}) {
        std::string seen;
        try {
            context.parallel_for(0, 100, 1, [](Index from, Index) {
                if (from >= 20) throw std::runtime_error("chunk " + std::to_string(from));
            });
        } catch (const std::runtime_error& error) {
            seen = error.what();
        }
        CHECK(seen == "chunk 20");
    }
}

TEST_CASE("a cancel inside a loop ends it with the error") {
    for (const Context& context : {Context(), with_threads(4), with_backward_host()}) {
        std::atomic<int> ran{0};
        const auto loop = [&] {
            context.parallel_for(0, 1000, 1, [&](Index, Index) {
                if (++ran == 10) context.cancel();
            });
        };
        CHECK(test::error_of(loop).code() == ErrorCode::cancelled);
        CHECK(ran < 1000);
        context.clear_cancel();
    }
}

TEST_CASE("loops may be nested") {
    const Context context = with_threads(3);
    std::atomic<int> count{0};
    context.parallel_for(0, 8, 1, [&](Index, Index) {
        context.parallel_for(0, 8, 1, [&](Index, Index) { ++count; });
    });
    CHECK(count == 64);
}
