// The file of typed lines.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bindings/cli/terminal/history.h"
#include "tests/unit/bindings/cli/program_run.h"

namespace lissom::cli {
namespace {

TEST_CASE("history: lines are kept in a file, once each in a row, the last thousand") {
    const test::ProgramFolder folder;
    const std::filesystem::path file = folder.path("deep/state/history");
    {
        History history(file);
        CHECK(history.add("one"));
        CHECK_FALSE(history.add("one"));
        CHECK_FALSE(history.add(""));
        CHECK(history.add("two"));
        CHECK(history.size() == 2);
    }
    std::ofstream(file, std::ios::app) << "of another program\n";
    History again(file);
    REQUIRE(again.size() == 3);
    CHECK(again.line(2) == "of another program");
    for (int i = 0; i < 1500; ++i) again.add(std::to_string(i));
    CHECK(again.size() == 1000);
    again.shorten_file();
    History shortened(file);
    CHECK(shortened.size() == 1000);
    CHECK(shortened.line(999) == "1499");
    CHECK(History(std::filesystem::path()).size() == 0);
}

}  // namespace
}  // namespace lissom::cli
