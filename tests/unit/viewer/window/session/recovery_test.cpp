#include "viewer/window/session/recovery.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "bindings/cli/process/process_number.h"
#include "tests/unit/bindings/cli/program_run.h"

using namespace lissom;
using window::Recovery;

TEST_CASE("recovery: the copy of a program that ended well goes, that of a killed one is offered") {
    const test::ProgramFolder folder;
    const std::filesystem::path place = folder.path("state");
    CHECK(Recovery::left_in(place).empty());
    {
        const Recovery own(place);
        std::ofstream(own.file()) << "scene";
        std::ofstream(own.journal()) << "calls";
        CHECK(std::filesystem::exists(own.file()));
        CHECK(Recovery::left_in(place).empty());
    }
    CHECK(std::filesystem::is_empty(place));
    try {
        const Recovery own(place);
        std::ofstream(own.file()) << "scene";
        throw std::runtime_error("an error that ends the program");
    } catch (const std::runtime_error&) {
        const Recovery own(place);
        CHECK(std::filesystem::exists(own.file()));
    }
    CHECK(std::filesystem::is_empty(place));
    // No process has such a number.
    const std::string left = folder.write("state/recovery-999999999.lissom", "scene");
    folder.write("state/recovery-x.lissom", "another file");
    folder.write("state/notes.txt", "another file");
    REQUIRE(Recovery::left_in(place).size() == 1);
    CHECK(Recovery::left_in(place).front() == left);
    CHECK(Recovery::journal_of(left).empty());
    const std::string journal = folder.write("state/recovery-999999999.lua", "calls");
    CHECK(Recovery::journal_of(left) == journal);
    CHECK(Recovery::left_in(place).size() == 1);
    Recovery::remove(left);
    CHECK_FALSE(std::filesystem::exists(left));
    CHECK_FALSE(std::filesystem::exists(journal));
    CHECK(cli::process_runs(cli::process_number()));
}

TEST_CASE("recovery: what was not saved is kept where the window is closed") {
    const test::ProgramFolder folder;
    const std::filesystem::path place = folder.path("state");
    std::filesystem::path kept;
    {
        const Recovery own(place);
        CHECK(own.keep().empty());
        std::ofstream(own.file()) << "scene";
        std::ofstream(own.journal()) << "calls";
        kept = own.keep();
        CHECK(std::filesystem::exists(Recovery::journal_of(kept)));
        // The next one does not take its place.
        std::ofstream(own.file()) << "another scene";
        const std::filesystem::path next = own.keep();
        CHECK(next != kept);
        CHECK(std::filesystem::exists(next));
        CHECK(Recovery::journal_of(next).empty());
    }
    CHECK(std::filesystem::exists(kept));
    // As long as this process runs, what it shows is its own.
    CHECK(Recovery::left_in(place).empty());
}

TEST_CASE("recovery: what closed windows did not save is offered as what killed ones left") {
    const test::ProgramFolder folder;
    const std::filesystem::path place = folder.path("state");
    const std::string first = folder.write("state/unsaved-999999999.lissom", "scene");
    const std::string second = folder.write("state/unsaved-999999999-2.lissom", "scene");
    folder.write("state/unsaved.lissom", "another file");
    folder.write("state/recovery-999999999-2.lissom", "another file");
    const auto left = Recovery::left_in(place);
    REQUIRE(left.size() == 2);
    CHECK(std::find(left.begin(), left.end(), first) != left.end());
    CHECK(std::find(left.begin(), left.end(), second) != left.end());
}
