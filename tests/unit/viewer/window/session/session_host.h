/// A session without a window, for tests.
#pragma once

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/lua/core/registry.h"
#include "tests/unit/bindings/cli/program_run.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/window/session/session.h"

namespace lissom::test {

inline cli::ProgramParts viewer_parts() {
    cli::ProgramParts parts = cli::kernel_parts();
    parts.libraries.push_back(lua::viewer_library);
    return parts;
}

/// A session, and what a window would do with it.
struct SessionHost {
    explicit SessionHost(window::SessionOptions chosen = {}) : options(std::move(chosen)) {}

    cli::ProgramParts parts = viewer_parts();
    cli::Program program{parts};
    ProgramFolder folder;
    std::atomic<int> wakes{0};
    std::vector<window::ConsoleLine> lines;
    window::SessionOptions options;
    window::Session session{program, [this] { ++wakes; }, options};
    // News that no test has asked for yet.
    window::SessionNews news;

    // Returns a result since the last call.
    template <typename Value>
    Value take(Value window::SessionNews::*result) {
        merge(session.take_news());
        return std::exchange(news.*result, Value());
    }
    // Newer results take the place of older ones; lists grow.
    void merge(window::SessionNews next) {
        const auto renew = [](auto& kept, auto& value) {
            if (value) kept = std::move(value);
        };
        renew(news.opened, next.opened);
        renew(news.saved, next.saved);
        renew(news.shown, next.shown);
        renew(news.parameters, next.parameters);
        if (next.tool_state && news.tool_state && !next.tool_state->camera) {
            next.tool_state->camera = news.tool_state->camera;
            next.tool_state->up = news.tool_state->up;
        }
        renew(news.tool_state, next.tool_state);
        renew(news.completion, next.completion);
        renew(news.playback, next.playback);
        news.tools.insert(news.tools.end(), next.tools.begin(), next.tools.end());
        news.lines.insert(news.lines.end(), next.lines.begin(), next.lines.end());
    }

    // Milliseconds until nothing runs.
    double wait(double seconds = 60.0) {
        const auto start = std::chrono::steady_clock::now();
        const auto spent = [&] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        while (session.busy() && spent() < seconds) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        CHECK_FALSE(session.busy());
        for (window::ConsoleLine& line : take(&window::SessionNews::lines)) {
            lines.push_back(std::move(line));
        }
        return 1e3 * spent();
    }
    void run(const std::string& text, std::vector<std::string> words = {}) {
        words.insert(words.begin(), folder.write("script.lua", text));
        session.open(words);
        wait();
    }
    bool says(window::LineKind kind, const std::string& part) const {
        for (const window::ConsoleLine& line : lines) {
            if (line.kind == kind && line.text.find(part) != std::string::npos) return true;
        }
        return false;
    }
    // Lets the script come as far as its first print.
    void wait_for_line() {
        while (lines.empty()) {
            lines = take(&window::SessionNews::lines);
            std::this_thread::yield();
        }
    }
};

}  // namespace lissom::test
