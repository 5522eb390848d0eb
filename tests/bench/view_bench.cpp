// What the window itself costs beside the driver: from an event to the last call of OpenGL, what is
// sent to the graphics card, the start of the program and its memory. The first two need no screen.
#include <epoxy/gl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/sketch/navigation.h"
#include "tests/bench/report.h"
#include "viewer/gl/platform.h"
#include "viewer/window/display.h"
#include "viewer/window/screen.h"

namespace lissom::bench {
namespace {

using namespace window;

constexpr Index kVertices = 43000, kManyVertices = 690000;
constexpr int kFrames = 31;
constexpr int kWidth = 1280, kHeight = 960;
// What the issue of the window asks for, in milliseconds and megabytes.
constexpr double kOrbitTarget = 1.0, kDragTarget = 3.0, kLargeDragTarget = 25.0;
constexpr double kStartTarget = 600.0, kMemoryTarget = 150.0;

// ---- The driver's part: calls that draw, copy, send or free

struct Driver {
    static inline double seconds = 0.0;
    static inline std::size_t bytes = 0;
};

template <auto& slot>
struct Timed;

// In place of the function that `slot` points to once libepoxy has found it.
template <typename... Arguments, void (*&slot)(Arguments...)>
struct Timed<slot> {
    static inline void (*real)(Arguments...) = nullptr;

    static void call(Arguments... arguments) {
        const auto start = Clock::now();
        real(arguments...);
        Driver::seconds += seconds_since(start);
        using BufferData = std::tuple<GLenum, GLsizeiptr, const void*, GLenum>;
        if constexpr (std::is_same_v<std::tuple<Arguments...>, BufferData>) {
            Driver::bytes += static_cast<std::size_t>(std::get<1>(std::tuple(arguments...)));
        }
    }
    static void install() {
        if (slot == &call) return;
        real = slot;
        slot = &call;
    }
};

void time_driver() {
    Timed<epoxy_glBufferData>::install();
    Timed<epoxy_glDeleteBuffers>::install();
    Timed<epoxy_glDrawArrays>::install();
    Timed<epoxy_glDrawArraysInstanced>::install();
    Timed<epoxy_glClear>::install();
    Timed<epoxy_glBlitFramebuffer>::install();
    Timed<epoxy_glFinish>::install();
}

// ---- A frame

struct FrameCost {
    double own = 0.0, driver = 0.0, rest = 0.0;
    Uploads uploads;
    std::size_t bytes = 0;
};

Mesh triangles_of(Index vertices) {
    Mesh mesh = make_cactus({.vertices = vertices});
    triangulate(mesh);
    return mesh;
}

class Stage {
  public:
    explicit Stage(Index vertices)
        : mesh_(triangles_of(vertices)), scope_(*platform()), screen_(new Screen) {
        show(mesh_);
        camera_ = camera_of(picture_, snapshot_of(picture_), 1.0 * kWidth / kHeight);
        frame([] {});
    }

    std::string name() const { return std::to_string(mesh_.vertex_count() / 1000) + "K"; }
    double position_and_normal_bytes() const {
        return 2.0 * 3.0 * sizeof(float) * 3.0 *
               static_cast<double>(mesh_.topology().corner_count() - 2 * mesh_.face_count());
    }

    FrameCost orbit() {
        return frame([&] {
            camera_ = orbited({camera_, {1.0 * kWidth, 1.0 * kHeight}}, Vec2(3.0, 1.0));
        });
    }
    // What a script or a tool shows next: the same faces, moved.
    FrameCost drag() {
        Mesh moved = mesh_;
        phase_ += 0.01;
        for (Vec3& p : moved.edit_positions()) p.x() += phase_ * p.y();
        return frame([&] { uploads_ = show(moved); });
    }

  private:
    static Platform* platform() {
        static const std::unique_ptr<Platform> made = make_egl_platform();
        return made.get();
    }

    Uploads show(const Mesh& mesh) {
        picture_.meshes = {{std::make_shared<const Mesh>(mesh)}};
        return screen_->update(quick_snapshot(picture_, settings_, 0));
    }

    template <typename Event>
    FrameCost frame(const Event& event) {
        uploads_ = {};
        Driver::seconds = 0.0;
        Driver::bytes = 0;
        const auto start = Clock::now();
        event();
        screen_->draw(camera_, {0, 0, kWidth, kHeight}, background_of(settings_), 1);
        const double all = seconds_since(start), driver = Driver::seconds;
        glFinish();
        return {all - driver, driver, seconds_since(start) - all, uploads_, Driver::bytes};
    }

