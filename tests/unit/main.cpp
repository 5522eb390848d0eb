#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
// Where a driver of OpenGL has brought thread-local variables of its own, the search for leaks may
// take what lies before them for a size (LLVM 14 at blocks 16 bytes into a page) and crashes.
extern "C" const char* __asan_default_options();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
    return "intercept_tls_get_addr=0";
}
#endif
#endif
