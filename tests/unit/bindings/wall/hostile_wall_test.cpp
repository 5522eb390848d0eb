// The second wall alone: every hostile script in a sandbox without any limit, which the system
// encloses.
#include <doctest/doctest.h>

#ifdef __linux__

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/wall/wall.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "tests/unit/bindings/sandbox/hostile_scripts.h"

namespace lissom::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Scripts = std::vector<test::HostileScript>;

// Exit statuses of a script that has ended by itself.
constexpr int kWell = 0, kFailed = 3;
// Scripts that run at a time: most of them only wait for the end of their time.
constexpr std::size_t kProcesses = 8;

WallRights little() {
    WallRights rights;
    rights.seconds = 0.05;
    rights.memory_bytes = std::size_t{16} << 20;
    rights.output_bytes = 100'000;
    return rights;
}

// The first wall is off: nothing is counted, and no time ends it.
int run_without_limits(const std::string& text) {
    lua::SandboxLimits none;
    none.seconds = 0.0;
    none.memory_bytes = none.output_bytes = 0;
    lua::Sandbox sandbox(none, {}, [](std::string_view line) {
        if (write(STDERR_FILENO, line.data(), line.size()) < 0) std::_Exit(kFailed);
    });
    lua_State* L = sandbox.lua();
    if (luaL_loadbufferx(L, text.data(), text.size(), "=script", "t") != LUA_OK) return kFailed;
    return sandbox.call(0, 1) == LUA_OK ? kWell : kFailed;
}

bool has_limit_end(const WallEnd& end) {
    const char* const codes[] = {"sandbox_time", "sandbox_memory", "sandbox_output", "sandbox_cpu"};
    const bool known = std::count(std::begin(codes), std::end(codes), end.code) == 1;
    return known && end.status == 1 && end.message.find("at its limit of") != std::string::npos;
}

bool has_own_end(const WallEnd& end, test::HostileEnd expected) {
    if (!end.code.empty()) return false;
    if (expected == test::HostileEnd::harmless) return end.status == kWell;
    return end.status == kWell || end.status == kFailed;
}

// Harmless scripts end by themselves; those that only time ends, at a limit; the others so or so,
// for nothing counts their work but the system.
bool ends_rightly(const test::HostileScript& script, const WallEnd& end) {
    switch (script.end) {
        case test::HostileEnd::time:
            return has_limit_end(end);
        case test::HostileEnd::harmless:
            return has_own_end(end, script.end);
        case test::HostileEnd::error:
        case test::HostileEnd::any:
            break;
    }
    return has_limit_end(end) || has_own_end(end, script.end);
}

// Runs in a process of its own.
bool is_contained(const test::HostileScript& script) {
    const auto start = Clock::now();
    const std::optional<WallEnd> end = go_behind_wall(little());
    if (!end) std::_Exit(run_without_limits(script.text));
    const std::chrono::duration<double> time = Clock::now() - start;
    const bool right = ends_rightly(script, *end) && time.count() < 20.0;
    if (!right) {
        std::fprintf(stderr, "%s: status %d, %s %s, %.1f s\n%s\n", script.name.c_str(), end->status,
                     end->code.c_str(), end->message.c_str(), time.count(), script.text.c_str());
    }
    return right;
}

// Runs each `kProcesses`-th script; the exit status is the number of those that were not contained.
pid_t start_worker(const Scripts& scripts, std::size_t first) {
    const pid_t worker = fork();
    if (worker != 0) return worker;
    int failed = 0;
    for (std::size_t i = first; i < scripts.size(); i += kProcesses) {
        failed += is_contained(scripts[i]) ? 0 : 1;
    }
    std::_Exit(std::min(failed, 100));
}

// Lua's own C code works for minutes where it calls no hook and asks for no memory: the first wall
// does not end them at all.
Scripts scripts_between_hooks() {
    return {
        {"numbers that all collide once their table grows",
         "local t, k = {}, 20 local step = (1 << (k + 1)) - 1 "
         "for m = 1, (1 << k) + 1 do t[m * step] = 1 end",
         test::HostileEnd::time},
        {"a chain through a table with weak keys",
         "local n, keys = 400000, {} for i = 1, n do keys[i] = {} end "
         "local w = setmetatable({}, { __mode = 'k' }) "
         "for i = 1, n - 1 do w[keys[i]] = keys[i + 1] end "
         "local first = keys[1] keys = nil collectgarbage() return first",
         test::HostileEnd::time},
    };
}

// All scripts with LISSOM_TRIALS, else every sixth.
Scripts tried_scripts() {
    const Scripts all = test::hostile_scripts();
    CHECK(all.size() >= 200);
    Scripts tried = scripts_between_hooks();
    const std::size_t step = std::getenv("LISSOM_TRIALS") ? 1 : 6;
    for (std::size_t i = 0; i < all.size(); i += step) tried.push_back(all[i]);
    return tried;
}

TEST_CASE("wall: hostile scripts end at its limits while the first wall has none") {
    // Beside a sanitizer nothing bounds their memory.
    if (!missing_wall(wall_support()).empty() || !wall_limits_memory()) return;
    const Scripts scripts = tried_scripts();
    const auto start = Clock::now();
    std::vector<pid_t> workers;
    for (std::size_t i = 0; i < kProcesses; ++i) workers.push_back(start_worker(scripts, i));
    for (const pid_t worker : workers) {
        int status = -1;
        REQUIRE(waitpid(worker, &status, 0) == worker);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
    }
    const std::chrono::duration<double> time = Clock::now() - start;
    MESSAGE(scripts.size(), " scripts in ", time.count(), " s");
}

}  // namespace
}  // namespace lissom::cli

#endif
