#include "viewer/window/session/worker.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <vector>

using namespace lissom::window;

TEST_CASE("worker: jobs are done one after the other, in their order, on one thread") {
    Worker worker;
    std::vector<int> done;
    std::vector<std::thread::id> threads;
    for (int i = 0; i < 1000; ++i) {
        worker.post([&, i] {
            done.push_back(i);
            threads.push_back(std::this_thread::get_id());
        });
    }
    REQUIRE(worker.wait_idle(30.0));
    REQUIRE(done.size() == 1000);
    for (int i = 0; i < 1000; ++i) CHECK(done[i] == i);
    for (const auto& thread : threads) CHECK(thread == threads.front());
    CHECK(threads.front() != std::this_thread::get_id());
}

TEST_CASE("worker: a job instead of others drops those that wait, not the one that runs") {
    Worker worker;
    std::atomic<bool> go{false}, began{false}, ended{false}, dropped{true}, last{false};
    worker.post([&] {
        began = true;
        while (!go) std::this_thread::yield();
        ended = true;
    });
    while (!began) std::this_thread::yield();
    worker.post([&] { dropped = false; });
    worker.post_only([&] { last = true; });
    CHECK(worker.busy());
    CHECK_FALSE(worker.wait_idle(0.01));
    go = true;
    REQUIRE(worker.wait_idle(30.0));
    CHECK(ended);
    CHECK(dropped);
    CHECK(last);
    CHECK_FALSE(worker.busy());
}

TEST_CASE("worker: it ends although jobs wait") {
    std::atomic<int> done{0};
    {
        Worker worker;
        for (int i = 0; i < 100; ++i) {
            worker.post([&] {
                ++done;
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            });
        }
    }
    CHECK(done < 100);
}
