#include "bindings/cli/process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string_view>
#ifdef __linux__
#include <sys/prctl.h>
#endif

extern char** environ;

namespace lissom::cli {
namespace {

// Descriptor of the child: its channel to the parent.
constexpr int kChannel = 3;
// Descriptors of the parent stay above those of a child.
constexpr int kFirstOwn = 10;

void require_done(int error, const char* what) {
    if (error != 0) throw std::runtime_error(std::string(what) + ": " + std::strerror(error));
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Moves a descriptor above those of a child; no child inherits it.
int moved_up(int descriptor) {
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstOwn);
    const int error = errno;
    close(descriptor);
    if (moved < 0) require_done(error, "a channel to another process cannot be made");
    return moved;
}

struct Channel {
    int read_end = -1, write_end = -1;

    Channel() {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) {
            require_done(errno, "a channel to another process cannot be made");
        }
        read_end = moved_up(ends[0]);
        write_end = moved_up(ends[1]);
        fcntl(read_end, F_SETFL, O_NONBLOCK);
    }
};

// Sets up the child: no input, the file for its outputs, the channel, its own process
// group.
class SpawnSettings {
  public:
    SpawnSettings(const std::filesystem::path& output, int channel, const std::vector<int>& held) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
        posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, 1, output.c_str(),
                                         O_WRONLY | O_CREAT | O_APPEND, 0666);
        posix_spawn_file_actions_adddup2(&actions_, 1, 2);
        posix_spawn_file_actions_adddup2(&actions_, channel, kChannel);
        // The same number: it is then not closed in the child.
        for (const int own : held) posix_spawn_file_actions_adddup2(&actions_, own, own);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    pid_t spawn(std::vector<std::string> words) const {
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        pid_t process = 0;
        require_done(posix_spawn(&process, argv[0], &actions_, &attributes_, argv.data(), environ),
                     "another process of the program cannot be started");
        return process;
    }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

std::string ProcessEnd::text() const {
    if (!by_signal) return "status " + std::to_string(status);
    const char* const name = strsignal(status);
    return "signal " + std::to_string(status) + (name ? " (" + std::string(name) + ")" : "");
}

struct ChildProcess::Parts {
    pid_t process = 0;
    int channel = -1;
    std::string unfinished_line;
    bool ended = false;
    ProcessEnd end;

    // The channel is closed: the process has ended, or is about to.
    void finish() {
        close(channel);
        channel = -1;
        int status = 0;
        rusage usage{};
        while (wait4(process, &status, 0, &usage) < 0 && errno == EINTR) {
        }
        end.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
        end.memory = 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
        end.by_signal = WIFSIGNALED(status);
        end.status = end.by_signal ? WTERMSIG(status) : WEXITSTATUS(status);
        ended = true;
    }
};

ChildProcess::ChildProcess(const std::vector<std::string>& words,
                           const std::filesystem::path& output, const std::vector<int>& held)
    : own_(std::make_unique<Parts>()) {
    std::vector<std::string> line = {program_file().string()};
    line.insert(line.end(), words.begin(), words.end());
    const Channel channel;
    own_->channel = channel.read_end;
    try {
        own_->process = SpawnSettings(output, channel.write_end, held).spawn(std::move(line));
    } catch (...) {
        close(channel.write_end);
        close(channel.read_end);
        throw;
    }
    close(channel.write_end);
}

ChildProcess::~ChildProcess() {
    if (own_->ended) return;
    kill();
    own_->finish();
}

std::vector<std::string> ChildProcess::lines() {
    std::vector<std::string> found;
    std::array<char, 65536> buffer;
    while (!own_->ended) {
        const ssize_t count = read(own_->channel, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) break;
        if (count == 0) own_->finish();
        for (const char c : std::string_view(buffer.data(), static_cast<std::size_t>(count))) {
            if (c != '\n') {
                own_->unfinished_line += c;
            } else {
                found.push_back(std::move(own_->unfinished_line));
                own_->unfinished_line.clear();
            }
        }
    }
    return found;
}

bool ChildProcess::has_ended() const {
    return own_->ended;
}

const ProcessEnd& ChildProcess::end() const {
    return own_->end;
}

void ChildProcess::kill() {
    if (!own_->ended) ::kill(-own_->process, SIGKILL);
}

void ChildProcess::wait(const std::vector<const ChildProcess*>& processes, double seconds) {
    std::vector<pollfd> channels;
    for (const ChildProcess* process : processes) {
        if (!process->has_ended()) channels.push_back({process->own_->channel, POLLIN, 0});
    }
    poll(channels.data(), channels.size(), static_cast<int>(std::max(0.0, 1000.0 * seconds)));
}

ParentProcess::ParentProcess() {
    // Processes started by this one shall not keep the channel open.
    fcntl(kChannel, F_SETFD, FD_CLOEXEC);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

bool ParentProcess::tell(const std::string& line) const {
    const std::string text = line + "\n";
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t count = write(kChannel, text.data() + at, text.size() - at);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        at += static_cast<std::size_t>(count);
    }
    return true;
}

ProcessUse process_use() {
    ProcessUse use;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        use.cpu_seconds += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
        use.memory = std::max(use.memory, 1024 * static_cast<std::uint64_t>(usage.ru_maxrss));
    }
    return use;
}

void redirect_outputs(const std::filesystem::path& file) {
    std::cout.flush();
    std::fflush(nullptr);
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) require_done(errno, "the log of a job cannot be opened");
    for (const int output : {1, 2}) dup2(descriptor, output);
    close(descriptor);
}

// Not std::raise: it would call the handler on the thread that calls it.
void interrupt_program() {
    ::kill(getpid(), SIGINT);
}

std::filesystem::path program_file() {
    std::error_code error;
    std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path() : file;
}

}  // namespace lissom::cli
