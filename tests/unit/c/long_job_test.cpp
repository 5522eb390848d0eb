// Every call that takes long, as a job.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"
#include "tests/unit/c/world.h"

namespace lissom::test {
namespace {

// A job system: a thread a task, held back while it is shut.
struct Threads {
    std::mutex mutex;
    std::condition_variable changed;
    bool shut = false;

    void set_shut(bool now) {
        const std::lock_guard lock(mutex);
        shut = now;
        changed.notify_all();
    }
    void pass() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return !shut; });
    }
};

lissom_context_options on_threads(Threads& threads) {
    auto options = lissom_default_context_options();
    options.user = &threads;
    options.enqueue = [](void* user, void (*task)(void*), void* argument) -> void* {
        auto& own = *static_cast<Threads*>(user);
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

std::string temporary(const char* name) {
    return (std::filesystem::temp_directory_path() /
            (std::string("lissom_jobs_") +
             std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id())) + name))
        .string();
}

struct JobCase {
    const char* name;
    std::function<lissom_status(World&, lissom_job*)> begin;
};

const double kMiddle[] = {0, 0.13, 0}, kUp[] = {0, 1, 0};
const float kTriangle[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::uint8_t kCorners[] = {0, 1, 2};

std::vector<JobCase> all_jobs() {
    std::vector<JobCase> all{
        {"create",
         [](World& world, lissom_job* job) {
             lissom_buffer buffer = lissom_default_buffer();
             buffer.positions = {kTriangle, 3, 0, LISSOM_FLOAT32};
             buffer.corners = {kCorners, 3, 0, LISSOM_UINT8};
             return lissom_mesh_begin_create(world, &buffer, job);
         }},
        {"save",
         [](World& world, lissom_job* job) {
             return lissom_mesh_begin_save(world, world.bar, temporary(".ply").c_str(), nullptr,
                                           job);
         }},
        {"load",
         [](World& world, lissom_job* job) {
             const std::string path = temporary(".obj");
             std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
             return lissom_mesh_begin_load(world, path.c_str(), nullptr, job);
         }},
        {"cut",
         [](World& world, lissom_job* job) {
             return lissom_cut_begin_by_plane(world, world.bar, kMiddle, kUp, nullptr, job);
         }},
        {"merge",
         [](World& world, lissom_job* job) {
             return lissom_begin_merge(world, world.half, world.other_half, nullptr, 0, nullptr,
                                       job);
         }},
        {"merger",
         [](World& world, lissom_job* job) {
             return lissom_merger_begin_solve(world, world.merger, job);
         }},
        {"paste",
         [](World& world, lissom_job* job) {
             auto placement = lissom_default_placement();
             placement.at[0] = 2.0;
             return lissom_paste_begin_create(world, world.bump, world.ball, world.bump_region, {0},
                                              {0}, &placement, job);
         }},
        {"optimize",
         [](World& world, lissom_job* job) {
             return lissom_paste_begin_optimize(world, world.paste, 1, job);
         }},
        {"paste merge",
         [](World& world, lissom_job* job) {
             return lissom_paste_begin_merge(world, world.paste, job);
         }},
        {"erase",
         [](World& world, lissom_job* job) {
             return lissom_begin_erase(world, world.bump, world.bump_region, job);
         }},
        {"solve",
         [](World& world, lissom_job* job) {
             return lissom_deformer_begin_solve(world, world.deformer, LISSOM_FULL, job);
         }},
        {"strands",
         [](World& world, lissom_job* job) {
             return lissom_strands_begin_save(world, world.strands, temporary(".hair").c_str(),
                                              job);
         }},
    };
    if (!lissom_has_scripts()) return all;
    all.push_back({"script", [](World& world, lissom_job* job) {
                       return lissom_script_begin_run(world, world.script, "[3]", job);
                   }});
    all.push_back({"call", [](World& world, lissom_job* job) {
                       return lissom_begin_call(world, "shapes.sphere", "[]", job);
                   }});
    return all;
}

void prepare(World& world) {
    world.make_deformer();
    world.make_halves();
    world.make_paste();
    world.make_strands();
    if (!lissom_has_scripts()) return;
    const std::string text =
        "local lissom = require('lissom')\nlocal box = lissom.shapes.box()\nreturn box, ...";
    REQUIRE(lissom_script_load(world, text.data(), text.size(), "job.lua", &world.script) ==
            LISSOM_OK);
}

// Releases the objects that a job made.
void drop(World& world, const std::uint64_t objects[2]) {
    for (int i = 0; i < 2; ++i) {
        lissom_mesh_release(world, {objects[i]});
        lissom_paste_release(world, {objects[i]});
        lissom_render_map_release(world, {objects[i]});
        lissom_strands_release(world, {objects[i]});
    }
}

}  // namespace

