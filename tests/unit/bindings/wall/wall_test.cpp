// The second wall of the sandbox: a process that the system encloses.
#include "bindings/cli/wall/wall.h"

#include <doctest/doctest.h>

#ifdef __linux__

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/bindings/cli/program_run.h"

namespace lissom::cli {
namespace {

using Folder = test::ProgramFolder;

bool is_walled() {
    if (missing_wall(wall_support()).empty()) return true;
    MESSAGE("skipped: this system has no wall");
    return false;
}

// Runs `work` behind the wall; its result is the exit status of the child.
WallEnd end_behind_wall(const WallRights& rights, const std::function<int()>& work) {
    if (const std::optional<WallEnd> end = go_behind_wall(rights)) return *end;
    std::_Exit(work());
}

struct Attempt {
    const char* name;
    // Returns the result of a system call: below zero if it was refused.
    std::function<long()> call;
};

const std::vector<Attempt> kRefusedAttempts = {
    {"a socket", [] { return socket(AF_INET, SOCK_STREAM, 0); }},
    {"a local socket", [] { return socket(AF_UNIX, SOCK_STREAM, 0); }},
    {"a pair of sockets",
     [] {
         int pair[2];
         return socketpair(AF_UNIX, SOCK_STREAM, 0, pair);
     }},
    {"a program", [] { return execl("/bin/true", "true", nullptr); }},
    {"a process",
     [] {
         const pid_t child = fork();
         if (child == 0) std::_Exit(0);
         return child;
     }},
    {"a process by the newer call", [] { return syscall(SYS_clone3, nullptr, 0); }},
    {"a shell", [] { return std::system("true") == 0 ? 0 : -1; }},
    {"the passwords", [] { return open("/etc/shadow", O_RDONLY); }},
    {"the users", [] { return open("/etc/passwd", O_RDONLY); }},
    {"a folder of the system", [] { return open("/etc", O_RDONLY | O_DIRECTORY); }},
    {"the environment of the parent",
     [] {
         const std::string path = "/proc/" + std::to_string(getppid()) + "/environ";
         return open(path.c_str(), O_RDONLY);
     }},
    {"the memory of the parent",
     [] {
         const std::string path = "/proc/" + std::to_string(getppid()) + "/mem";
         return open(path.c_str(), O_RDWR);
     }},
    {"a signal to the parent", [] { return kill(getppid(), 0); }},
    {"a signal to all", [] { return kill(-1, 0); }},
    {"a debugger", [] { return ptrace(PTRACE_SEIZE, getppid(), nullptr, nullptr); }},
    {"a greater limit",
     [] {
         const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
         return setrlimit(RLIMIT_FSIZE, &all);
     }},
    {"a higher priority", [] { return setpriority(PRIO_PROCESS, 0, -5); }},
    {"a new mount", [] { return syscall(SYS_mount, "x", "/mnt", "tmpfs", 0, nullptr); }},
    {"another user", [] { return setuid(1); }},
    {"a program for the kernel", [] { return syscall(SYS_bpf, 0, nullptr, 0); }},
    {"a file in the folder of all",
     [] { return open("/tmp/lissom_wall", O_WRONLY | O_CREAT, 0600); }},
};

TEST_CASE("wall: network, programs, processes and foreign files are refused") {
    if (!is_walled()) return;
    for (const Attempt& attempt : kRefusedAttempts) {
        CAPTURE(attempt.name);
        const WallEnd end = end_behind_wall({}, [&] { return attempt.call() < 0 ? 3 : 4; });
        CHECK(end.code.empty());
        CHECK(end.status == 3);
    }
}

TEST_CASE("wall: the folders that were named are open, and no way leads out of them") {
    if (!is_walled()) return;
    const Folder read, write;
    const std::string source = read.write("a.obj", "v 0 0 0\n");
    const std::string outside = read.write("b.obj", "v 0 0 0\n"), in_write = write.path("c.obj");
    WallRights rights;
    rights.read_folders = {read.path("")};
    rights.write_folders = {write.path("")};
    const WallEnd end = end_behind_wall(rights, [&] {
        if (open(source.c_str(), O_RDONLY) < 0) return 10;
        if (open(source.c_str(), O_WRONLY) >= 0) return 11;
        if (open(read.path("new.obj").c_str(), O_WRONLY | O_CREAT, 0600) >= 0) return 12;
        const int made = open(in_write.c_str(), O_RDWR | O_CREAT, 0600);
        if (made < 0 || fchmod(made, 0644) != 0) return 13;
        if (chmod(in_write.c_str(), 04777) == 0) return 14;
        if (rename(in_write.c_str(), outside.c_str()) == 0) return 15;
        if (rename(in_write.c_str(), write.path("d.obj").c_str()) != 0) return 16;
        if (symlink("/etc/shadow", write.path("link").c_str()) == 0) return 17;
        if (link(source.c_str(), write.path("hard").c_str()) == 0) return 18;
        if (utimes(source.c_str(), nullptr) == 0) return 19;
        return mkfifo(write.path("pipe").c_str(), 0600) == 0 ? 20 : 3;
    });
    CHECK(end.status == 3);
}

TEST_CASE("wall: threads may begin, and have the same wall") {
    if (!is_walled()) return;
    const WallEnd end = end_behind_wall({}, [] {
        int opened = 0;
        std::thread([&] { opened = open("/etc/passwd", O_RDONLY); }).join();
        return opened < 0 ? 3 : 4;
    });
    CHECK(end.status == 3);
}

TEST_CASE("wall: the status of the child is that of the parent, and a crash is told") {
    if (!is_walled()) return;
    CHECK(end_behind_wall({}, [] { return 0; }).status == 0);
    CHECK(end_behind_wall({}, [] { return 7; }).status == 7);
    const WallEnd crash = end_behind_wall({}, [] {
        std::signal(SIGSEGV, SIG_DFL);
        return raise(SIGSEGV);
    });
    CHECK(crash.status == 128 + SIGSEGV);
    CHECK(crash.code == "crash");
}

TEST_CASE("wall: time ends a child that no signal of its own would") {
    if (!is_walled()) return;
    WallRights rights;
    rights.seconds = 0.1;
    const WallEnd end = end_behind_wall(rights, []() -> int {
        sigset_t all;
        sigfillset(&all);
        sigprocmask(SIG_SETMASK, &all, nullptr);
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    });
    CHECK(end.status == 1);
    CHECK(end.code == "sandbox_time");
}

TEST_CASE("wall: memory ends a child that takes more, however it takes it") {
    if (!is_walled() || !wall_limits_memory()) return;
    WallRights rights;
    rights.memory_bytes = std::size_t{16} << 20;
    constexpr std::size_t kMuch = std::size_t{2} << 30;
    const auto touch = [](char* bytes) {
        for (std::size_t i = 0; bytes != MAP_FAILED && i < kMuch; i += 4096) bytes[i] = 1;
        return bytes == MAP_FAILED ? 1 : 0;
    };
    const auto map = [&](int flags) {
        return touch(static_cast<char*>(
            mmap(nullptr, kMuch, PROT_READ | PROT_WRITE, flags | MAP_ANONYMOUS, -1, 0)));
    };
    CHECK(end_behind_wall(rights, [&] { return map(MAP_PRIVATE); }).status == 1);
    CHECK(end_behind_wall(rights, [&] { return map(MAP_SHARED); }).code == "sandbox_memory");
}

TEST_CASE("wall: output ends a child, to files that are removed at once too") {
    if (!is_walled()) return;
    const Folder write;
    WallRights rights;
    rights.output_bytes = 100'000;
    rights.write_folders = {write.path("")};
    const WallEnd end = end_behind_wall(rights, [&] {
        const std::string bytes(100'000, 'x'), path = write.path("a");
        for (int i = 0; i < 1'000'000; ++i) {
            std::ofstream(path) << bytes;
            unlink(path.c_str());
        }
        return 0;
    });
    CHECK(end.code == "sandbox_output");
}

TEST_CASE("wall: the child does not outlive its parent") {
    if (!is_walled()) return;
    int channel[2];
    REQUIRE(pipe(channel) == 0);
    const pid_t parent = fork();
    if (parent == 0) {
        if (go_behind_wall({})) std::_Exit(0);
        const pid_t child = getpid();
        [[maybe_unused]] const ssize_t sent = write(channel[1], &child, sizeof child);
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    pid_t child = 0;
    REQUIRE(read(channel[0], &child, sizeof child) == sizeof child);
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    bool is_gone = false;
    for (int i = 0; i < 1000 && !is_gone; ++i) {
        std::ifstream status("/proc/" + std::to_string(child) + "/stat");
        std::string number, name, state;
        // What nobody has waited for yet is a zombie.
        is_gone = !(status >> number >> name >> state) || state == "Z";
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(is_gone);
    close(channel[0]);
    close(channel[1]);
}

}  // namespace
}  // namespace lissom::cli

#endif

TEST_CASE("wall: what a system lacks is named") {
    using lissom::cli::missing_wall;
    CHECK(missing_wall({1, true}).empty());
    CHECK(missing_wall({-1, true}).find("Landlock") == 0);
    CHECK(missing_wall({7, false}).find("seccomp") == 0);
    CHECK(missing_wall({0, false}).find(" and ") != std::string::npos);
}
