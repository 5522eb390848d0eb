#include "bindings/cli/terminal/terminal.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#ifdef _WIN32
#include <io.h>
#else
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
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

bool terminal_moves_cursor() {
    const char* kind = std::getenv("TERM");
    return kind && *kind && std::string_view(kind) != "dumb";
}

#ifdef _WIN32

struct RawTerminal::State {};

bool terminal_sends_keys() {
    return false;
}
std::size_t terminal_columns() {
    return kUsualColumns;
}
RawTerminal::RawTerminal() = default;
RawTerminal::~RawTerminal() = default;
TypedByte read_terminal(int) {
    return {{}, true};
}

#else

struct RawTerminal::State {
    termios settings;
};

bool terminal_sends_keys() {
    termios settings;
    return tcgetattr(STDIN_FILENO, &settings) == 0;
}

std::size_t terminal_columns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 8) return kUsualColumns;
    return size.ws_col;
}

RawTerminal::RawTerminal() {
    termios settings;
    if (tcgetattr(STDIN_FILENO, &settings) != 0) return;
    before_ = std::make_unique<State>(State{settings});
    settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
    settings.c_iflag &= ~static_cast<tcflag_t>(IXON);
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &settings);
}

RawTerminal::~RawTerminal() {
    if (before_) tcsetattr(STDIN_FILENO, TCSADRAIN, &before_->settings);
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
