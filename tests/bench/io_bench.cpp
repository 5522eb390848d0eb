/// Speed of reading and writing files of a million triangles, beside OpenMesh's readers and
/// tinygltf. One thread; best of several runs in turns.

#include <chrono>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/peers/heap.h"
#include "tests/bench/peers/io_rivals.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRuns = 5;
constexpr double kTarget = 1.5;

/// A folder that is removed in the end.
class TemporaryFolder {
  public:
    TemporaryFolder()
        : path_(fs::temp_directory_path() /
                ("lissom-bench-" + std::to_string(std::random_device()()))) {
        fs::create_directory(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    fs::path file(const std::string& extension) const { return path_ / ("sphere." + extension); }

  private:
    fs::path path_;
};

/// 1,003,520 triangles.
Mesh million_triangles() {
    SphereOptions options;
    options.segments = 224;
    options.kind = SphereKind::triangles;
    return make_sphere(options);
}

/// Seconds of load_mesh: of all, and until the content of the file is polygons.
struct LoadTimes {
    double whole = 0.0, decode = 0.0;
};

LoadTimes time_load(const fs::path& path) {
    LoadTimes times;
    const auto start = std::chrono::steady_clock::now();
    const auto since_start = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    ContextOptions options;
    options.progress = [&](std::string_view label, double) {
        if (label == "check mesh" && times.decode == 0.0) times.decode = since_start();
    };
    const Mesh mesh = load_mesh(path, {}, Context(options));
    times.whole = since_start();
    return times;
}

struct Rival {
    std::string name;
    std::function<std::size_t(const fs::path&)> read;
    /// What of ours is compared: all, or only making polygons of the file.
    bool decode_only = false;
};

struct Format {
    std::string name, extension;
    std::vector<Rival> rivals;
};

std::vector<Format> formats() {
    const std::vector<Rival> openmesh{{"OpenMesh", read_with_openmesh}};
    return {{"OBJ", "obj", openmesh},
            {"PLY binary", "ply", openmesh},
            {"OFF", "off", openmesh},
            {"STL binary", "stl", openmesh},
            {"GLB",
             "glb",
             {{"tinygltf and OpenMesh's add_face", read_with_tinygltf_into_openmesh},
              {"tinygltf, without half-edges", read_with_tinygltf, true}}}};
}

struct Times {
    LoadTimes ours{std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
    double save = std::numeric_limits<double>::infinity();
    std::vector<double> rivals;
};

Times time_format(const Mesh& mesh, const Format& format, const fs::path& path) {
    Times best;
    best.rivals.assign(format.rivals.size(), std::numeric_limits<double>::infinity());
    for (int run = 0; run < kRuns; ++run) {
        best.save = std::min(best.save, seconds([&] { save_mesh(mesh, path); }));
        const LoadTimes ours = time_load(path);
        best.ours.whole = std::min(best.ours.whole, ours.whole);
        best.ours.decode = std::min(best.ours.decode, ours.decode);
        for (std::size_t i = 0; i < format.rivals.size(); ++i) {
            std::size_t triangles = 0;
            const double time = seconds([&] { triangles = format.rivals[i].read(path); });
            if (triangles != static_cast<std::size_t>(mesh.face_count()))
                throw std::runtime_error(format.rivals[i].name + " did not read " + path.string());
            best.rivals[i] = std::min(best.rivals[i], time);
        }
    }
    return best;
}

void run_format(Report& report, const Mesh& mesh, const Format& format, const fs::path& path) {
    const Times times = time_format(mesh, format, path);
    report.title("  " + format.name + ": " + std::to_string(fs::file_size(path) / 1000000) + " MB");
    report.add({format.name + ": save", times.save, "s"});
    report.add({format.name + ": load", times.ours.whole, "s"});
    report.add({format.name + ": load, until polygons", times.ours.decode, "s"});
    for (std::size_t i = 0; i < format.rivals.size(); ++i) {
        const Rival& rival = format.rivals[i];
        report.add({format.name + ": " + rival.name, times.rivals[i], "s"});
        const double ours = rival.decode_only ? times.ours.decode : times.ours.whole;
        const std::string what = rival.decode_only ? ": until polygons / " : ": load / ";
        report.add({format.name + what + rival.name, ours / times.rivals[i], "x", kTarget});
    }
    const auto size = static_cast<double>(fs::file_size(path));
    const double growth = heap_growth([&] { load_mesh(path); });
    report.add({format.name + ": peak memory of load / file size", growth / size, "x"});
    const double rival_growth = heap_growth([&] { format.rivals[0].read(path); });
    report.add({format.name + ": peak memory of " + format.rivals[0].name + " / file size",
                rival_growth / size, "x"});
}

void run(Report& report) {
    const TemporaryFolder folder;
    const Mesh mesh = million_triangles();
    report.title("Files of " + std::to_string(mesh.face_count()) + " triangles, one thread");
    for (const Format& format : formats())
        run_format(report, mesh, format, folder.file(format.extension));
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
