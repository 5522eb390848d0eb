#include "viewer/render/gl/gpu_scene.h"

#include <random>
#include <thread>
#include <utility>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/scene_drawer.h"

using namespace lissom;
using test::shared;

namespace {

using BufferData = void(EPOXY_CALLSPEC*)(GLenum, GLsizeiptr, const void*, GLenum);
using BufferSubData = void(EPOXY_CALLSPEC*)(GLenum, GLintptr, GLsizeiptr, const void*);

// Counts the bytes that calls of OpenGL send to buffers, as long as it lives. libepoxy puts the
// driver's functions into these pointers when they are first called.
class CountedCalls {
  public:
    CountedCalls() : data_(epoxy_glBufferData), sub_data_(epoxy_glBufferSubData) {
        current_ = this;
        epoxy_glBufferData = &count_data;
        epoxy_glBufferSubData = &count_sub_data;
    }
    ~CountedCalls() {
        epoxy_glBufferData = data_;
        epoxy_glBufferSubData = sub_data_;
        current_ = nullptr;
    }
    CountedCalls(const CountedCalls&) = delete;
    CountedCalls& operator=(const CountedCalls&) = delete;

    std::size_t bytes = 0;
    int calls = 0;

  private:
    static void EPOXY_CALLSPEC count_data(GLenum target, GLsizeiptr size, const void* data,
                                          GLenum usage) {
        current_->bytes += static_cast<std::size_t>(size);
        ++current_->calls;
        current_->data_(target, size, data, usage);
    }
    static void EPOXY_CALLSPEC count_sub_data(GLenum target, GLintptr offset, GLsizeiptr size,
                                              const void* data) {
        current_->bytes += static_cast<std::size_t>(size);
        ++current_->calls;
        current_->sub_data_(target, offset, size, data);
    }

    static inline CountedCalls* current_ = nullptr;
    BufferData data_;
    BufferSubData sub_data_;
};

// A context that is current, with a scene and what draws it.
struct Stage {
    explicit Stage(Platform& platform) : scope(platform) {
        const GLuint warm = gl::make_vertex_buffer({}).id();
        REQUIRE(warm != 0);
    }

    // Updates, and checks the account against the calls that were made.
    Uploads update(const Snapshot& snapshot, const Context& context = {}) {
        const CountedCalls counted;
        const Uploads uploads = scene.update(snapshot, context);
        CHECK(uploads.bytes() == counted.bytes);
        CHECK(uploads.calls == counted.calls);
        return uploads;
    }
    Image draw(const Camera& camera = test::front_camera(4.0)) const {
        RenderOptions options = test::small_options();
        options.occlusion = 1.0;
        return draw_scene(tools, scene, camera, options);
    }
    // The picture of a scene that never was anything else.
    Image draw_fresh(const Snapshot& snapshot) const {
        GpuScene fresh;
        fresh.update(snapshot);
        RenderOptions options = test::small_options();
        options.occlusion = 1.0;
        return draw_scene(tools, fresh, test::front_camera(4.0), options);
    }

    PlatformScope scope;
    SceneTools tools;
    GpuScene scene;
};

// Mean difference of a byte.
double mean_difference(const Image& a, const Image& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    }
    return sum / static_cast<double>(a.rgba.size());
}

Mesh stretched(const Mesh& mesh, double factor) {
    Mesh result = mesh;
    for (Vec3& p : result.edit_positions()) p.x() *= factor;
    return result;
}

std::size_t corners(const Mesh& mesh) {
    return 3 * triangulate_faces(mesh.topology(), mesh.positions()).triangles.size();
}

Overlay line_to(const Vec3& end) {
    return {.lines = {{{Vec3::Zero(), end}}}, .points = {{end}}};
}

// Whether the buffers of a surface are still on the card.
bool alive(GLuint buffer) {
    return glIsBuffer(buffer) == GL_TRUE;
}

}  // namespace

