// What the window itself costs beside the driver: from an event to the last call of OpenGL, what is
// sent to the graphics card, the start of the program and its memory. The first two need no screen.
//
//     bench_view [--part=mesh|hair|tools|program] [--json]
#include <epoxy/gl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/sketch/navigation.h"
#include "tests/bench/report.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/render/draw/projection.h"
#include "viewer/render/gl/platform.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/driver_memory.h"
#include "viewer/window/screen/frame_times.h"
#include "viewer/window/screen/screen.h"
#include "viewer/window/session/session.h"

namespace lissom::bench {
namespace {

using namespace window;

constexpr Index kVertices = 43000, kManyVertices = 690000;
constexpr int kFrames = 31;
constexpr int kWidth = 1280, kHeight = 960;
// What the issue of the window asks for, in milliseconds and megabytes.
constexpr double kOrbitTarget = 1.0, kDragTarget = 3.0, kLargeDragTarget = 25.0;
constexpr double kSliceTarget = 30.0;
constexpr double kStrokeTarget = 0.5, kUndoTarget = 5.0;
constexpr double kRateTarget = 10.0, kLatencyTarget = 150.0;
constexpr double kStartTarget = 600.0, kMemoryTarget = 150.0;

// ---- The driver's part: calls that draw, copy, send or free. What this thread does is measured
// without the time in which it had no processor.

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
        const double start = thread_seconds();
        real(arguments...);
        Driver::seconds += thread_seconds() - start;
        using BufferData = std::tuple<GLenum, GLsizeiptr, const void*, GLenum>;
        using Volume = std::tuple<GLenum, GLint, GLint, GLsizei, GLsizei, GLsizei, GLint, GLenum,
                                  GLenum, const void*>;
        const std::tuple values(arguments...);
        if constexpr (std::is_same_v<std::tuple<Arguments...>, BufferData>) {
            Driver::bytes += static_cast<std::size_t>(std::get<1>(values));
        } else if constexpr (std::is_same_v<std::tuple<Arguments...>, Volume>) {
            Driver::bytes +=
                4 * at(std::get<3>(values)) * std::get<4>(values) * std::get<5>(values);
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
    Timed<epoxy_glTexImage3D>::install();
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
        show(std::make_shared<const Mesh>(mesh_));
        camera_ = quick_camera_of(picture_, snapshot_of(picture_), 1.0 * kWidth / kHeight);
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
    // What a script or a tool shows next: the same faces, moved. The worker froze it.
    FrameCost drag() {
        Mesh moved = mesh_;
        phase_ += 0.01;
        for (Vec3& p : moved.edit_positions()) p.x() += phase_ * p.y();
        const auto frozen = std::make_shared<const Mesh>(std::move(moved));
        return frame([&] { uploads_ = show(frozen); });
    }

  private:
    static Platform* platform() {
        static const std::unique_ptr<Platform> made = make_egl_platform();
        return made.get();
    }

    Uploads show(std::shared_ptr<const Mesh> mesh) {
        picture_.meshes = {{std::move(mesh)}};
        return screen_->update(quick_snapshot(picture_, settings_));
    }

    template <typename Event>
    FrameCost frame(const Event& event) {
        uploads_ = {};
        Driver::seconds = 0.0;
        Driver::bytes = 0;
        const double start = thread_seconds();
        event();
        screen_->draw(camera_, {0, 0, kWidth, kHeight}, background_of(settings_), 1);
        const double all = thread_seconds() - start, driver = Driver::seconds;
        const auto drawn = Clock::now();
        glFinish();
        return {all - driver, driver, seconds_since(drawn), uploads_, Driver::bytes};
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

// ---- Hair

// Strands of 32 points that hang from the upper half of a ball, on that ball.
Snapshot hairy_ball(Index count) {
    std::vector<float> points;
    std::vector<Index> offsets{0};
    for (Index s = 0; s < count; ++s) {
        Vec3 d = random_vector(7, s).normalized();
        d.y() = std::abs(d.y());
        for (int i = 0; i < 32; ++i) {
            const double t = i / 31.0;
            const Vec3 p = 0.1 * (1.0 + 0.15 * t) * d - Vec3(0.0, 0.22 * t * t, 0.0);
            for (const double x : p) points.push_back(static_cast<float>(x));
        }
        offsets.push_back(32 * (s + 1));
    }
    Snapshot snapshot;
    snapshot.strands = {{std::make_shared<const Strands>(std::move(points), std::move(offsets))}};
    DrawnMesh ball{std::make_shared<const Mesh>(make_sphere())};
    ball.transform.linear = 0.1 * Mat3::Identity();
    snapshot.meshes = {ball};
    return snapshot;
}

class HairStage {
  public:
    explicit HairStage(Index count) : scope_(*platform()), snapshot_(hairy_ball(count)) {
        screen_.update(snapshot_);
        const auto start = Clock::now();
        const DrawnStrands& drawn = snapshot_.strands[0];
        Hair hair{{{drawn, std::make_shared<const PackedStrands>(pack_strands(drawn))}},
                  std::make_shared<const HairLight>(snapshot_, Vec3::Zero())};
        made = seconds_since(start);
        const auto then = Clock::now();
        sent = screen_.set_hair(hair);
        glFinish();
        sending = seconds_since(then);
        camera_ = Camera({.eye = Vec3(0.3, 0.1, 0.65), .target = Vec3(0, -0.06, 0)});
        orbit();
    }

    FrameCost orbit() {
        camera_ = orbited({camera_, {1.0 * kWidth, 1.0 * kHeight}}, Vec2(3.0, 1.0));
        Driver::seconds = 0.0;
        Driver::bytes = 0;
        const double start = thread_seconds();
        // As the window draws where the driver is slow.
        screen_.draw(camera_, kCanvas, kWhite, 2);
        const double all = thread_seconds() - start, driver = Driver::seconds;
        const auto drawn = Clock::now();
        glFinish();
        return {all - driver, driver, seconds_since(drawn), {}, Driver::bytes};
    }
    // From rest to the last picture; seconds of the slices.
    std::vector<double> fill() {
        const Mat4 view = view_matrix(camera_, Vec3::Zero());
        Driver::bytes = 0;
        screen_.direct_light(screen_.hair().light()->directed(view.topLeftCorner<3, 3>()));
        rest_bytes = Driver::bytes;
        screen_.begin_fill(camera_, kCanvas, kWhite, 60.0);
        std::vector<double> slices;
        while (screen_.filling()) {
            screen_.fill();
            slices.push_back(screen_.slice_seconds());
        }
        return slices;
    }
    Index moving_strands() const { return screen_.moving_strands(); }
    double moving_seconds() const { return screen_.moving_seconds(); }

    double made = 0.0, sending = 0.0;
    std::size_t sent = 0, rest_bytes = 0;

  private:
    static constexpr Canvas kCanvas{0, 0, kWidth, kHeight};
    static Platform* platform() {
        static const std::unique_ptr<Platform> made = make_egl_platform();
        return made.get();
    }

    PlatformScope scope_;
    Screen screen_;
    Snapshot snapshot_;
    Camera camera_;
};

void run_hair(Report& report, Index count) {
    HairStage stage(count);
    time_driver();
    const std::string name = std::to_string(count / 1000) + "K strands";
    report.title("Hair of " + name + ", " + std::to_string(kWidth) + " x " +
                 std::to_string(kHeight));
    report.add({name + ", made ready beside the window", 1e3 * stage.made, "ms"});
    report.add({name + ", sent once", 1e-6 * static_cast<double>(stage.sent), "MB"});
    report.add({name + ", sending", 1e3 * stage.sending, "ms"});
    for (int i = 0; i < 10; ++i) stage.orbit();
    const FrameCost orbit =
        add_frames(report, "orbit of " + name, kOrbitTarget, [&] { return stage.orbit(); });
    std::vector<double> moving;
    for (int i = 0; i < kFrames; ++i) {
        stage.orbit();
        moving.push_back(1e3 * stage.moving_seconds());
    }
    report.add({"orbit of " + name + ", the few strands", quantile(moving, 0.5), "ms"});
    report.add({"orbit of " + name + ", number of these", 1.0 * stage.moving_strands(), ""});
    report.add({"orbit of " + name + ", sent", static_cast<double>(orbit.bytes), "bytes", 0.0});
    const auto start = Clock::now();
    const std::vector<double> slices = stage.fill();
    report.add({name + " at rest, until all are there", seconds_since(start), "s"});
    report.add({name + " at rest, longest slice",
                1e3 * *std::max_element(slices.begin(), slices.end()), "ms", kSliceTarget});
    report.add({name + " at rest, median slice", 1e3 * quantile(slices, 0.5), "ms"});
    report.add({name + " at rest, sent once", 1e-6 * static_cast<double>(stage.rest_bytes), "MB"});
}

// ---- Tools: what a session does from an event to what is to be drawn, without a window

// Milliseconds of all threads of this process; the one that waits sleeps.
class ToolRun {
  public:
    ToolRun(const std::string& file, const std::string& tool)
        : session_(program_, [this] { wake(); }, {.tool = tool}) {
        session_.open({file});
        wait();
        ToolInput look;
        look.kind = ToolInput::Kind::look;
        look.size = {kWidth, kHeight};
        const Vec3 center = bounds_.center();
        const double away = 2.0 * bounds_.diagonal();
        camera_ = Camera({.eye = center + Vec3(0.0, 0.0, away), .target = center});
        look.camera = camera_;
        session_.post(look);
        wait();
    }

    double post(ToolInput::Kind kind, double x = 0.0, double y = 0.0, const char* key = "") {
        ToolInput input;
        input.kind = kind;
        input.at = {x, y};
        input.key = key;
        const std::clock_t start = std::clock();
        session_.post(input);
        wait();
        return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    // The median of events between a press and a release.
    double drag(const Vec2& from, const Vec2& step) {
        post(ToolInput::Kind::press, from.x(), from.y());
        std::vector<double> times;
        for (int i = 1; i <= kFrames; ++i) {
            const Vec2 at = from + i * step;
            times.push_back(post(ToolInput::Kind::move, at.x(), at.y()));
        }
        const Vec2 end = from + kFrames * step;
        release_ = post(ToolInput::Kind::release, end.x(), end.y());
        return quantile(times, 0.5);
    }
    double release() const { return release_; }
    // A stroke over the surface at this part of its height.
    void paint(double part) {
        const Vec3 middle = bounds_.center();
        const double y = bounds_.min.y() + part * (bounds_.max.y() - bounds_.min.y());
        const Vec3 at = camera_.project({middle.x(), y, middle.z()}, {1.0 * kWidth, 1.0 * kHeight});
        post(ToolInput::Kind::press, at.x() - 40.0, at.y());
        post(ToolInput::Kind::move, at.x() + 40.0, at.y());
        post(ToolInput::Kind::release, at.x() + 40.0, at.y());
    }
    void print_errors() {
        for (const ConsoleLine& line : session_.take_lines()) {
            if (line.kind == LineKind::error) std::fprintf(stderr, "%s\n", line.text.c_str());
        }
    }

  private:
    void wake() {
        const std::lock_guard lock(mutex_);
        woken_ = true;
        news_.notify_one();
    }
    // Sleeps until there is something new, and then until the work has ended that told it.
    void wait() {
        {
            std::unique_lock lock(mutex_);
            news_.wait_for(lock, std::chrono::milliseconds(20), [&] { return woken_; });
            woken_ = false;
        }
        while (session_.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(3));
        if (const auto shown = session_.take_shown()) bounds_ = shown->bounds;
    }

    cli::ProgramParts parts_ = [] {
        cli::ProgramParts parts = cli::kernel_parts();
        parts.libraries.push_back(lua::viewer_library);
        return parts;
    }();
    cli::Program program_{parts_};
    std::mutex mutex_;
    std::condition_variable news_;
    bool woken_ = false;
    Session session_;
    Box bounds_;
    Camera camera_;
    double release_ = 0.0;
};

void run_tools(Report& report) {
    using Kind = ToolInput::Kind;
    report.title(
        "Tools on a mesh of 43K vertices: milliseconds of processors from an event to what is "
        "drawn");
    const std::string file = (std::filesystem::temp_directory_path() /
                              ("lissom_tool_bench_" + std::to_string(getpid()) + ".ply"))
                                 .string();
    save_mesh(triangles_of(kVertices), file);
    {
        ToolRun run(file, "select");
        report.add(
            {"an event of a stroke", run.drag({600.0, 300.0}, {2.0, 8.0}), "ms", kStrokeTarget});
        run.print_errors();
    }
    ToolRun run(file, "deform");
    run.paint(0.06);
    run.post(Kind::key, 0.0, 0.0, "p");
    run.paint(0.94);
    run.post(Kind::key, 0.0, 0.0, "enter");
    for (const char* key : {"w", "x", "1", "enter"}) run.post(Kind::key, 0.0, 0.0, key);
    std::vector<double> undo, redo;
    for (int i = 0; i < 5; ++i) {
        undo.push_back(run.post(Kind::undo));
        redo.push_back(run.post(Kind::redo));
    }
    report.add({"undo of a deformation", quantile(undo, 0.5), "ms", kUndoTarget});
    report.add({"redo of a deformation", quantile(redo, 0.5), "ms"});
    run.print_errors();
    std::filesystem::remove(file);
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
    // The next line that has `text` in it.
    std::optional<std::string> line_with(const std::string& text) {
        char line[256];
        while (told_ && std::fgets(line, sizeof line, told_)) {
            if (std::string(line).find(text) != std::string::npos) return line;
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

// Turns the picture by a hand made by xdotool, and closes the window. Frames a second, and the
// 95th percentile of milliseconds from an event to its frame.
std::optional<std::pair<double, double>> turn_by_hand(ViewProgram& program) {
    const char* const hand =
        "exec 2>/dev/null; window=$(timeout 20 xdotool search --sync --onlyvisible --name "
        "lissom | "
        "head -n 1);"
        "xdotool mousemove --window \"$window\" 600 300 mousedown 1 || exit 1;"
        "for i in $(seq 100); do xdotool mousemove_relative -- 4 1; sleep 0.03; done;"
        "xdotool mouseup 1 key ctrl+q";
    if (std::system(hand) != 0) return std::nullopt;
    const auto line = program.line_with("frames a second");
    if (!line) return std::nullopt;
    double latency = 0.0, rate = 0.0;
    const std::size_t place = line->find("95 % ");
    const char* const rest = place == std::string::npos ? "" : line->c_str() + place;
    if (std::sscanf(rest, "95 %% %lf ms, %lf", &latency, &rate) != 2) return std::nullopt;
    return std::pair(rate, latency);
}

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
    if (!memory.empty()) {
        ViewProgram program(file);
        const bool rests = program.milliseconds_until("at rest").has_value();
        const auto turned = rests ? turn_by_hand(program) : std::nullopt;
        if (turned) {
            report.add({"frames a second while it is turned", turned->first, "", kRateTarget,
                        Better::more});
            report.add({"event to frame, 95th percentile", turned->second, "ms", kLatencyTarget});
        } else {
            report.line("  turning not measured: no xdotool");
        }
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
    // As the program does.
    lissom::window::keep_driver_memory();
    lissom::bench::Report report(argc, argv);
    try {
        if (report.wants("mesh")) {
            lissom::bench::run_mesh(report, lissom::bench::kVertices);
            lissom::bench::run_mesh(report, lissom::bench::kManyVertices);
        }
        if (report.wants("hair")) {
            for (const int strands : {20000, 100000}) lissom::bench::run_hair(report, strands);
        }
        if (report.wants("tools")) lissom::bench::run_tools(report);
        if (report.wants("program")) lissom::bench::run_program(report);
    } catch (const lissom::Error& error) {
        std::fprintf(stderr, "bench_view: %s\n", error.what());
        return 1;
    }
    return 0;
}
