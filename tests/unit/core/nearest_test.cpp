#include "kernel/core/nearest.h"

#include <doctest/doctest.h>

namespace lissom {
namespace {

const std::vector<std::string_view> kNames{"smooth", "size", "subdivide", "set_region"};

TEST_CASE("the nearest name needs the fewest edits") {
    CHECK(nearest_name("smoth", kNames) == "smooth");
    CHECK(nearest_name("smooht", kNames) == "smooth");
    CHECK(nearest_name("sise", kNames) == "size");
    CHECK(nearest_name("setregion", kNames) == "set_region");
}

TEST_CASE("the start of a name is near") {
    CHECK(nearest_name("sub", kNames) == "subdivide");
}

TEST_CASE("what is far from all names gives no hint") {
    CHECK(nearest_name("extrude", kNames) == "");
    CHECK(nearest_name("", kNames) == "");
    CHECK(nearest_name("x", {}) == "");
    CHECK(name_hint("extrude", {"a", "b"}) == "; there is: a, b");
    CHECK(name_hint("x", {}) == "; there are none");
}

TEST_CASE("texts of megabytes and a million names are answered at once") {
    const std::string text(30'000'000, 'x'), other(30'000'000, 'y');
    CHECK(nearest_name(text, kNames) == "");
    CHECK(nearest_name("smoth", {text, other, "smooth"}) == "smooth");
    CHECK(nearest_name(text, {other}) == "");
    const std::string name(200, 'n');
    const std::vector<std::string_view> many(1'000'000, name);
    CHECK(nearest_name(std::string(200, 'm'), many) == "");
    CHECK(nearest_name(std::string(199, 'n') + "m", many) == name);
}

}  // namespace
}  // namespace lissom