TEST_CASE("a scene: where only the camera moves, nothing is uploaded") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    Snapshot snapshot{.meshes = {{shared(make_torus())}},
                      .overlays = test::marks(line_to(Vec3(1, 1, 0)))};
    snapshot.revision = 7;
    CHECK(stage.update(snapshot).bytes() > 0);
    const Image first = stage.draw();
    const CountedCalls counted;
    const Image other = stage.draw(Camera({.eye = Vec3(5, 3, 2)}));
    CHECK(test::difference(first, other) > 50);
    CHECK(stage.scene.update(snapshot).bytes() == 0);
    CHECK(stage.draw() == first);
    // Told apart by their contents alone, too.
    snapshot.revision = 0;
    CHECK(stage.scene.update(snapshot).bytes() == 0);
    CHECK(stage.draw() == first);
    CHECK(counted.bytes == 0);
}

TEST_CASE("a scene: where vertices move, positions and normals alone are uploaded") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const Mesh ball = make_sphere({.segments = 12, .kind = SphereKind::triangles});
    MeshStyle style;
    style.region = Region::all(ball.shared_topology());
    style.handles = {Region(ball.shared_topology(), {0, 1, 2})};
    const auto mark = shared(line_to(Vec3(0, 1, 0)));
    const auto snapshot = [&](const Mesh& mesh) {
        return Snapshot{.meshes = {{shared(mesh), style}}, .overlays = {mark}};
    };
    const Uploads first = stage.update(snapshot(ball));
    CHECK(first.vertices == corners(ball) * sizeof(SurfaceVertex));
    CHECK(first.colors == corners(ball) * sizeof(SurfaceColor));
    CHECK(first.marks > 0);
    const Image before = stage.draw();
    const Uploads second = stage.update(snapshot(stretched(ball, 1.3)));
    CHECK(second.vertices == first.vertices);
    CHECK(second.colors == 0);
    CHECK(test::difference(before, stage.draw()) > 50);
    CHECK(mean_difference(stage.draw(), stage.draw_fresh(snapshot(stretched(ball, 1.3)))) < 0.02);
    stage.update(snapshot(ball));
    CHECK(stage.draw() == before);
}

TEST_CASE("a scene: what moves fast sends the same, and looks nearly the same") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const Mesh ball = make_sphere({.segments = 24}), box = make_box();
    for (const Mesh* mesh : {&ball, &box}) {
        for (const Shading shading : {Shading::smooth, Shading::flat}) {
            for (const double side : {1.0, -1.0}) {
                CAPTURE(side);
                Stage stage(*platform);
                const auto shown = [&](double factor) {
                    DrawnMesh drawn{shared(stretched(*mesh, factor))};
                    drawn.style.shading = shading;
                    drawn.transform.linear = Vec3(side, 1.0, 1.0).asDiagonal();
                    return Snapshot{.meshes = {drawn}};
                };
                stage.update(shown(1.0));
                for (const double factor : {1.1, 1.2, 1.3}) {
                    const CountedCalls counted;
                    const Uploads uploads =
                        stage.scene.update(shown(factor), {}, MovedVertices::quick);
                    CHECK(uploads.bytes() == counted.bytes);
                    // The first time all normals are found exactly.
                    const std::size_t each =
                        factor == 1.1 ? sizeof(SurfaceVertex) : sizeof(QuickVertex);
                    CHECK(uploads.bytes() == corners(*mesh) * each);
                }
                REQUIRE(stage.scene.surfaces().front()->groups);
                CHECK(mean_difference(stage.draw(), stage.draw_fresh(shown(1.3))) < 0.5);
                // Another shading, mirror or mesh is made exactly.
                DrawnMesh other = shown(1.0).meshes[0];
                other.transform.linear = Vec3(-side, 1.0, 1.0).asDiagonal();
                stage.scene.update({.meshes = {other}}, {}, MovedVertices::quick);
                CHECK(stage.draw() == stage.draw_fresh({.meshes = {other}}));
            }
        }
    }
}

