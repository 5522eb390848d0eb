#include "viewer/window/session/file_watch.h"

#include <doctest/doctest.h>

#include "tests/unit/bindings/cli/program_run.h"

using namespace lissom;
using namespace lissom::window;

namespace {

// A clock that the test moves on by itself.
struct Watched {
    test::ProgramFolder folder;
    FileWatch watch;
    FileWatch::Clock::time_point now = FileWatch::Clock::now();

    bool look_later() {
        now += std::chrono::milliseconds(300);
        return watch.changed(now);
    }
    // Within some looks; a change is told once only.
    int changes() {
        int count = 0;
        for (int i = 0; i < 6; ++i) count += look_later() ? 1 : 0;
        return count;
    }
};

}  // namespace

TEST_CASE("file watch: a change is told once, whatever way the file was written") {
    Watched w;
    const std::string file = w.folder.write("a.lua", "one");
    w.watch.set({file});
    CHECK(w.changes() == 0);
    w.folder.write("a.lua", "other");
    CHECK(w.changes() == 1);
    // As editors do: another file takes its place.
    w.folder.write("new", "a third one");
    std::filesystem::rename(w.folder.path("new"), file);
    CHECK(w.changes() == 1);
    std::filesystem::remove(file);
    CHECK(w.changes() == 1);
    w.folder.write("a.lua", "back");
    CHECK(w.changes() == 1);
    CHECK(w.changes() == 0);
}

TEST_CASE("file watch: what is still being written is not told") {
    Watched w;
    const std::string file = w.folder.write("a.lua", "");
    w.watch.set({file});
    std::string text;
    for (int i = 0; i < 5; ++i) {
        w.folder.write("a.lua", text += "more");
        CHECK_FALSE(w.look_later());
    }
    CHECK(w.look_later());
}

TEST_CASE("file watch: files that are watched already keep what was seen of them") {
    Watched w;
    const std::string a = w.folder.write("a.lua", "one"), b = w.folder.write("b.lua", "two");
    w.watch.set({a});
    w.look_later();
    w.folder.write("a.lua", "changed");
    w.watch.set({a, b});
    CHECK(w.changes() == 1);
    w.watch.set({b});
    w.folder.write("a.lua", "nobody looks");
    CHECK(w.changes() == 0);
}
