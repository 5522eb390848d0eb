// What the program and the kernel ask of the system before they do anything: shared libraries, the
// time to start, and how large they are without their symbols.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "kernel/core/build_info.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kStarts = 40;
// Libraries and milliseconds that a build without GPL keeps to.
constexpr double kProgramLibraries = 11, kKernelLibraries = 6, kStartTarget = 4.0;

// What a command writes.
std::string output_of(const std::string& command) {
    std::string text;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return text;
    char piece[4096];
    while (const std::size_t size = std::fread(piece, 1, sizeof piece, pipe)) {
        text.append(piece, size);
    }
    pclose(pipe);
    return text;
}

// All that the loader maps, without itself and what the system puts into every process.
int libraries_of(const std::string& program) {
    int count = 0;
    std::size_t at = 0;
    const std::string listed = output_of("ldd '" + program + "'");
    while ((at = listed.find(" => ", at)) != std::string::npos) {
        ++count;
        ++at;
    }
    return count;
}

double processor_milliseconds(const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

// Processor time of a process from its start to its end; negative where it fails.
double run_once(std::vector<std::string> words) {
    const pid_t process = fork();
    if (process == 0) {
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    int status = 1;
    rusage used{};
    if (wait4(process, &status, 0, &used) != process || status != 0) return -1.0;
    return processor_milliseconds(used.ru_utime) + processor_milliseconds(used.ru_stime);
}

// The least of many starts of each, taken in turns: what else runs only adds.
std::vector<double> least_starts(const std::vector<std::vector<std::string>>& commands) {
    std::vector<double> least(commands.size(), 1e9);
    for (int round = 0; round < kStarts; ++round) {
        for (std::size_t i = 0; i < commands.size(); ++i) {
            least[i] = std::min(least[i], run_once(commands[i]));
        }
    }
    return least;
}

double stripped_megabytes(const std::string& program) {
    const fs::path copy = fs::temp_directory_path() / ("stripped" + std::to_string(getpid()));
    output_of("strip -o '" + copy.string() + "' '" + program + "'");
    std::error_code error;
    const double bytes = static_cast<double>(fs::file_size(copy, error));
    fs::remove(copy, error);
    return bytes / 1e6;
}

void run(Report& report) {
    const std::string program = LISSOM_PROGRAM_FILE, kernel = LISSOM_KERNEL_FILE;
    const bool bound = !build_info().gpl;
    report.title(std::string("A build under ") + build_info().licence);
    report.add({"shared libraries of the program", 1.0 * libraries_of(program), "",
                bound ? kProgramLibraries : -1.0});
    report.add({"shared libraries of a program with the kernel", 1.0 * libraries_of(kernel), "",
                bound ? kKernelLibraries : -1.0});

    const fs::path script = fs::temp_directory_path() / ("empty" + std::to_string(getpid()));
    std::ofstream(script) << "\n";
    const std::vector<double> starts = least_starts(
        {{LISSOM_EMPTY_FILE}, {program, "--version"}, {program, "run", script.string()}});
    fs::remove(script);
    report.add({"start of an empty program", starts[0], "ms"});
    report.add({"start of lissom --version over an empty program", starts[1] - starts[0], "ms",
                bound ? kStartTarget : -1.0});
    report.add({"start of an empty script over an empty program", starts[2] - starts[0], "ms",
                bound ? kStartTarget : -1.0});
    report.add({"the program without symbols", stripped_megabytes(program), "MB"});
    report.add({"a program with the kernel, without symbols", stripped_megabytes(kernel), "MB"});
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
