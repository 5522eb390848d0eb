#include "bindings/cli/terminal/terminal.h"

#include <cerrno>
#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>
#endif

namespace lissom::cli {
namespace {

constexpr std::size_t kUsualColumns = 80;

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

#ifdef _WIN32

std::size_t terminal_columns() {
    return kUsualColumns;
}
TypedByte read_terminal(int) {
    return {{}, true};
}

#else

std::size_t terminal_columns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 8) return kUsualColumns;
    return size.ws_col;
}

// A signal ends the wait early: it is then as if nothing had come in time.
TypedByte read_terminal(int milliseconds) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, milliseconds) <= 0) return {};
    char byte = 0;
    const ssize_t count = read(STDIN_FILENO, &byte, 1);
    if (count == 1) return {byte, false};
    return {{}, count == 0 || errno != EINTR};
}

#endif

}  // namespace lissom::cli
