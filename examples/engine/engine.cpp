// A small engine with the library in it, and its own threads, log, files and frames. It loads a
// script as a tool, lets the library work as jobs between its frames, drags handles through the
// basis in a vertex shader, bends a textured model with a seam, and draws strands.
//
// clang-format off
//     engine examples/engine                         # a window: drag the cactus; Escape ends it
//     engine examples/engine --last last.png         # and its last frame is saved
//     engine examples/engine --picture engine.png    # without a window: sixty frames of a drag
// clang-format on
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "drawing.h"
#include "host.h"
#include "screen.h"
#include "textured.h"

namespace engine {
namespace {

namespace api = lissom::api;

// ---- Loading

std::string read_disk(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + " cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

void fill(Files& files, const std::string& folder) {
    for (const char* name : {"scene.lua", "basis.vert"})
        files.add(name, read_disk(folder + "/" + name));
    files.add("ground.obj", "v -0.6 0 -0.6\nv -0.6 0 0.6\nv 0.6 0 0.6\nv 0.6 0 -0.6\nf 1 2 3 4\n");
}

// The objects that a script returned, in order: {"object": ID, ...}.
std::vector<std::uint64_t> objects_in(const lissom_bytes& json) {
    static constexpr char kKey[] = "\"object\":";
    std::vector<std::uint64_t> ids;
    for (const char* at = static_cast<const char*>(json.data); (at = std::strstr(at, kKey));) {
        ids.push_back(std::strtoull(at += sizeof kKey - 1, nullptr, 10));
    }
    return ids;
}

std::vector<std::uint64_t> run_tool(const api::Context& context, const Files& files) {
    const std::string& text = *files.find("scene.lua");
    lissom_script script{};
    lissom_bytes json{};
    api::check(context.get(),
               lissom_script_load(context.get(), text.data(), text.size(), "scene.lua", &script));
    api::check(context.get(), lissom_script_set(context.get(), script, "vertices", "8000"));
    api::check(context.get(), lissom_script_run(context.get(), script, nullptr, &json));
    const std::vector<std::uint64_t> objects = objects_in(json);
    api::check(context.get(), lissom_script_release(context.get(), script));
    if (objects.size() != 4)
        throw std::runtime_error("the script returns other things than the engine draws");
    return objects;
}

// ---- Views: turned about y, seen from a little above, scaled, moved on the screen.

constexpr double kTilt = 0.25;

Matrix view(double turn, double scale, double right, double up,
            const double (&middle)[3] = {0, 0, 0}) {
    const double c = std::cos(turn), s = std::sin(turn), wide = double(kHeight) / kWidth;
    const double up_down = std::cos(kTilt), over = std::sin(kTilt);
    const double rows[3][4] = {
        {wide * scale * c, 0, wide * scale * s, right},
        {over * scale * s, up_down * scale, -over * scale * c, up},
        {0.3 * up_down * scale * s, -0.3 * over * scale, -0.3 * up_down * scale * c, 0}};
    Matrix matrix{};
    matrix[15] = 1.0f;
    for (std::size_t i = 0; i < 3; ++i) {
        double moved = rows[i][3];
        for (std::size_t k = 0; k < 3; ++k) {
            matrix[4 * k + i] = static_cast<float>(rows[i][k]);
            moved += rows[i][k] * middle[k];
        }
        matrix[12 + i] = static_cast<float>(moved);
    }
    return matrix;
}

// ---- A surface that handles move

class Puppet {
  public:
    Puppet(const api::Context& context, std::uint64_t mesh, std::uint64_t deformer)
        : context_(context), mesh_(context.get(), {mesh}), deformer_{deformer} {
        api::check(context.get(),
                   lissom_deformer_begin_prepare(context.get(), deformer_, &preparing_));
    }
    ~Puppet() { lissom_deformer_release(context_.get(), deformer_); }

    // Once the job is done the basis goes to the graphics card: from then on the library is not
    // called.
    void take_up(const std::string& vertex_shader) {
        lissom_job_state state = LISSOM_JOB_RUNNING;
        if (surface_) return;
        api::check(context_.get(), lissom_job_poll(context_.get(), preparing_, &state));
        if (state != LISSOM_JOB_DONE) return;
        api::check(context_.get(), lissom_job_finish(context_.get(), preparing_, nullptr));
        lissom_bytes bytes{};
        api::check(context_.get(), lissom_deformer_encode_basis(context_.get(), deformer_, &bytes));
        memory_.resize((bytes.size + 3) / 4);
        std::memcpy(memory_.data(), bytes.data, bytes.size);
        if (lissom_basis_open(&basis_, memory_.data(), bytes.size) != LISSOM_BASIS_OK)
            throw std::runtime_error("the basis is damaged");
        transforms_.resize(12 * std::size_t{basis_.handle_count});
        for (std::uint32_t h = 0; h < basis_.handle_count; ++h) place(h, lissom_identity());
        surface_.emplace(mesh_, vertex_shader, &basis_);
    }
    bool is_ready() const { return surface_.has_value(); }
    const lissom_basis& basis() const { return basis_; }

    void place(std::uint32_t handle, const lissom_transform& map) {
        lissom_basis_local(&basis_, map.m, &transforms_[12 * std::size_t{handle}]);
    }
    void draw(const Matrix& to_clip, const Color& color) const {
        if (surface_) surface_->draw(to_clip, color, transforms_.data());
    }

    // Returns the greatest difference between the results of the basis and of the library's
    // preview, in sizes of the surface.
    double difference(std::uint32_t handle, const lissom_transform& map) {
        lissom_context* const context = context_.get();
        api::check(context,
                   lissom_deformer_set_transform(context, deformer_, std::int32_t(handle), &map));
        api::check(context, lissom_deformer_solve(context, deformer_, LISSOM_PREVIEW));
        const std::size_t rows = basis_.vertex_count;
        std::vector<float> own(3 * rows), library(3 * rows);
        lissom_basis_evaluate(&basis_, transforms_.data(), 0, basis_.vertex_count, own.data(),
                              3 * sizeof(float));
        const lissom_output out = api::output(library.data(), rows);
        api::check(context, lissom_deformer_read_positions(context, deformer_, &out));
        double greatest = 0.0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const double moved = own[i] + basis_.origin[i % 3] - library[i];
            greatest = std::max(greatest, std::abs(moved) / double(basis_.size));
        }
        return greatest;
    }

  private:
    const api::Context& context_;
    api::Mesh mesh_;
    lissom_deformer deformer_;
    lissom_job preparing_{};
    std::vector<float> memory_, transforms_;
    lissom_basis basis_{};
    std::optional<Surface> surface_;
};

// ---- Hair that grows as a job

class Head {
  public:
    Head(const api::Context& context, std::uint64_t mesh, std::uint64_t style)
        : context_(context),
          style_{style},
          mesh_(context.get(), {mesh}),
          surface_(mesh_, kStanding) {
        lissom_grow_options options = lissom_default_grow_options();
        options.count = 6000;
        options.length = 0.25;
        api::check(context.get(),
                   lissom_hairstyle_begin_grow(context.get(), style_, &options, &growing_));
    }
    ~Head() { lissom_hairstyle_release(context_.get(), style_); }

