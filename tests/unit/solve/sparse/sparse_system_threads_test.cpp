#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "kernel/solve/sparse/sparse_system.h"
#include "tests/unit/solve/sparse/matrices.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

std::vector<double> solution(const SymmetricMatrix& a, const Context& context = {}) {
    SparseSystem system;
    system.analyze(a, context);
    system.factor(a, context);
    std::vector<double> x(static_cast<std::size_t>(a.size()), 1.0);
    system.solve(x, x, 1);
    return x;
}

// A host whose loops ask for a cancel once they have begun `chunks` chunks.
class CancellingHost {
  public:
    explicit CancellingHost(int chunks) : left_(chunks) {
        ContextOptions options;
        options.parallel_for = [this](std::size_t count,
                                      const std::function<void(std::size_t)>& chunk) {
            for (std::size_t i = 0; i < count; ++i) {
                if (left_-- == 0) context_.cancel();
                chunk(i);
            }
        };
        context_ = Context(options);
    }
    CancellingHost(const CancellingHost&) = delete;
    CancellingHost& operator=(const CancellingHost&) = delete;

    const Context& context() const { return context_; }

  private:
    int left_;
    Context context_;
};

}  // namespace

TEST_CASE("solve: every structure satisfies its system") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        const std::vector<double> x = solution(a);
        std::vector<double> product(x.size());
        a.multiply(x.data(), product.data(), 1);
        double worst = 0.0;
        for (const double v : product) worst = std::max(worst, std::abs(v - 1.0));
        CHECK(worst < 1e-11);
    }
}

TEST_CASE("factor: threads that factor different systems at the same time do not disturb others") {
    constexpr int kThreads = 4, kRounds = 20;
    std::vector<SymmetricMatrix> systems;
    std::vector<std::vector<double>> expected;
    for (int i = 0; i < kThreads; ++i) {
        systems.push_back(
            test::grid(static_cast<Index>(40 + 7 * i), 45, 1, 3U + static_cast<unsigned>(i)));
        expected.push_back(solution(systems.back()));
    }
    for (const int threads : {2, kThreads}) {
        std::atomic<int> wrong{0};
        std::vector<std::thread> running;
        for (int i = 0; i < threads; ++i) {
            running.emplace_back([&, i] {
                const auto k = static_cast<std::size_t>(i);
                for (int round = 0; round < kRounds; ++round) {
                    try {
                        if (solution(systems[k]) != expected[k]) ++wrong;
                    } catch (const Error&) {
                        ++wrong;
                    }
                }
            });
        }
        for (std::thread& thread : running) thread.join();
        CHECK(wrong == 0);
    }
}

TEST_CASE("factor: a cancel at any moment leaves no factor, and a system to factor again") {
    const SymmetricMatrix a = test::grid(110, 90);
    const std::vector<double> expected = solution(a);
    SparseSystem system;
    system.analyze(a);
    int stops = 0;
    for (bool done = false; !done; ++stops) {
        const CancellingHost host(stops);
        try {
            system.factor(a, host.context());
            done = true;
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
            CHECK_FALSE(system.factored());
            CHECK(host.context().memory()->used() == 0);
        }
    }
    CHECK(stops > 8);
    std::vector<double> x(expected.size(), 1.0);
    system.solve(x, x, 1);
    CHECK(x == expected);
}

TEST_CASE("analyze: a cancel at any moment leaves the analysis before") {
    const SymmetricMatrix small = test::grid(3, 3), a = test::grid(220, 220, 2);
    SparseSystem system;
    system.analyze(small);
    const auto cancelled_after = [&](std::chrono::microseconds delay) {
        const Context context;
        if (delay.count() == 0) context.cancel();
        std::thread watch([&] {
            std::this_thread::sleep_for(delay);
            context.cancel();
        });
        bool stopped = false;
        try {
            system.analyze(a, context);
        } catch (const Error& error) {
            stopped = error.code() == ErrorCode::cancelled;
            CHECK(context.memory()->used() == 0);
            CHECK(system.size() == 9);
        }
        watch.join();
        return stopped;
    };
    CHECK(cancelled_after(std::chrono::microseconds(0)));
    int stops = 0;
    for (auto delay = std::chrono::microseconds(200); cancelled_after(delay); delay *= 2) ++stops;
    CHECK(stops > 2);
    CHECK(system.size() == a.size());
}
