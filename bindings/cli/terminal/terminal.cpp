#include "bindings/cli/terminal/terminal.h"

#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace lissom::cli {
namespace {

bool is_terminal(std::FILE* file) {
#ifdef _WIN32
    return _isatty(_fileno(file)) != 0;
#else
    return isatty(fileno(file)) != 0;
#endif
}

}  // namespace

bool error_is_terminal() {
    return is_terminal(stderr);
}
bool input_is_terminal() {
    return is_terminal(stdin);
}

}  // namespace lissom::cli