TEST_CASE("every job ends as its call does, and can be cancelled or lost at any time") {
    Threads threads;
    std::mt19937 random(5);
    for (int round = 0; round < 3; ++round) {
        World world(on_threads(threads));
        prepare(world);
        const auto objects = lissom_object_count(world);
        for (const JobCase& one : all_jobs()) {
            CAPTURE(std::string(one.name));
            CAPTURE(round);
            lissom_job job{};
            threads.set_shut(round != 0);
            const lissom_status begun = one.begin(world, &job);
            REQUIRE_MESSAGE(begun == LISSOM_OK, std::string(lissom_last_error(world)->message));
            double fraction = -1.0;
            char label[8] = "xxxxxxx";
            CHECK(lissom_job_progress(world, job, &fraction, label, sizeof label) == LISSOM_OK);
            CHECK(fraction >= 0.0);
            CHECK(std::strlen(label) < sizeof label);
            if (round == 1) CHECK(lissom_job_cancel(world, job) == LISSOM_OK);
            threads.set_shut(false);
            if (round == 2) {
                std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
                lissom_job_cancel(world, job);
            }
            lissom_job_outcome outcome = lissom_default_job_outcome();
            const lissom_status status = lissom_job_finish_with(world, job, &outcome);
            const std::string text = lissom_last_error(world)->message;
            if (round == 0) CHECK_MESSAGE(status == LISSOM_OK, text);
            if (round == 1) CHECK_MESSAGE(status == LISSOM_CANCELLED, text);
            if (round == 2) CHECK((status == LISSOM_OK || status == LISSOM_CANCELLED));
            if (outcome.json.size > 0) {
                const std::string json(static_cast<const char*>(outcome.json.data),
                                       outcome.json.size);
                const std::size_t place = json.find("{\"object\":");
                REQUIRE(place != std::string::npos);
                outcome.objects[0] = std::stoull(json.substr(place + 10));
            }
            drop(world, outcome.objects);
            CHECK(lissom_object_count(world) == objects);
        }
    }
}

TEST_CASE("a context may be destroyed while any job runs") {
    for (const JobCase& one : all_jobs()) {
        CAPTURE(std::string(one.name));
        Threads threads;
        World world(on_threads(threads));
        prepare(world);
        lissom_job job{};
        REQUIRE(one.begin(world, &job) == LISSOM_OK);
    }
}

TEST_CASE("a job gives what its call gives: both parts, a report, results of scripts") {
    Threads threads;
    World world(on_threads(threads));
    prepare(world);
    lissom_mesh kept{}, rest{}, merged{};
    REQUIRE(lissom_cut_by_plane(world, world.bar, kMiddle, kUp, nullptr, &kept, &rest) ==
            LISSOM_OK);
    auto report = lissom_default_merge_report(), told = lissom_default_merge_report();
    REQUIRE(lissom_merge(world, world.half, world.other_half, nullptr, 0, nullptr, &merged,
                         &report) == LISSOM_OK);
    const std::string verdict = report.verdict;
    const auto hash_of = [&](std::uint64_t id) {
        std::uint64_t hash = 0;
        REQUIRE(lissom_mesh_hash(world, {id}, &hash) == LISSOM_OK);
        return hash;
    };
    lissom_job job{};
    lissom_job_outcome outcome = lissom_default_job_outcome();
    REQUIRE(lissom_cut_begin_by_plane(world, world.bar, kMiddle, kUp, nullptr, &job) == LISSOM_OK);
    REQUIRE(lissom_job_finish_with(world, job, &outcome) == LISSOM_OK);
    CHECK(hash_of(outcome.objects[0]) == hash_of(kept.id));
    CHECK(hash_of(outcome.objects[1]) == hash_of(rest.id));
    REQUIRE(lissom_begin_merge(world, world.half, world.other_half, nullptr, 0, nullptr, &job) ==
            LISSOM_OK);
    outcome.report = &told;
    REQUIRE(lissom_job_finish_with(world, job, &outcome) == LISSOM_OK);
    CHECK(hash_of(outcome.objects[0]) == hash_of(merged.id));
    CHECK(told.ok == report.ok);
    CHECK(told.max_dihedral == report.max_dihedral);
    CHECK(std::string(told.verdict) == verdict);
    std::int32_t origins[10000];
    const lissom_output out{origins, 10000, 0, LISSOM_INT32};
    CHECK(lissom_mesh_read_vertex_origins(world, {outcome.objects[0]}, &out, nullptr) == LISSOM_OK);
    outcome = lissom_default_job_outcome();
    outcome.struct_size = 0;
    CHECK(lissom_job_finish_with(world, job, &outcome) == LISSOM_BAD_STRUCT);
    if (!lissom_has_scripts()) return;
    outcome = lissom_default_job_outcome();
    REQUIRE(lissom_script_begin_run(world, world.script, "[3]", &job) == LISSOM_OK);
    REQUIRE(lissom_job_finish_with(world, job, &outcome) == LISSOM_OK);
    const std::string json(static_cast<const char*>(outcome.json.data), outcome.json.size);
    CHECK(json.find("lissom.Mesh") != std::string::npos);
    CHECK(json.ends_with(",3]"));
}