TEST_CASE("a scene: what was prepared elsewhere is sent as it is, and moves fast from then on") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform), plain(*platform);
    const auto show = [&](const Snapshot& snapshot) {
        const std::vector<SurfaceNeeds> needs = stage.scene.needs(snapshot);
        std::vector<PreparedSurface> prepared;
        // By another thread, without a context.
        std::thread([&] {
            for (const SurfaceNeeds& one : needs) prepared.push_back(prepare(one));
        }).join();
        const Uploads sent = stage.scene.update_with(prepared, snapshot, {}, MovedVertices::quick);
        plain.scene.update(snapshot, {}, MovedVertices::quick);
        return std::pair(needs.size(), sent);
    };
    const Mesh ball = make_sphere({.segments = 24});
    DrawnMesh drawn{shared(ball)};
    drawn.transform.linear = Vec3(-1.0, 1.0, 1.0).asDiagonal();
    const auto [first, all] = show({.meshes = {drawn}});
    CHECK(first == 1);
    CHECK(all.vertices == corners(ball) * sizeof(SurfaceVertex));
    CHECK(stage.draw() == plain.draw());
    CHECK(show({.meshes = {drawn}}).first == 0);
    // It moves: what is prepared and sent is that of a mesh that moves.
    drawn.mesh = shared(stretched(ball, 1.2));
    CHECK(stage.scene.needs({.meshes = {drawn}}).front().groups != nullptr);
    const auto [moved, positions] = show({.meshes = {drawn}});
    CHECK(moved == 1);
    CHECK(positions.bytes() == corners(ball) * sizeof(QuickVertex));
    CHECK(mean_difference(stage.draw(), stage.draw_fresh({.meshes = {drawn}})) < 0.5);
    // Colours alone, then another shading and another mesh.
    drawn.style.region = Region(drawn.mesh->shared_topology(), {0, 1, 2, 3, 4, 5});
    const auto [colored, colors] = show({.meshes = {drawn}});
    CHECK(colored == 1);
    CHECK(colors.bytes() == colors.colors);
    drawn.style.region.reset();
    drawn.style.shading = Shading::flat;
    CHECK(show({.meshes = {drawn}}).first == 1);
    CHECK(mean_difference(stage.draw(), stage.draw_fresh({.meshes = {drawn}})) < 0.02);
    drawn.mesh = shared(make_torus());
    CHECK(show({.meshes = {drawn}}).first == 1);
    CHECK(mean_difference(stage.draw(), stage.draw_fresh({.meshes = {drawn}})) < 0.02);
}

TEST_CASE("a scene: what is sent in pieces is what is sent at once, and no piece is large") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform), at_once(*platform);
    const Mesh ball = make_cactus({.vertices = 20000});
    DrawnMesh drawn{shared(ball)};
    drawn.style.boundaries = drawn.style.vertex_normals = true;
    DrawnMesh torus{shared(make_torus())};
    torus.object = 1;
    for (const double factor : {1.0, 1.3, 0.8}) {
        drawn.mesh = shared(stretched(ball, factor));
        const Snapshot snapshot{.meshes = {drawn, torus}};
        std::vector<PreparedSurface> prepared;
        std::size_t bytes = 0;
        for (const SurfaceNeeds& one : stage.scene.needs(snapshot)) {
            prepared.push_back(prepare(one));
            bytes += std::as_bytes(std::span(prepared.back().vertices)).size() +
                     std::as_bytes(std::span(prepared.back().quick)).size() +
                     std::as_bytes(std::span(prepared.back().colors)).size();
        }
        const Uploads all = at_once.scene.update_with(prepared, snapshot, {}, MovedVertices::quick);
        CHECK(all.vertices + all.colors == bytes);
        PieceSender sender(std::move(prepared));
        while (true) {
            const CountedCalls counted;
            if (!sender.send()) break;
            CHECK(counted.calls == 1);
            CHECK(counted.bytes <= 3 * kTrianglesOfBuffer * sizeof(SurfaceVertex));
        }
        const CountedCalls counted;
        const Uploads sent =
            stage.scene.update_with(sender.surfaces(), snapshot, {}, MovedVertices::quick);
        CHECK(sent.vertices + sent.colors == bytes);
        // Marks alone.
        CHECK(counted.bytes == sent.marks);
        // Elsewhere from now on: what is on the card stays.
        std::thread([surfaces = sender.give_away()]() mutable { surfaces.clear(); }).join();
        CHECK_FALSE(sender.send());
        CHECK(stage.draw() == at_once.draw());
    }
}

