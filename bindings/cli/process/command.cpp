#include "bindings/cli/process/command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>

extern char** environ;

namespace lissom::cli {
namespace {

// A pipe whose ends close with it; no other process inherits them.
struct Pipe {
    std::array<int, 2> ends{-1, -1};

    Pipe() {
        if (pipe(ends.data()) != 0) throw std::runtime_error("a pipe to a program cannot be made");
        for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
    }
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    void close_end(std::size_t end) {
        if (ends[end] >= 0) close(ends[end]);
        ends[end] = -1;
    }
};

// Reads both to their ends, in turns: a full one would stop the program.
void read_all(Pipe& output, Pipe& errors, CommandEnd& end) {
    std::array<char, 4096> buffer;
    while (output.ends[0] >= 0 || errors.ends[0] >= 0) {
        std::array<pollfd, 2> channels{{{output.ends[0], POLLIN, 0}, {errors.ends[0], POLLIN, 0}}};
        if (poll(channels.data(), channels.size(), -1) < 0 && errno != EINTR) return;
        for (std::size_t i = 0; i < 2; ++i) {
            if (channels[i].revents == 0) continue;
            Pipe& from = i == 0 ? output : errors;
            const ssize_t count = read(from.ends[0], buffer.data(), buffer.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) {
                from.close_end(0);
            } else {
                (i == 0 ? end.output : end.errors)
                    .append(buffer.data(), static_cast<std::size_t>(count));
            }
        }
    }
}

}  // namespace

std::optional<CommandEnd> run_command(const std::vector<std::string>& words) {
    std::vector<std::string> own = words;
    std::vector<char*> argv;
    for (std::string& word : own) argv.push_back(word.data());
    argv.push_back(nullptr);
    Pipe output, errors;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output.ends[1], 1);
    posix_spawn_file_actions_adddup2(&actions, errors.ends[1], 2);
    pid_t process = 0;
    const int failure = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) return {};
    output.close_end(1);
    errors.close_end(1);
    CommandEnd end;
    read_all(output, errors, end);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    end.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return end;
}

}  // namespace lissom::cli
