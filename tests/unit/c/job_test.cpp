#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

// A host's job system: a thread a task, held back until `open`.
struct Gate {
    std::mutex mutex;
    std::condition_variable opened;
    bool is_open = false;
    std::atomic<int> tasks{0};

    void open() {
        const std::lock_guard lock(mutex);
        is_open = true;
        opened.notify_all();
    }
    void pass() {
        std::unique_lock lock(mutex);
        opened.wait(lock, [&] { return is_open; });
    }
};

lissom_context_options with_jobs(Gate& gate) {
    auto options = lissom_default_context_options();
    options.user = &gate;
    options.enqueue = [](void* user, void (*task)(void*), void* argument) -> void* {
        auto& own = *static_cast<Gate*>(user);
        ++own.tasks;
        return new std::thread([&own, task, argument] {
            own.pass();
            task(argument);
        });
    };
    options.wait = [](void*, void* task) {
        const std::unique_ptr<std::thread> thread(static_cast<std::thread*>(task));
        thread->join();
    };
    return options;
}

lissom_deformer make_deformer(const Host& host, const Mesh& bar) {
    const lissom_mesh mesh = host.add(bar);
    lissom_region all{}, end{};
    REQUIRE(lissom_region_all(host, mesh, &all) == LISSOM_OK);
    lissom_deformer deformer{};
    REQUIRE(lissom_deformer_create(host, mesh, all, nullptr, &deformer) == LISSOM_OK);
    const auto& ids = bar.find_region("bottom")->vertices();
    const lissom_input list{ids.data(), ids.size(), 0, LISSOM_INT32};
    REQUIRE(lissom_region_of_vertices(host, mesh, &list, &end) == LISSOM_OK);
    std::int32_t handle = -1;
    REQUIRE(lissom_deformer_add_handle(host, deformer, end, nullptr, &handle) == LISSOM_OK);
    return deformer;
}

}  // namespace

