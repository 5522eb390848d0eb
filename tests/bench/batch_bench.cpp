// What `lissom batch` costs beside the same processes started by xargs, and by Slurm.
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/bench/report.h"

using namespace lissom::bench;
namespace fs = std::filesystem;

namespace {

constexpr const char* kProgram = LISSOM_PROGRAM_FILE;
constexpr const char* kSlurm = LISSOM_SMALL_SLURM_FILE;

// Waits, which takes no processor, and writes its number.
constexpr const char* kScript = R"(
local p = require("lissom").params{ n = { type = "integer", default = 1 },
    seconds = { type = "number", default = 0 }, out = { type = "file", default = "out.txt" } }
if p.seconds > 0 then os.execute("sleep " .. p.seconds) end
local file = assert(io.open(p.out, "w"))
file:write(p.n)
assert(file:close())
)";

class Folder {
  public:
    Folder() : path_(fs::temp_directory_path() / "lissom_batch_bench") {
        fs::remove_all(path_);
        fs::create_directories(path_);
        std::ofstream(path_ / "job.lua") << kScript;
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const fs::path& path() const { return path_; }

    // Runs a command of the shell in a new folder, with an empty folder "out".
    void run(const std::string& command) const {
        const fs::path own = path_ / std::to_string(++runs_);
        fs::create_directories(own / "out");
        fs::copy_file(path_ / "job.lua", own / "job.lua");
        const std::string whole = "cd '" + own.string() + "' && " + command + " >log 2>&1";
        if (std::system(whole.c_str()) != 0) throw std::runtime_error("failed: " + whole);
    }

  private:
    fs::path path_;
    mutable int runs_ = 0;
};

std::string batch(int jobs, double seconds, const std::string& more) {
    return std::string("'") + kProgram +
           "' batch job.lua --jobs 2 --sweep n=1:" + std::to_string(jobs) +
           ":1 --set seconds=" + std::to_string(seconds) + " --out 'out/{n}.txt' " + more;
}

std::string bare(int jobs, double seconds) {
    return "seq " + std::to_string(jobs) + " | xargs -P2 -I@ '" + kProgram +
           "' run --threads 1 job.lua --n=@ --seconds=" + std::to_string(seconds) +
           " --out=out/@.txt";
}

// Seconds of processors that ended children and theirs have taken while `action` ran.
template <typename Action>
double processor_seconds(const Action& action) {
    const auto used = [] {
        rusage usage{};
        getrusage(RUSAGE_CHILDREN, &usage);
        const auto seconds = [](const timeval& time) {
            return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        };
        return seconds(usage.ru_utime) + seconds(usage.ru_stime);
    };
    const double before = used();
    action();
    return used() - before;
}

void compare_processors(Report& report, const Folder& folder) {
    constexpr int kJobs = 1000;
    const auto with = [&](const std::string& command) {
        return [&folder, command] { return processor_seconds([&] { folder.run(command); }); };
    };
    const auto processes = with(bare(kJobs, 0.0));
    report.add_ratio("1,000 trivial jobs, processors", "the processes of xargs",
                     quotient_of(3, with(batch(kJobs, 0.0, "")), processes), 1.2);
    report.add_ratio("1,000 trivial jobs, --isolate state, processors", "the processes of xargs",
                     quotient_of(3, with(batch(kJobs, 0.0, "--isolate state")), processes), 0.7);
}

void compare_time(Report& report, const Folder& folder) {
    constexpr int kJobs = 100;
    constexpr double kSeconds = 0.5;
    report.add_ratio("100 jobs of .5 s, two at a time", "xargs -P2",
                     seconds_quotient(
                         3, [&] { folder.run(batch(kJobs, kSeconds, "")); },
                         [&] { folder.run(bare(kJobs, kSeconds)); }),
                     1.1);
}

// A Slurm of one node with two processors, on the loopback.
class SmallSlurm {
  public:
    explicit SmallSlurm(const Folder& folder) : folder_(folder.path() / "slurm") {
        fs::create_directory(folder_);
        is_there_ = call("start") == 0;
        setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
    }
    ~SmallSlurm() {
        if (is_there_) call("stop");
    }
    SmallSlurm(const SmallSlurm&) = delete;
    SmallSlurm& operator=(const SmallSlurm&) = delete;

    bool is_there() const { return is_there_; }

  private:
    int call(const std::string& word) const {
        return std::system((std::string("python3 -B '") + kSlurm + "' " + word + " '" +
                            folder_.string() + "' 1 >&2")
                               .c_str());
    }

    fs::path folder_;
    bool is_there_ = false;
};

void compare_slurm(Report& report, const Folder& folder) {
    const SmallSlurm slurm(folder);
    if (!slurm.is_there()) return report.line("  no Slurm can be started here");
    constexpr int kJobs = 1000;
    report.add_ratio("1,000 trivial jobs by Slurm, two at a time", "without Slurm",
                     seconds_quotient(
                         3, [&] { folder.run(batch(kJobs, 0.0, "--slurm")); },
                         [&] { folder.run(batch(kJobs, 0.0, "")); }),
                     1.2);
}

}  // namespace

int main(int argc, char** argv) {
    Report report(argc, argv);
    const Folder folder;
    if (report.wants("processors")) compare_processors(report, folder);
    if (report.wants("time")) compare_time(report, folder);
    if (report.wants("slurm")) compare_slurm(report, folder);
}
