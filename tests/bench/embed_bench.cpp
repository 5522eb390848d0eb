// What the library costs a product that embeds it, before it does anything: sizes without symbols,
// the shared libraries that are loaded with it, and the processor time of a start over that of an
// empty program. Of the build without the GPL, which a shipped product takes, of the kernel and the
// C ABI alone, built to be small, and of this build.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/bench/report.h"

namespace {

namespace fs = std::filesystem;
using lissom::bench::Report;

constexpr int kStarts = 41;

/// Processor seconds of a program from its start to its end, with its output thrown away.
double start(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        if (!std::freopen("/dev/null", "w", stdout)) _exit(127);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    if (status != 0) {
        std::fprintf(stderr, "%s does not run\n", words.front().c_str());
        std::exit(1);
    }
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Milliseconds over an empty program, started in turns: the median of the differences.
double milliseconds_over_empty(const std::vector<std::string>& words) {
    std::vector<double> differences;
    for (int i = 0; i < kStarts; ++i) {
        const double empty = start({LISSOM_BENCH_EMPTY});
        differences.push_back(1e3 * (start(words) - empty));
    }
    return lissom::bench::quantile(differences, 0.5);
}

std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    char buffer[4096];
    for (std::size_t n; pipe && (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
        text.append(buffer, n);
    }
    if (pipe) pclose(pipe);
    return text;
}

/// Shared libraries but for the loader, those of libraries included.
double library_count(const fs::path& file) {
    const std::string count =
        output_of("ldd '" + file.string() + "' | grep -cvE 'linux-vdso|ld-linux'");
    return std::atof(count.c_str());
}

/// Megabytes without symbols.
double stripped_size(const fs::path& file) {
    const fs::path copy = fs::temp_directory_path() / ("stripped_" + std::to_string(getpid()));
    output_of("strip -o '" + copy.string() + "' '" + file.string() + "'");
    const double bytes = fs::exists(copy) ? static_cast<double>(fs::file_size(copy)) : 0.0;
    fs::remove(copy);
    return bytes / 1e6;
}

/// What is to be reached, where it is: of a product without the GPL.
struct Targets {
    double libraries = -1.0, megabytes = -1.0, milliseconds = -1.0;
};

void add_file(Report& report, const std::string& name, const fs::path& file, Targets targets) {
    report.add({name + ": shared libraries", library_count(file), "", targets.libraries});
    report.add({name + ": size without symbols", stripped_size(file), "MB", targets.megabytes});
}

void add_build(Report& report, const std::string& build, const fs::path& folder, bool is_free) {
    const auto target = [&](double value) { return is_free ? value : -1.0; };
    report.title(build);
    const fs::path program = folder / "viewer/lissom", library = folder / "bindings/c/liblissom.so";
    const fs::path script =
        fs::temp_directory_path() / ("empty_" + std::to_string(getpid()) + ".lua");
    std::ofstream(script) << "\n";
    add_file(report, build + ", program", program, {target(11)});
    report.add({build + ", program --version: start over an empty program",
                milliseconds_over_empty({program, "--version"}), "ms", target(4)});
    report.add({build + ", program, empty script: start over an empty program",
                milliseconds_over_empty({program, "run", script}), "ms"});
    // Six, and Lua, with which it is built here.
    add_file(report, build + ", liblissom with Lua", library, {target(7)});
    add_file(report, build + ", module of Lua 5.4", folder / "bindings/lua/lua5.4/lissom.so",
             {target(6)});
    fs::remove(script);
}

}  // namespace

int main(int argc, char** argv) {
    Report report(argc, argv);
    const fs::path free_build = LISSOM_BENCH_FREE_BUILD;
    if (fs::exists(free_build / "viewer/lissom")) {
        add_build(report, "without the GPL", free_build, true);
    } else {
        report.line("no build without the GPL in " + free_build.string() +
                    ": ./dev build no-gpl lissom lissom_shared lissom_lua54_module");
    }
    const fs::path small = fs::path(LISSOM_BENCH_SMALL_BUILD) / "bindings/c/liblissom.so";
    if (fs::exists(small)) {
        report.title("kernel and C ABI alone, small");
        add_file(report, "kernel and C ABI alone, small", small, {6, 4});
    } else {
        report.line("no " + small.string() + ": ./dev build small lissom_shared");
    }
    add_build(report, "with CHOLMOD", LISSOM_BENCH_BUILD, false);
    report.add({"C host: start over an empty program, with a context",
                milliseconds_over_empty({LISSOM_BENCH_HOST}), "ms"});
}
