// What Blender adds to a frame of a deformation: the whole frame, from the empties that a hand
// moves to the normals that Blender draws with, over the library's own, measured in turns inside
// Blender.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>

#include "tests/bench/report.h"

namespace {

namespace fs = std::filesystem;
using lissom::bench::Quotient;
using lissom::bench::Report;

/// Output of Blender, which runs the frames with the add-on in a folder of its own.
std::string frames() {
    const std::string root = LISSOM_BENCH_ROOT;
    const fs::path folder = fs::temp_directory_path() / ("blender_" + std::to_string(getpid()));
    const std::string make = "python3 -B '" + root + "/bindings/blender/make.py' --unpacked '" +
                             folder.string() + "' && LISSOM_LIBRARY='" LISSOM_BENCH_LIBRARY "' ";
    const std::string command = make +
                                "blender --background --factory-startup --python-exit-code 1 "
                                "--python '" +
                                root + "/tests/bench/blender_frames.py' -- '" + folder.string() +
                                "'";
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    char buffer[4096];
    for (std::size_t n; pipe && (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
        text.append(buffer, n);
    }
    const bool is_done = pipe && pclose(pipe) == 0;
    fs::remove_all(folder);
    return is_done ? text : std::string();
}

/// Adds the rows of a line "ROW VERTICES QUALITY RATIO LOW HIGH WHOLE OWN", in milliseconds.
bool add_line(Report& report, const std::string& line) {
    std::istringstream words(line);
    std::string row, vertices, quality;
    Quotient ratio;
    if (!(words >> row >> vertices >> quality >> ratio.value >> ratio.low >> ratio.high >>
          ratio.above >> ratio.below) ||
        row != "ROW") {
        return false;
    }
    const std::string name = vertices + " vertices, " + quality;
    report.add({name + ": whole frame", ratio.above, "ms"});
    report.add_ratio(name + ": whole frame over the library's", "the library", ratio,
                     quality == "full" ? 1.8 : -1.0);
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    Report report(argc, argv);
    if (std::system("command -v blender >/dev/null") != 0) {
        report.line("blender is not installed: apt-get install blender");
        return 0;
    }
    std::istringstream lines(frames());
    int rows = 0;
    for (std::string line; std::getline(lines, line);) rows += add_line(report, line) ? 1 : 0;
    if (rows == 6) return 0;
    std::cerr << "Blender has measured " << rows << " rows of 6\n";
    return 1;
}
