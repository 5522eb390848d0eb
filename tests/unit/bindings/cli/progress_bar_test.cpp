#include "bindings/cli/terminal/progress_bar.h"

#include <doctest/doctest.h>

#include <sstream>

namespace lissom::cli {
namespace {

using std::chrono::milliseconds;

struct Bar {
    std::ostringstream out;
    ProgressBar::Clock::time_point now;
    ProgressBar bar{out, [this] { return now; }};
};

TEST_CASE("short work shows nothing") {
    Bar b;
    for (int i = 0; i <= 10; ++i) {
        b.bar.show("work", i / 10.0);
        b.now += milliseconds(45);
    }
    b.bar.clear();
    CHECK(b.out.str().empty());
}

TEST_CASE("long work shows a line that goes when it is done") {
    Bar b;
    b.bar.show("work", 0.0);
    b.now += milliseconds(600);
    b.bar.show("work", 0.5);
    const std::string line = b.out.str();
    CHECK(line.find(" 50 % work") != std::string::npos);
    CHECK(line.find("###############...............") != std::string::npos);
    b.bar.clear();
    CHECK(b.out.str() == line + "\r\x1b[K");
    b.bar.clear();
    CHECK(b.out.str() == line + "\r\x1b[K");
}

TEST_CASE("the line changes at most ten times a second, and each work has its own patience") {
    Bar b;
    b.bar.show("work", 0.0);
    b.now += milliseconds(600);
    b.bar.show("work", 0.1);
    const std::string first = b.out.str();
    b.now += milliseconds(50);
    b.bar.show("work", 0.2);
    CHECK(b.out.str() == first);
    b.now += milliseconds(60);
    b.bar.show("work", 0.3);
    CHECK(b.out.str() != first);
    b.bar.clear();
    const std::string cleared = b.out.str();
    b.bar.show("next", 0.0);
    b.now += milliseconds(400);
    b.bar.show("next", 0.9);
    CHECK(b.out.str() == cleared);
}

}  // namespace
}  // namespace lissom::cli