TEST_CASE("the last frame can be read while a job makes the next") {
    Threads threads;
    World world(on_threads(threads));
    prepare(world);
    REQUIRE(lissom_deformer_solve(world, world.deformer, LISSOM_FULL) == LISSOM_OK);
    const auto rows = [&] {
        std::vector<Vec3> list(at(lissom_deformer_row_count(world, world.deformer)));
        const lissom_output out{list.data(), list.size(), 0, LISSOM_FLOAT64};
        REQUIRE(lissom_deformer_read_positions(world, world.deformer, &out) == LISSOM_OK);
        REQUIRE(lissom_deformer_read_normals(world, world.deformer, &out) == LISSOM_OK);
        REQUIRE(lissom_deformer_read_positions(world, world.deformer, &out) == LISSOM_OK);
        return list;
    };
    const std::vector<Vec3> before = rows();
    const lissom_transform lift{{1, 0, 0, 0, 0, 1, 0, 1.5, 0, 0, 1, 0}};
    REQUIRE(lissom_deformer_set_transform(world, world.deformer, world.handle, &lift) == LISSOM_OK);
    threads.set_shut(true);
    lissom_job job{};
    REQUIRE(lissom_deformer_begin_solve(world, world.deformer, LISSOM_FULL, &job) == LISSOM_OK);
    CHECK(rows() == before);
    threads.set_shut(false);
    for (int i = 0; i < 20; ++i) CHECK(rows() == before);
    REQUIRE(lissom_job_finish(world, job, nullptr) == LISSOM_OK);
    CHECK(rows() != before);
}

TEST_CASE("a job of a script leaves the host its meshes to read, and refuses what it works with") {
    if (!lissom_has_scripts()) return;
    Threads threads;
    World world(on_threads(threads));
    prepare(world);
    const std::string mesh =
        "[{\"object\":" + std::to_string(world.bar.id) + "}, {\"iterations\": 2}]";
    std::uint64_t before = 0, now = 0;
    REQUIRE(lissom_mesh_hash(world, world.bar, &before) == LISSOM_OK);
    threads.set_shut(true);
    lissom_job job{}, second{};
    REQUIRE_MESSAGE(lissom_begin_call(world, "Mesh.smooth", mesh.c_str(), &job) == LISSOM_OK,
                    std::string(lissom_last_error(world)->message));
    CHECK(lissom_begin_call(world, "Mesh.smooth", mesh.c_str(), &second) == LISSOM_BUSY);
    CHECK(lissom_call(world, "shapes.box", "[]", nullptr) == LISSOM_BUSY);
    CHECK(lissom_script_run(world, world.script, nullptr, nullptr) == LISSOM_BUSY);
    CHECK(lissom_mesh_release(world, world.bar) == LISSOM_BUSY);
    const lissom_transform same = lissom_identity();
    CHECK(lissom_mesh_transform(world, world.bar, &same) == LISSOM_BUSY);
    // Objects that scripts do not know are free.
    CHECK(lissom_mesh_transform(world, world.half, &same) == LISSOM_OK);
    REQUIRE(lissom_mesh_hash(world, world.bar, &now) == LISSOM_OK);
    CHECK(now == before);
    threads.set_shut(false);
    REQUIRE_MESSAGE(lissom_job_finish(world, job, nullptr) == LISSOM_OK,
                    std::string(lissom_last_error(world)->message));
    REQUIRE(lissom_mesh_hash(world, world.bar, &now) == LISSOM_OK);
    CHECK(now != before);
    CHECK(lissom_call(world, "shapes.box", "[]", nullptr) == LISSOM_OK);
}

