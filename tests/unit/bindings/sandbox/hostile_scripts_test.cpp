#include "tests/unit/bindings/sandbox/hostile_scripts.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "tests/unit/bindings/sandbox/hostile_composer.h"

namespace lissom::lua {
namespace {

using test::HostileEnd;
using test::HostileScript;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMemory = std::size_t{48} << 20;
// Beyond it: finalizers, and the way back from a failed step of a scene.
constexpr std::size_t kOverdraft = std::size_t{64} << 10;
constexpr int kThreads = 4;

// Short for those that it has to end; the others come to their own end, on any machine.
SandboxLimits limits_for(const HostileScript& script) {
    SandboxLimits limits;
    const bool is_ended = script.end == HostileEnd::time || script.end == HostileEnd::any;
    limits.seconds = is_ended ? 0.1 : 100.0;
    limits.memory_bytes = kMemory;
    limits.output_bytes = 100'000;
    return limits;
}

int run(Sandbox& sandbox, const std::string& text) {
    lua_State* L = sandbox.lua();
    lua_settop(L, 0);
    const int loaded = luaL_loadbufferx(L, text.data(), text.size(), "=script", "t");
    CHECK_MESSAGE(loaded == LUA_OK, text);
    return loaded == LUA_OK ? sandbox.call(0, 1) : loaded;
}

std::string message_of(lua_State* L) {
    const bool has_text = lua_isstring(L, -1) != 0 || is_error_object(L, -1);
    return has_text ? push_error_text(L, -1) : "";
}

void check_end(Sandbox& sandbox, const HostileScript& script, int status) {
    const int top = lua_gettop(sandbox.lua());
    const std::string message = message_of(sandbox.lua());
    lua_settop(sandbox.lua(), top);
    INFO("ended with ", status, ": ", message);
    switch (script.end) {
        case HostileEnd::time:
            CHECK(status != LUA_OK);
            CHECK(sandbox.end() == SandboxEnd::seconds);
            break;
        case HostileEnd::error:
            CHECK(status != LUA_OK);
            CHECK(message.find(script.message) != std::string::npos);
            break;
        case HostileEnd::harmless:
            CHECK(status == LUA_OK);
            CHECK(lua_toboolean(sandbox.lua(), -1));
            break;
        case HostileEnd::any:
            break;
    }
}

void check_use(Sandbox& sandbox) {
    CHECK(sandbox.memory()->peak() <= kMemory + kOverdraft);
    lua_settop(sandbox.lua(), 0);
    lua_gc(sandbox.lua(), LUA_GCCOLLECT);
    CHECK(run(sandbox, "local t = {} for i = 1, 1000 do t[i] = i end return #t") == LUA_OK);
    CHECK(lua_tointeger(sandbox.lua(), -1) == 1000);
}

void check_script(const HostileScript& script) {
    CAPTURE(script.name);
    std::shared_ptr<MemoryAccount> memory;
    {
        Sandbox sandbox(limits_for(script), {});
        memory = sandbox.memory();
        check_end(sandbox, script, run(sandbox, script.text));
        check_use(sandbox);
    }
    CHECK_MESSAGE(memory->used() == 0, script.text);
}

// Calls work(0), work(1) ... on several threads until it returns false.
void on_threads(const std::function<bool(std::uint32_t)>& work) {
    std::atomic<std::uint32_t> next = 0;
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i) {
        threads.emplace_back([&] {
            while (work(next++)) {
            }
        });
    }
}

// LISSOM_HOSTILE_PART, such as 3/12: that part of the scripts, all if absent. The thread sanitizer
// keeps memory for all that was ever allocated, so that one process cannot run all of them.
std::vector<HostileScript> chosen_scripts() {
    std::vector<HostileScript> scripts = test::hostile_scripts();
    CHECK(scripts.size() >= 200);
    std::size_t part = 1, parts = 1;
    if (const char* text = std::getenv("LISSOM_HOSTILE_PART")) {
        REQUIRE(std::sscanf(text, "%zu/%zu", &part, &parts) == 2);
        REQUIRE(part >= 1);
        REQUIRE(part <= parts);
    }
    std::vector<HostileScript> chosen;
    for (std::size_t i = part - 1; i < scripts.size(); i += parts) chosen.push_back(scripts[i]);
    return chosen;
}

TEST_CASE("sandbox: hostile scripts end, leave a state that is of use, and give all back") {
    const auto scripts = chosen_scripts();
    on_threads([&](std::uint32_t i) {
        if (i < scripts.size()) check_script(scripts[i]);
        return i + 1 < scripts.size();
    });
}

// LISSOM_HOSTILE_SECONDS, LISSOM_HOSTILE_COUNT and LISSOM_HOSTILE_SEED: how long, how many at most,
// and the first seed.
double number_from(const char* name, double usual) {
    const char* text = std::getenv(name);
    return text ? std::atof(text) : usual;
}

void check_composed(std::uint32_t seed) {
    CAPTURE(seed);
    HostileScript script{"", test::composed_script(seed), HostileEnd::any};
    SandboxLimits limits = limits_for(script);
    limits.seconds = 0.03;
    if (seed % 4 == 0) limits.instructions = 10'000;
    if (seed % 4 == 1) limits.memory_bytes = std::size_t{4} << 20;
    std::shared_ptr<MemoryAccount> memory;
    const auto start = Clock::now();
    {
        Sandbox sandbox(limits, {});
        memory = sandbox.memory();
        run(sandbox, script.text);
        check_use(sandbox);
    }
    CHECK_MESSAGE(memory->used() == 0, script.text);
    CHECK(memory->peak() <= limits.memory_bytes + kOverdraft);
    CHECK(Clock::now() - start < std::chrono::seconds(30));
}

TEST_CASE("sandbox: composed scripts end within their limits") {
    const std::chrono::duration<double> time(number_from("LISSOM_HOSTILE_SECONDS", 3.0));
    const auto first = static_cast<std::uint32_t>(number_from("LISSOM_HOSTILE_SEED", 1.0));
    const auto most = static_cast<std::uint32_t>(number_from("LISSOM_HOSTILE_COUNT", 150.0));
    const auto start = Clock::now();
    std::atomic<int> count = 0;
    on_threads([&](std::uint32_t i) {
        if (i < most) check_composed(first + i);
        ++count;
        return i + 1 < most && Clock::now() - start < time;
    });
    MESSAGE(count.load(), " scripts from seed ", first);
    CHECK(count > 0);
}

}  // namespace
}  // namespace lissom::lua