    void take_up() {
        lissom_job_state state = LISSOM_JOB_RUNNING;
        if (hair_) return;
        api::check(context_.get(), lissom_job_poll(context_.get(), growing_, &state));
        if (state != LISSOM_JOB_DONE) return;
        std::uint64_t id = 0;
        api::check(context_.get(), lissom_job_finish(context_.get(), growing_, &id));
        hair_.emplace(api::Strands(context_.get(), {id}));
    }
    bool is_ready() const { return hair_.has_value(); }
    void draw(const Matrix& to_clip) const {
        surface_.draw(to_clip, {0.85f, 0.82f, 0.78f});
        if (hair_) hair_->draw(to_clip, {0.42f, 0.26f, 0.14f});
    }

    static constexpr const char* kStanding = R"(
layout(location = 0) in vec3 rest;
uniform mat4 to_clip;
out vec3 surface_position;
void main() {
    surface_position = rest;
    gl_Position = to_clip * vec4(rest, 1.0);
})";

  private:
    const api::Context& context_;
    lissom_hairstyle style_;
    lissom_job growing_{};
    api::Mesh mesh_;
    Surface surface_;
    std::optional<Hair> hair_;
};

// ---- Frames

// Moves of the handles by a hand: each continues from its last place.
class Drag {
  public:
    std::optional<std::uint32_t> handle;

    const lissom_transform& map() const { return maps_[*handle]; }

    // Moves the handle nearest to the press with the hand.
    void follow(const Hand& hand, const lissom_basis& basis, const Matrix& to_clip) {
        if (!hand.is_down) handle.reset();
        if (!hand.is_down) return;
        if (!handle) grip(hand, basis, to_clip);
        lissom_transform& map = maps_[*handle];
        map.m[3] = before_.m[3] + (hand.x - pressed_.x) / double(to_clip[0]);
        map.m[7] = before_.m[7] + (hand.y - pressed_.y) / double(to_clip[5]);
    }

  private:
    void grip(const Hand& hand, const lissom_basis& basis, const Matrix& to_clip) {
        maps_.resize(basis.handle_count, lissom_identity());
        double nearest = 1e9;
        for (std::uint32_t h = 0; h < basis.handle_count; ++h) {
            const float* center = basis.handles[h].center;
            const double px = center[0] + maps_[h].m[3], py = center[1] + maps_[h].m[7],
                         pz = center[2];
            const double x = to_clip[0] * px + to_clip[8] * pz + double(to_clip[12]) - hand.x;
            const double y =
                to_clip[1] * px + to_clip[5] * py + to_clip[9] * pz + double(to_clip[13]) - hand.y;
            if (x * x + y * y >= nearest) continue;
            nearest = x * x + y * y;
            handle = h;
        }
        pressed_ = hand;
        before_ = maps_[*handle];
    }

