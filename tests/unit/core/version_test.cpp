#include "kernel/core/version.h"

#include <doctest/doctest.h>

#include <string>

namespace lissom {
namespace {

TEST_CASE("the version is there as text and as numbers for the preprocessor") {
#if LISSOM_VERSION_NUMBER < 100
    FAIL("a version before 0.1.0");
#endif
    const std::string text = std::to_string(LISSOM_VERSION_MAJOR) + "." +
                             std::to_string(LISSOM_VERSION_MINOR) + "." +
                             std::to_string(LISSOM_VERSION_PATCH);
    CHECK(text == LISSOM_VERSION);
}

}  // namespace
}  // namespace lissom
