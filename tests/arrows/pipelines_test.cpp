#include "tests/arrows/pipelines.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

using namespace lissom::test;

namespace {

std::string text_of(const std::string& name) {
    const char* root = std::getenv("LISSOM_SOURCE_DIR");
    std::ifstream file((root ? std::string(root) : ".") + "/" + name, std::ios::binary);
    REQUIRE_MESSAGE(file, name << " is absent");
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("the picture of the pipelines is that of the rules and CONTRIBUTING.md") {
    const bool same =
        pipelines_picture(text_of("CONTRIBUTING.md")) == text_of("docs/pipelines.svg");
    CHECK_MESSAGE(same, "write docs/pipelines.svg again: ./dev build release pipelines");
}

TEST_CASE("the picture has every room that CONTRIBUTING.md has of the pipelines, with its words") {
    const std::string rooms =
        "| [kernel/hair/curve](kernel/hair/curve) | curves & `hints` |\n"
        "| [kernel/merge/sew](kernel/merge/sew) | the seam (`sew.cpp`) |\n";
    const std::string picture = pipelines_picture(rooms);
    for (const char* text : {">curve<", ">curves &amp; hints<", ">sew<", ">the seam<"}) {
        CHECK(picture.find(text) != std::string::npos);
    }
    CHECK(picture.find(">blend<") == std::string::npos);
}
