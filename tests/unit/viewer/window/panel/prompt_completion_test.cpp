#include "viewer/window/panel/prompt_completion.h"

#include <doctest/doctest.h>

using namespace lissom::window;

TEST_CASE("prompt: one word takes the place of its beginning, before what follows the cursor") {
    const CompletedLine one = completed_line("lissom.sha + 1", 10, 7, {"shapes"});
    CHECK(one.line == "lissom.shapes + 1");
    CHECK(one.cursor == 13);
    CHECK(one.candidates.empty());
}

TEST_CASE("prompt: of several words what they have in common is taken, and all are candidates") {
    const CompletedLine many = completed_line("m:sm", 4, 2, {"smooth", "smoothed"});
    CHECK(many.line == "m:smooth");
    CHECK(many.cursor == 8);
    CHECK(many.candidates.size() == 2);
    const CompletedLine none = completed_line("m:", 2, 2, {"area", "bounds"});
    CHECK(none.line == "m:");
    CHECK(none.candidates.size() == 2);
}

TEST_CASE("prompt: nothing to complete leaves the line, and so does an answer that does not fit") {
    CHECK(completed_line("xyz", 3, 0, {}).line == "xyz");
    CHECK(completed_line("xyz", 1, 2, {"word"}).line == "xyz");
    CHECK(completed_line("xyz", 9, 2, {"word"}).line == "xyz");
    CHECK(completed_line("", 0, 0, {"print"}).line == "print");
}