TEST_CASE("a scene: what was prepared for something else is not sent") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const Snapshot ball{.meshes = {{shared(make_sphere())}}};
    const Snapshot torus{.meshes = {{shared(make_torus())}}};
    const std::vector<PreparedSurface> prepared{prepare(stage.scene.needs(ball)[0])};
    stage.scene.update_with(prepared, torus, {}, MovedVertices::quick);
    CHECK(stage.draw() == stage.draw_fresh(torus));
    // Prepared about another origin.
    DrawnMesh far = ball.meshes[0];
    far.transform.translation = Vec3(1e4, 0.0, 0.0);
    stage.scene.update_with(prepared, {.meshes = {far}}, {}, MovedVertices::quick);
    CHECK(stage.scene.surfaces().front()->drawn.transform == far.transform);
    stage.scene.update_with(prepared, ball, {}, MovedVertices::quick);
    CHECK(stage.draw() == stage.draw_fresh(ball));
}

TEST_CASE("a scene: the same faces made again move as those of one topology") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    stage.update({.meshes = {{shared(make_sphere({.kind = SphereKind::triangles}))}}});
    Mesh again = make_sphere({.kind = SphereKind::triangles});
    for (Vec3& p : again.edit_positions()) p.y() *= 1.3;
    CHECK(stage.update({.meshes = {{shared(again)}}}).colors == 0);
    CHECK(mean_difference(stage.draw(), stage.draw_fresh({.meshes = {{shared(again)}}})) < 0.02);
}

TEST_CASE("a scene: a mesh that is changed in place is known by its revision") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const auto mesh = std::make_shared<Mesh>(test::make_square());
    const Snapshot snapshot{.meshes = {{mesh}}};
    stage.update(snapshot);
    mesh->set_position(0, Vec3(-1.5, -1.5, 0));
    CHECK(stage.update(snapshot).vertices == 6 * sizeof(SurfaceVertex));
    CHECK(mean_difference(stage.draw(), stage.draw_fresh(snapshot)) < 0.02);
}

TEST_CASE("a scene: quads that are split along their other diagonal take their colours along") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    Mesh square = test::make_square();
    square.attributes().add({.name = "color",
                             .domain = Domain::vertex,
                             .width = 3,
                             .values = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0}});
    square.set_position(0, Vec3(-1.2, -1.2, 0));
    stage.update({.meshes = {{shared(square)}}});
    square.set_position(0, Vec3(-0.2, -0.2, 0));
    const Snapshot other{.meshes = {{shared(square)}}};
    CHECK(stage.update(other).colors == 6 * sizeof(SurfaceColor));
    CHECK(mean_difference(stage.draw(), stage.draw_fresh(other)) < 0.02);
}

TEST_CASE("a scene: another topology replaces everything, and what vanishes is freed") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const Mesh torus = make_torus(), box = make_box();
    stage.update({.meshes = {{shared(torus)}}});
    const GpuSurface& surface = *stage.scene.surfaces().front();
    const GLuint vertices = surface.vertices->at(0).id(), colors = surface.colors->at(0).id();
    REQUIRE(alive(vertices));
    const Uploads uploads = stage.update({.meshes = {{shared(box)}}});
    CHECK(uploads.vertices == corners(box) * sizeof(SurfaceVertex));
    CHECK(uploads.colors == corners(box) * sizeof(SurfaceColor));
    CHECK_FALSE(alive(vertices));
    CHECK_FALSE(alive(colors));
    const GLuint last = stage.scene.surfaces().front()->vertices->at(0).id();
    CHECK(stage.update({}).bytes() == 0);
    CHECK_FALSE(alive(last));
    CHECK(test::covered(stage.draw()) == 0.0);
}

