// LISSOM_TESTED_PROGRAM: the tests start this program again as the one that they test.
#ifdef LISSOM_TESTED_PROGRAM
#define DOCTEST_CONFIG_IMPLEMENT
#else
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#endif
#include <doctest/doctest.h>

#ifdef LISSOM_TESTED_PROGRAM
#include <string_view>

namespace lissom::test {
int run_tested_program(int argc, char** argv);
}

int main(int argc, char** argv) {
    if (argc > 1 && std::string_view(argv[1]) == "batch") {
        return lissom::test::run_tested_program(argc, argv);
    }
    return doctest::Context(argc, argv).run();
}
#endif

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
// A driver of OpenGL may bring thread-local variables of its own. LLVM 14, searching for leaks,
// then takes what lies before them for their place, and crashes.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
    return "intercept_tls_get_addr=0";
}
#endif
#endif