    Mesh mesh_;
    PlatformScope scope_;
    std::unique_ptr<Screen> screen_;
    Picture picture_;
    DisplaySettings settings_;
    Camera camera_;
    Uploads uploads_;
    double phase_ = 0.0;
};

template <typename Member>
double median(const std::vector<FrameCost>& frames, const Member& member) {
    std::vector<double> values;
    for (const FrameCost& frame : frames) values.push_back(member(frame));
    return quantile(values, 0.5);
}

template <typename Frame>
FrameCost add_frames(Report& report, const std::string& name, double target, const Frame& frame) {
    std::vector<FrameCost> frames;
    for (int i = 0; i < kFrames; ++i) frames.push_back(frame());
    const double own = median(frames, [](const FrameCost& f) { return 1e3 * f.own; });
    report.add({name + ", own work", own, "ms", target});
    const auto driver = [](const FrameCost& f) { return 1e3 * f.driver; };
    const auto rest = [](const FrameCost& f) { return 1e3 * f.rest; };
    report.add({name + ", the driver's calls", median(frames, driver), "ms"});
    report.add({name + ", the driver afterwards", median(frames, rest), "ms"});
    return frames.back();
}

void run_mesh(Report& report, Index vertices) {
    Stage stage(vertices);
    // libepoxy looks a function up when it is first called.
    stage.drag();
    time_driver();
    const bool is_large = vertices == kManyVertices;
    report.title("Frames of a mesh of " + stage.name() + " vertices, " + std::to_string(kWidth) +
                 " x " + std::to_string(kHeight));
    const FrameCost orbit =
        add_frames(report, "orbit of " + stage.name(), is_large ? -1.0 : kOrbitTarget,
                   [&] { return stage.orbit(); });
    report.add(
        {"orbit of " + stage.name() + ", sent", static_cast<double>(orbit.bytes), "bytes", 0.0});
    const FrameCost drag =
        add_frames(report, "drag of " + stage.name(), is_large ? kLargeDragTarget : kDragTarget,
                   [&] { return stage.drag(); });
    report.add(
        {"drag of " + stage.name() + ", sent", 1e-6 * static_cast<double>(drag.bytes), "MB"});
    report.add({"drag of " + stage.name() + ", sent / positions and normals of corners",
                static_cast<double>(drag.bytes) / stage.position_and_normal_bytes(), "x", 1.0});
    report.add({"drag of " + stage.name() + ", sent of colours and edges",
                static_cast<double>(drag.uploads.colors + drag.uploads.marks), "bytes", 0.0});
}

// ---- The program

// `lissom view` on the screen of this environment, of a file or of none, read line by line.
class ViewProgram {
  public:
    explicit ViewProgram(const std::string& file) : start_(Clock::now()) {
        int ends[2];
        if (pipe(ends) != 0) return;
        id_ = fork();
        if (id_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            close(ends[0]);
            execl(LISSOM_PROGRAM_FILE, "lissom", "view", "--tell", "--size", "1280x960",
                  file.empty() ? nullptr : file.c_str(), nullptr);
            _exit(127);
        }
        close(ends[1]);
        told_ = fdopen(ends[0], "r");
    }
    ~ViewProgram() {
        if (told_) std::fclose(told_);
        if (id_ <= 0) return;
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
    ViewProgram(const ViewProgram&) = delete;
    ViewProgram& operator=(const ViewProgram&) = delete;

    // Milliseconds from the start until it tells `text`; nothing where it ends before.
    std::optional<double> milliseconds_until(const std::string& text) {
        char line[256];
        while (told_ && std::fgets(line, sizeof line, told_)) {
            if (std::string(line).starts_with(text)) return 1e3 * seconds_since(start_);
        }
        return std::nullopt;
    }
    double megabytes() const {
        std::ifstream pages("/proc/" + std::to_string(id_) + "/statm");
        double size = 0.0, resident = 0.0;
        pages >> size >> resident;
        return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
    }

  private:
    Clock::time_point start_;
    pid_t id_ = -1;
    FILE* told_ = nullptr;
};

void run_program(Report& report) {
    report.title("The program: lissom view of a mesh of 43K vertices, 1280 x 960");
    const std::string file = (std::filesystem::temp_directory_path() /
                              ("lissom_view_bench_" + std::to_string(getpid()) + ".ply"))
                                 .string();
    const Mesh mesh = triangles_of(kVertices);
    save_mesh(mesh, file);
    std::vector<double> frames, meshes, memory;
    for (int i = 0; i < 5; ++i) {
        ViewProgram program(file);
        const auto frame = program.milliseconds_until("first frame");
        const auto shown = program.milliseconds_until("shown");
        if (!frame || !shown || !program.milliseconds_until("at rest")) break;
        frames.push_back(*frame);
        meshes.push_back(*shown);
        memory.push_back(program.megabytes());
    }
    std::filesystem::remove(file);
    if (memory.empty()) return report.line("  not measured: no screen; run under xvfb-run");
    report.add({"start to the first frame", quantile(frames, 0.5), "ms", kStartTarget});
    report.add({"start to the mesh in sight", quantile(meshes, 0.5), "ms"});
    ViewProgram empty({});
    if (empty.milliseconds_until("at rest")) {
        report.add({"memory of an empty window", empty.megabytes(), "MB", kMemoryTarget});
    }
    report.add({"memory with the mesh and its finished picture", quantile(memory, 0.5), "MB"});
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    try {
        for (const lissom::Index vertices :
             {lissom::bench::kVertices, lissom::bench::kManyVertices}) {
            lissom::bench::run_mesh(report, vertices);
        }
        lissom::bench::run_program(report);
    } catch (const lissom::Error& error) {
        std::fprintf(stderr, "bench_view: %s\n", error.what());
        return 1;
    }
    return 0;
}
