#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
// A driver of OpenGL may bring thread-local variables of its own. LLVM 14, searching for leaks,
// then takes what lies before them for their place, and crashes.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
    return "intercept_tls_get_addr=0";
}
#endif
#endif