TEST_CASE("a scene: what stays shared is freed with the last that uses it") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const auto torus = shared(make_torus());
    stage.update({.meshes = {{torus}}});
    const GLuint vertices = stage.scene.surfaces().front()->vertices->at(0).id();
    const GLuint colors = stage.scene.surfaces().front()->colors->at(0).id();
    DrawnMesh red{torus};
    red.style.color = {1, 0, 0};
    stage.update({.meshes = {red}});
    CHECK(alive(vertices));
    CHECK_FALSE(alive(colors));
    stage.scene = GpuScene();
    CHECK_FALSE(alive(vertices));
}

TEST_CASE("a scene: a change of style uploads what it changes") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    Mesh open = test::make_square();
    DrawnMesh drawn{shared(open)};
    ValueRange range;
    const auto update = [&] {
        const Snapshot snapshot{.meshes = {drawn}, .range = range};
        const Uploads uploads = stage.update(snapshot);
        CHECK(stage.draw() == stage.draw_fresh(snapshot));
        return uploads;
    };
    update();
    drawn.style.wire = true;
    CHECK(update().bytes() == 0);
    drawn.style.color = {0, 1, 0};
    Uploads uploads = update();
    CHECK(uploads.bytes() == uploads.colors);
    CHECK(uploads.colors > 0);
    range.high = 3.0;
    CHECK(update().bytes() == 0);
    drawn.style.values = {0, 1, std::numeric_limits<double>::quiet_NaN(), 3};
    CHECK(update().colors > 0);
    CHECK(update().bytes() == 0);
    range.high = 4.0;
    CHECK(update().colors > 0);
    drawn.style.boundaries = true;
    uploads = update();
    CHECK(uploads.bytes() == uploads.marks);
    CHECK(uploads.marks > 0);
    drawn.style.shading = Shading::flat;
    uploads = update();
    CHECK(uploads.bytes() == uploads.vertices);
    CHECK(uploads.vertices > 0);
    open.attributes().add(
        {.name = "color", .domain = Domain::face, .width = 3, .values = {0.5, 0.5, 1.0}});
    drawn.mesh = shared(open);
    drawn.style.values = {};
    CHECK(update().colors > 0);
}

TEST_CASE("a scene: objects keep their buffers when others come, go and change places") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const DrawnMesh first{shared(make_torus()), {}, {}, 1};
    const DrawnMesh second{shared(make_box()), {}, translation(Vec3(0.5, 0, 0)), 2};
    const auto gizmo = shared(line_to(Vec3(1, 0, 0))), curve = shared(line_to(Vec3(0, 1, 0)));
    stage.update({.meshes = {first, second}, .overlays = {gizmo, curve}});
    CHECK(stage.update({.meshes = {second, first}, .overlays = {curve, gizmo}}).bytes() == 0);
    CHECK(stage.update({.meshes = {second}, .overlays = {curve}}).bytes() == 0);
    const auto moved = shared(line_to(Vec3(0, 0, 1)));
    const Uploads uploads = stage.update({.meshes = {second}, .overlays = {moved, curve}});
    CHECK(uploads.calls == 2);  // one for its line, one for its point
    CHECK(uploads.bytes() == uploads.marks);
    // Two with one number are told apart by their order.
    DrawnMesh twin = second;
    twin.transform = translation(Vec3(-0.5, 0, 0));
    stage.update({.meshes = {second, twin}});
    CHECK(stage.update({.meshes = {second, twin}}).bytes() == 0);
    CHECK(stage.scene.surfaces().size() == 2);
}