TEST_CASE("a script that never ends is a job that can be cancelled") {
    if (!lissom_has_scripts()) return;
    Threads threads;
    World world(on_threads(threads));
    prepare(world);
    for (const bool by_context : {false, true}) {
        const std::string text = "while true do pcall(function() while true do end end) end";
        lissom_script script{};
        REQUIRE(lissom_script_load(world, text.data(), text.size(), "loop", &script) == LISSOM_OK);
        lissom_job job{};
        REQUIRE(lissom_script_begin_run(world, script, nullptr, &job) == LISSOM_OK);
        lissom_job_state state = LISSOM_JOB_DONE;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        CHECK(lissom_job_poll(world, job, &state) == LISSOM_OK);
        CHECK(state == LISSOM_JOB_RUNNING);
        if (by_context) {
            lissom_cancel(world);
        } else {
            CHECK(lissom_job_cancel(world, job) == LISSOM_OK);
        }
        CHECK(lissom_job_finish(world, job, nullptr) == LISSOM_CANCELLED);
        lissom_clear_cancel(world);
        CHECK(lissom_call(world, "shapes.box", "[]", nullptr) == LISSOM_OK);
        CHECK(lissom_script_release(world, script) == LISSOM_OK);
    }
}

TEST_CASE("meshes and strands move between contexts, other objects say why not") {
    World world, other;
    prepare(world);
    world.make_map();
    REQUIRE(lissom_mesh_set_region(world, world.bar, "top", world.top) == LISSOM_OK);
    std::uint64_t before = 0, now = 0, moved = 0;
    REQUIRE(lissom_mesh_hash(world, world.bar, &before) == LISSOM_OK);
    const auto used = lissom_memory_used(other), objects = lissom_object_count(other);
    lissom_mesh copy{};
    REQUIRE(lissom_mesh_copy(world, world.bar, &copy) == LISSOM_OK);
    const auto held = lissom_memory_used(world);
    REQUIRE(lissom_move(world, copy.id, other, &moved) == LISSOM_OK);
    CHECK_FALSE(lissom_mesh_is_valid(world, copy));
    REQUIRE(lissom_mesh_hash(other, {moved}, &now) == LISSOM_OK);
    CHECK(now == before);
    CHECK(lissom_memory_used(other) > used);
    CHECK(lissom_memory_used(world) < held);
    lissom_region region{};
    CHECK(lissom_region_named(other, {moved}, "top", &region) == LISSOM_OK);
    CHECK(lissom_region_release(other, region) == LISSOM_OK);
    CHECK(lissom_mesh_release(other, {moved}) == LISSOM_OK);
    CHECK(lissom_object_count(other) == objects);
    CHECK(lissom_memory_used(other) == used);
    for (const std::uint64_t id : {world.top.id, world.deformer.id, world.merger.id, world.paste.id,
                                   world.map.id, world.script.id}) {
        if (id == 0) continue;
        moved = 77;
        CHECK(lissom_move(world, id, other, &moved) == LISSOM_UNSUPPORTED);
        CHECK(std::string(lissom_last_error(world)->message).size() > 20);
        CHECK(moved == 77);
    }
    CHECK(lissom_move(world, 12345, other, &moved) == LISSOM_INVALID_HANDLE);
    CHECK(lissom_move(world, world.bar.id, nullptr, &moved) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_move(world, world.bar.id, world, &moved) == LISSOM_INVALID_ARGUMENT);
    const std::int32_t points = lissom_strands_point_count(world, world.strands);
    REQUIRE(lissom_move(world, world.strands.id, other, &moved) == LISSOM_OK);
    CHECK(lissom_strands_point_count(other, {moved}) == points);
    CHECK_FALSE(lissom_strands_is_valid(world, world.strands));
    world.strands = {};
}

}  // namespace lissom::test
