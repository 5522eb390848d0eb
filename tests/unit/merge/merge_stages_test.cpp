// A merge that is stopped or fails at any step is as it was before.
#include <doctest/doctest.h>

#include <functional>
#include <vector>

#include "kernel/merge/merge.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/merge/thesis_parts.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Mesh cap(Index segments, double up) {
    return cut(make_sphere({.segments = segments}), CutPlane{{0, 0.1 * up, 0}, {0, up, 0}})
        .kept.mesh;
}

struct Pair {
    Mesh source = cap(4, 1.0), target = cap(7, -1.0);

    Merger merge(const MergeOptions& options, const Context& context = {}, long memory = -1) const {
        const Mesh* targets[] = {&target};
        std::vector<Join> joins{Join{boundaries(source)[0], boundaries(target)[0]}};
        allocations_left = memory;
        return Merger(source, targets, std::move(joins), options, context);
    }
};

// Options that lead through every step.
std::vector<MergeOptions> ways() {
    MergeOptions fair, blended, thesis, fixed;
    fair.seam = SeamKind::fair;
    blended.auto_transition = true;
    thesis.thesis = test::thesis();
    if (thesis.thesis) thesis.source_transition = thesis.target_transition = 0.6;
    fixed.configuration = Configuration::fixed;
    fixed.seam = SeamKind::band;
    return {fair, blended, thesis, fixed};
}

// Runs `step` stopped at its n-th report for n = 1, 2, ... until it gets through; returns how often
// it did not.
int stop_everywhere(const std::function<void(const Context&)>& step,
                    const std::function<void()>& after) {
    for (int n = 0;; ++n) {
        const Context* running = nullptr;
        int reports = 0;
        ContextOptions how;
        how.progress = [&](std::string_view, double) {
            if (reports++ == n) running->cancel();
        };
        const Context context(how);
        running = &context;
        try {
            step(context);
            return n;
        } catch (const Error& error) {
            REQUIRE(error.code() == ErrorCode::cancelled);
        }
        after();
    }
}

// Runs `step` with memory for ever more allocations, which it asks for, until it gets through;
// returns how often it did not.
int starve(const std::function<void(long)>& step, const std::function<void()>& after) {
    int failures = 0;
    for (long allowed = 0;; allowed = allowed * 7 / 4 + 1, ++failures) {
        CAPTURE(allowed);
        try {
            step(allowed);
            allocations_left = -1;
            return failures;
        } catch (const Error& error) {
            allocations_left = -1;
            CHECK(error.code() == ErrorCode::memory_limit);
        }
        after();
    }
}

}  // namespace

TEST_CASE("a merge stopped at every report, on every way through it, is as it was") {
    const Pair pair;
    const std::uint64_t before[] = {hash(pair.source), hash(pair.target)};
    for (const MergeOptions& options : ways()) {
        Merger merge = pair.merge(options);
        const std::uint64_t whole = hash(merge.solve().mesh);
        // A state that was spoilt would stay so: it is enough to look now and then.
        int stopped = 0;
        const int solved =
            stop_everywhere([&](const Context& context) { (void)merge.solve(context); },
                            [&] {
                                if (stopped++ % 7 == 0) REQUIRE(hash(merge.solve().mesh) == whole);
                            });
        CHECK(hash(merge.solve().mesh) == whole);
        CHECK(solved > 3);
        const int prepared = stop_everywhere(
            [&](const Context& context) { (void)pair.merge(options, context); }, [] {});
        CHECK(prepared > 3);
    }
    CHECK(hash(pair.source) == before[0]);
    CHECK(hash(pair.target) == before[1]);
}

TEST_CASE("a merge without memory is an error of the kernel, and the same call works later") {
    const Pair pair;
    for (const MergeOptions& options : ways()) {
        Merger merge = pair.merge(options);
        const std::uint64_t whole = hash(merge.solve().mesh);
        const Context context;
        const auto solve = [&](long memory) {
            allocations_left = memory;
            (void)merge.solve(context);
        };
        CHECK(starve(solve, [&] { REQUIRE(hash(merge.solve().mesh) == whole); }) > 10);
        CHECK(starve([&](long memory) { (void)pair.merge(options, context, memory); }, [] {}) > 10);
    }
}