    std::vector<lissom_transform> maps_;
    Hand pressed_;
    lissom_transform before_ = lissom_identity();
};

// Returns the place of the tip in a picture without a hand: turned by `angle` about the middle of
// the trunk.
lissom_transform turned(double angle, double height) {
    const double c = std::cos(angle), s = std::sin(angle);
    lissom_transform map = lissom_identity();
    map.m[0] = c, map.m[1] = -s, map.m[3] = s * height;
    map.m[4] = s, map.m[5] = c, map.m[7] = height - c * height;
    return map;
}

struct World {
    World(const api::Context& context, const Files& files,
          const std::vector<std::uint64_t>& objects)
        : vertex_shader(*files.find("basis.vert")),
          cactus(context, objects[0], objects[1]),
          head(context, objects[2], objects[3]),
          ground(context.load_mesh("ground.obj"), Head::kStanding),
          chimney(context) {}

    // The part of the frame for the library: finished results are taken up.
    void take_up() {
        cactus.take_up(vertex_shader);
        head.take_up();
    }
    bool is_ready() const { return cactus.is_ready() && head.is_ready(); }
    Matrix cactus_view() const {
        const double* origin = cactus.basis().origin;
        return view(0.4, 0.75, -0.45, -0.75, {origin[0], origin[1], origin[2]});
    }
    void draw() const {
        clear_picture();
        ground.draw(view(0.4, 0.75, -0.45, -0.75), {0.55f, 0.5f, 0.42f});
        if (cactus.is_ready()) cactus.draw(cactus_view(), {0.35f, 0.6f, 0.3f});
        head.draw(view(0.5, 3.2, 0.45, 0.15));
        chimney.draw(view(-0.4, 0.55, 0.0, -0.85));
    }

    std::string vertex_shader;
    Puppet cactus;
    Head head;
    Surface ground;
    Textured chimney;
};

// Draws until the window is closed; returns whether the last frame could be saved, if asked for.
bool play(World& world, Screen& screen, const std::string& last) {
    Drag drag;
    bool was_ready = false;
    int frame = 0;
    for (Hand hand; !hand.has_closed; hand = screen.hand()) {
        world.take_up();
        if (world.cactus.is_ready()) drag.follow(hand, world.cactus.basis(), world.cactus_view());
        if (drag.handle) world.cactus.place(*drag.handle, drag.map());
        world.chimney.bend(0.9 * std::sin(0.02 * ++frame));
        world.draw();
        screen.show();
        if (world.is_ready() && !was_ready) std::puts("ready");
        was_ready = world.is_ready();
        std::fflush(stdout);
    }
    // Upright, however many frames were drawn.
    world.chimney.settle();
    world.chimney.bend(0.0);
    world.chimney.settle();
    world.draw();
    return last.empty() || save_picture(last);
}

// Draws sixty frames of a drag once all is there; returns whether the last one equals the library's
// result.
bool draw_picture(World& world, Screen& screen, const std::string& path) {
    int waited = 0;
    for (; !world.is_ready(); ++waited) {
        world.take_up();
        world.draw();
        screen.show();
    }
    const std::uint32_t tip = 1;  // the second handle that scene.lua adds
    if (tip >= world.cactus.basis().handle_count) throw std::runtime_error("the cactus has no tip");
    lissom_transform map = lissom_identity();
    for (int frame = 1; frame <= 60; ++frame) {
        map = turned(-0.8 * frame / 60.0, 0.9);
        world.cactus.place(tip, map);
        world.chimney.bend(0.9 * frame / 60.0);
        world.draw();
        screen.show();
    }
    world.chimney.settle();
    world.chimney.bend(0.9);
    world.chimney.settle();
    world.draw();
    std::printf("%d frames of %zu render vertices on %d of the mesh\n", world.chimney.frames(),
                world.chimney.render_vertices(), world.chimney.mesh_vertices());
    const double difference = world.cactus.difference(tip, map);
    std::printf(
        "%d frames while the library worked, 60 of a drag; difference from the library %.1e\n",
        waited, difference);
    return save_picture(path) && difference < 1e-5;
}

int run(const std::string& folder, const std::string& mode, const std::string& file) {
    const bool has_window = mode != "--picture";
    const std::unique_ptr<Screen> screen = has_window ? open_window() : open_memory();
    if (!screen) {
        std::puts("no OpenGL 3.3 here");
        return 77;
    }
    Host host;
    fill(host.files, folder);
    bool good = true;
    {
        const api::Context context(options_for(host));
        World world(context, host.files, run_tool(context, host.files));
        good = has_window ? play(world, *screen, file) : draw_picture(world, *screen, file);
    }
    for (const std::string& line : host.log) std::printf("log: %s\n", line.c_str());
    std::printf("%zu tasks of the job system\n", host.jobs.count());
    return good ? 0 : 1;
}

}  // namespace
}  // namespace engine

int main(int count, char** arguments) {
    const std::string mode = count == 4 ? arguments[2] : "";
    if (count != 2 && mode != "--picture" && mode != "--last") {
        std::fputs("usage: engine FOLDER [--picture FILE.png | --last FILE.png]\n", stderr);
        return 2;
    }
    try {
        return engine::run(arguments[1], mode, count == 4 ? arguments[3] : "");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