TEST_CASE("a scene: an update that fails leaves it as it was") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const Mesh torus = make_torus();
    stage.update({.meshes = {{shared(torus)}}});
    const Image before = stage.draw();
    DrawnMesh wrong{shared(make_box())};
    wrong.style.region = Region::all(torus.shared_topology());
    const DrawnMesh moved{shared(stretched(torus, 1.5))};
    const auto code = [&](const Snapshot& snapshot, const Context& context = {}) {
        return test::error_of([&] { stage.scene.update(snapshot, context); }).code();
    };
    CHECK(code({.meshes = {moved, wrong}}) == ErrorCode::topology_mismatch);
    const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    CHECK(code({.meshes = {moved}, .overlays = test::marks(line_to(nan))}) ==
          ErrorCode::not_finite);
    ContextOptions options;
    options.memory_limit = 1000;
    CHECK(code({.meshes = {moved}}, Context(options)) == ErrorCode::memory_limit);
    CHECK(stage.draw() == before);
    CHECK(stage.update({.meshes = {{shared(torus)}}}).colors == 0);
}

TEST_CASE("a scene: what moves far away is as sharp there") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    const auto torus = shared(make_torus());
    const auto at = [&](double x) {
        return Snapshot{.meshes = {{torus, {}, translation(Vec3(x, 0, 0))}}};
    };
    stage.update(at(0.0));
    for (const double x : {1.0, 1e3, 1e6}) {
        stage.update(at(x));
        const Camera camera({.eye = Vec3(x, 0, 10), .target = Vec3(x, 0, 0), .ortho = 4.0});
        GpuScene fresh;
        fresh.update(at(x));
        const Image expected = draw_scene(stage.tools, fresh, camera, test::small_options());
        const Image image = draw_scene(stage.tools, stage.scene, camera, test::small_options());
        CHECK(mean_difference(image, expected) < 0.05);
    }
}

TEST_CASE("a scene: after any changes it shows what a new one shows") {
    const auto platform = test::make_platform();
    if (!platform) return;
    Stage stage(*platform);
    std::mt19937 random(5);
    const auto pick = [&](int count) { return static_cast<int>(random() % unsigned(count)); };
    Snapshot snapshot;
    for (int step = 0; step < 120; ++step) {
        const int kind = snapshot.meshes.empty() ? 0 : pick(8);
        DrawnMesh* drawn =
            kind == 0
                ? nullptr
                : &snapshot.meshes[static_cast<std::size_t>(pick(int(snapshot.meshes.size())))];
        if (kind == 0 && snapshot.meshes.size() < 4) {
            const Mesh mesh = pick(2) ? make_box() : make_sphere({.segments = 6});
            snapshot.meshes.push_back({shared(mesh), {}, {}, std::uint64_t(pick(3))});
        } else if (kind == 1) {
            snapshot.meshes.erase(snapshot.meshes.begin());
        } else if (kind == 2) {
            drawn->mesh = shared(stretched(*drawn->mesh, 0.8 + 0.1 * pick(5)));
        } else if (kind == 3) {
            drawn->transform = translation(0.2 * Vec3(pick(5) - 2, pick(5) - 2, pick(3)));
        } else if (kind == 4) {
            drawn->transform.linear = Vec3(pick(2) ? 1 : -1, 1, 1).asDiagonal();
        } else if (kind == 5) {
            drawn->style.color = {0.25 * pick(5), 0.5, 0.5};
            drawn->style.wire = pick(2) == 0;
        } else if (kind == 6) {
            drawn->style.handles = {Region(drawn->mesh->shared_topology(), {0, Index(pick(4))})};
        } else if (kind == 7) {
            snapshot.overlays = test::marks(line_to(Vec3(pick(3), 1, pick(3))));
        }
        stage.update(snapshot);
        REQUIRE(mean_difference(stage.draw(), stage.draw_fresh(snapshot)) < 0.3);
    }
}