TEST_CASE("a job runs on the host's thread; what it works with is busy until it is finished") {
    Gate gate;
    const Host host(with_jobs(gate));
    const lissom_deformer deformer = make_deformer(host, make_bar({}));
    lissom_job job{};
    REQUIRE(lissom_deformer_begin_solve(host, deformer, LISSOM_FULL, &job) == LISSOM_OK);
    lissom_job_state state = LISSOM_JOB_DONE;
    CHECK(lissom_job_poll(host, job, &state) == LISSOM_OK);
    CHECK(state == LISSOM_JOB_RUNNING);
    CHECK(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_BUSY);
    CHECK(lissom_deformer_release(host, deformer) == LISSOM_BUSY);
    // Other objects work meanwhile.
    CHECK(lissom_mesh_vertex_count(host, host.add(make_box({}))) == 8);
    gate.open();
    CHECK(lissom_job_finish(host, job, nullptr) == LISSOM_OK);
    CHECK(gate.tasks == 1);
    CHECK_FALSE(lissom_job_is_valid(host, job));
    CHECK(lissom_job_finish(host, job, nullptr) == LISSOM_INVALID_HANDLE);
    CHECK(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
}

TEST_CASE("a job that is cancelled ends as cancelled, and others go on") {
    Gate gate;
    const Host host(with_jobs(gate));
    const lissom_deformer first = make_deformer(host, make_bar({}));
    const lissom_deformer second = make_deformer(host, make_bar({}));
    lissom_job jobs[2];
    REQUIRE(lissom_deformer_begin_prepare(host, first, &jobs[0]) == LISSOM_OK);
    REQUIRE(lissom_deformer_begin_prepare(host, second, &jobs[1]) == LISSOM_OK);
    CHECK(lissom_job_cancel(host, jobs[0]) == LISSOM_OK);
    gate.open();
    CHECK(lissom_job_finish(host, jobs[0], nullptr) == LISSOM_CANCELLED);
    CHECK(lissom_last_error(host)->status == LISSOM_CANCELLED);
    CHECK(lissom_job_finish(host, jobs[1], nullptr) == LISSOM_OK);
    CHECK(lissom_deformer_prepare(host, first) == LISSOM_OK);
}

TEST_CASE("the error of a job is told when it is finished") {
    const Host host;
    const Mesh bar = make_bar({});
    const lissom_mesh mesh = host.add(bar);
    lissom_region all{};
    REQUIRE(lissom_region_all(host, mesh, &all) == LISSOM_OK);
    lissom_deformer deformer{};
    REQUIRE(lissom_deformer_create(host, mesh, all, nullptr, &deformer) == LISSOM_OK);
    lissom_job job{};
    // Without a job system of the host it runs at once.
    REQUIRE(lissom_deformer_begin_solve(host, deformer, LISSOM_FULL, &job) == LISSOM_OK);
    lissom_job_state state = LISSOM_JOB_RUNNING;
    CHECK(lissom_job_poll(host, job, &state) == LISSOM_OK);
    CHECK(state == LISSOM_JOB_DONE);
    CHECK(lissom_job_finish(host, job, nullptr) == LISSOM_UNCONSTRAINED);
    CHECK(std::string(lissom_last_error(host)->code) == "unconstrained");
}

TEST_CASE("a context that is destroyed cancels its jobs and waits for them") {
    Gate gate;
    gate.open();
    {
        const Host host(with_jobs(gate));
        lissom_job job{};
        const lissom_deformer deformer = make_deformer(host, make_bar({}));
        REQUIRE(lissom_deformer_begin_prepare(host, deformer, &job) == LISSOM_OK);
    }
    CHECK(gate.tasks == 1);
}

TEST_CASE("the host's loop runs chunks, and results do not depend on it") {
    auto options = lissom_default_context_options();
    std::atomic<int> loops{0};
    options.user = &loops;
    options.parallel_for = [](void* user, std::size_t count, void (*chunk)(void*, std::size_t),
                              void* argument) {
        ++*static_cast<std::atomic<int>*>(user);
        for (std::size_t i = count; i-- > 0;) chunk(argument, i);
    };
    const Mesh bar = make_bar({});
    std::vector<Vec3> results[2];
    for (int i = 0; i < 2; ++i) {
        const Host host(i == 0 ? lissom_default_context_options() : options);
        const lissom_deformer deformer = make_deformer(host, bar);
        const double position[] = {1, 2, 3};
        REQUIRE(lissom_deformer_constrain(host, deformer, bar.find_region("top")->vertices()[0],
                                          position, 0.0) == LISSOM_OK);
        REQUIRE(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
        results[i].resize(at(lissom_deformer_row_count(host, deformer)));
        const lissom_output out{results[i].data(), results[i].size(), 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_read_positions(host, deformer, &out) == LISSOM_OK);
    }
    CHECK(loops > 0);
    CHECK(results[0] == results[1]);
}

TEST_CASE("ten contexts on ten threads give what one alone gives") {
    const Mesh bar = make_bar({});
    const auto work = [&] {
        const Host host;
        const lissom_deformer deformer = make_deformer(host, bar);
        const double position[] = {1, 2, 3};
        REQUIRE(lissom_deformer_constrain(host, deformer, bar.find_region("top")->vertices()[0],
                                          position, 0.0) == LISSOM_OK);
        REQUIRE(lissom_deformer_solve(host, deformer, LISSOM_FULL) == LISSOM_OK);
        std::vector<Vec3> rows(at(lissom_deformer_row_count(host, deformer)));
        const lissom_output out{rows.data(), rows.size(), 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_read_positions(host, deformer, &out) == LISSOM_OK);
        return rows;
    };
    const auto alone = work();
    std::vector<std::vector<Vec3>> results(10);
    {
        std::vector<std::jthread> threads;
        for (auto& result : results) threads.emplace_back([&] { result = work(); });
    }
    for (const auto& result : results) CHECK(result == alone);
}

}  // namespace lissom::test
