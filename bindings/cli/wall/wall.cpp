#include "bindings/cli/wall/wall.h"

#include <stdexcept>

#include "bindings/cli/wall/wall_steps.h"

#ifdef __linux__

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <linux/capability.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>

namespace lissom::cli {
namespace {

// Memory beside the script's: the program, its libraries, stacks of threads. Pages that are watched
// may exceed the limit by less, before the system refuses more.
constexpr std::size_t kProgramData = std::size_t{448} << 20, kThreadData = std::size_t{8} << 20;
constexpr std::size_t kWatchedData = std::size_t{160} << 20, kMoreOutput = std::size_t{1} << 20;
// The first wall ends a script at its time; this one, so much later.
constexpr double kMoreSeconds = 1.0;
constexpr long kPollNanoseconds = 10'000'000;
constexpr rlim_t kFiles = 256;
constexpr int kCrash = 128;

// Shadow memory of a sanitizer is far beyond any limit.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif
#else
constexpr bool kLimitsMemory = true;
#endif

void set_limit(int resource, rlim_t value) {
    const rlimit limit{value, value};
    if (setrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) {
        throw std::runtime_error(std::string("a limit of the process: ") + std::strerror(errno));
    }
}

void set_limits(const WallRights& rights) {
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_NOFILE, kFiles);
    const std::size_t threads = static_cast<std::size_t>(rights.threads);
    if (kLimitsMemory && rights.memory_bytes != 0) {
        set_limit(RLIMIT_DATA, rights.memory_bytes + kProgramData + threads * kThreadData);
    }
    if (rights.seconds > 0.0) {
        set_limit(RLIMIT_CPU, static_cast<rlim_t>((rights.seconds + kMoreSeconds) *
                                                  static_cast<double>(threads)) +
                                  1);
    }
    if (rights.output_bytes == 0) return;
    // A write beyond it fails, and leaves time to clean up.
    std::signal(SIGXFSZ, SIG_IGN);
    set_limit(RLIMIT_FSIZE, rights.output_bytes + kMoreOutput);
}

void drop_capabilities() {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct none[2] = {};
    if (syscall(SYS_capset, &header, none) != 0) {
        throw std::runtime_error(std::string("capabilities: ") + std::strerror(errno));
    }
}

// The order matters: later steps are allowed by earlier ones, or need them.
void enclose(const WallRights& rights, pid_t parent) {
    set_limits(rights);
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) std::_Exit(1);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) {
        throw std::runtime_error(std::string("no new rights: ") + std::strerror(errno));
    }
    restrict_files(rights);
    drop_capabilities();
    filter_calls();
}

// A number of /proc/PID/FILE, behind the word; -1 if it is not there.
long long number_of(int process, const char* file, const std::string& word) {
    std::ifstream stream("/proc/" + std::to_string(process) + "/" + file);
    std::string name;
    long long value = -1;
    while (stream >> name >> value) {
        if (name == word) return value;
    }
    return -1;
}

// Bytes of memory in use.
long long resident_bytes(int process) {
    std::ifstream stream("/proc/" + std::to_string(process) + "/statm");
    long long all = 0, resident = -1;
    stream >> all >> resident;
    return resident < 0 ? -1 : resident * sysconf(_SC_PAGESIZE);
}

using Clock = std::chrono::steady_clock;

// The limit that a running child has passed; null if none.
const char* passed_limit(int child, const WallRights& rights, Clock::time_point start) {
    const std::chrono::duration<double> passed = Clock::now() - start;
    if (rights.seconds > 0.0 && passed.count() > rights.seconds + kMoreSeconds) return "time";
    if (kLimitsMemory && rights.memory_bytes != 0 &&
        resident_bytes(child) > static_cast<long long>(rights.memory_bytes + kWatchedData)) {
        return "memory";
    }
    if (rights.output_bytes != 0 && number_of(child, "io", "wchar:") >
                                        static_cast<long long>(rights.output_bytes + kMoreOutput)) {
        return "output";
    }
    return nullptr;
}

WallEnd limit_end(const std::string& limit) {
    return {1, "sandbox_" + limit, "the script was ended at its limit of " + limit};
}

WallEnd end_of(int status) {
    if (WIFEXITED(status)) return {WEXITSTATUS(status), "", ""};
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return limit_end("cpu");
    return {kCrash + signal, "crash",
            std::string("the script has made its process crash: ") + strsignal(signal)};
}

// Signals of the terminal go to the child too: the parent waits for its answer.
class QuietSignals {
  public:
    QuietSignals() {
        sigset_t child;
        sigemptyset(&child);
        sigaddset(&child, SIGCHLD);
        sigprocmask(SIG_BLOCK, &child, &before_);
    }
    QuietSignals(const QuietSignals&) = delete;
    QuietSignals& operator=(const QuietSignals&) = delete;
    ~QuietSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

    static void wait() {
        sigset_t child;
        sigemptyset(&child);
        sigaddset(&child, SIGCHLD);
        const timespec time{0, kPollNanoseconds};
        sigtimedwait(&child, nullptr, &time);
    }
    static void leave_to_child() {
        std::signal(SIGINT, SIG_IGN);
        std::signal(SIGQUIT, SIG_IGN);
    }
    // For the child, before it works.
    void undo() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

  private:
    sigset_t before_;
};

}  // namespace

WallEnd watch_child(int child, const WallRights& rights) {
    const Clock::time_point start = Clock::now();
    int status = 0;
    while (true) {
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) return end_of(status);
        if (ended < 0 && errno != EINTR) return {1, "crash", "the script's process is gone"};
        if (const char* limit = passed_limit(child, rights, start)) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return limit_end(limit);
        }
        QuietSignals::wait();
    }
}

std::optional<WallEnd> go_behind_wall(const WallRights& rights) {
    std::cout.flush();
    std::fflush(nullptr);
    const pid_t parent = getpid();
    const QuietSignals signals;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error(std::string("a process: ") + std::strerror(errno));
    if (child == 0) {
        signals.undo();
        enclose(rights, parent);
        return std::nullopt;
    }
    QuietSignals::leave_to_child();
    return watch_child(child, rights);
}

WallSupport wall_support() {
    return {landlock_version(), can_filter_calls()};
}

bool wall_limits_memory() {
    return kLimitsMemory;
}

}  // namespace lissom::cli

#else

namespace lissom::cli {

WallEnd watch_child(int, const WallRights&) {
    return {};
}

std::optional<WallEnd> go_behind_wall(const WallRights&) {
    throw std::runtime_error("this system has no wall for scripts");
}

WallSupport wall_support() {
    return {};
}

bool wall_limits_memory() {
    return false;
}

}  // namespace lissom::cli

#endif

namespace lissom::cli {

std::string missing_wall(const WallSupport& support) {
    std::string missing;
    if (support.landlock < 1) missing = "Landlock (rights of files)";
    if (!support.filters) {
        missing +=
            std::string(missing.empty() ? "" : " and ") + "seccomp (filters of system calls)";
    }
    return missing;
}

}  // namespace lissom::cli
