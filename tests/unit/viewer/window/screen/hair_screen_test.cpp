// Hair on the screen of a window, by EGL.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/hair/strands/strand_random.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/render/strands/strand_support.h"
#include "viewer/render/draw/projection.h"
#include "viewer/render/gl/platform.h"
#include "viewer/window/screen/screen.h"

using namespace lissom;
using namespace lissom::window;

namespace {

constexpr Color kGround{0.17, 0.18, 0.20};
constexpr Canvas kCanvas{0, 0, 200, 160};

// A ball with hair that hangs from its upper half; units are metres.
Snapshot hairy_ball(Index count) {
    std::vector<std::vector<Vec3>> lines;
    for (Index s = 0; s < count; ++s) {
        Vec3 d = random_vector(7, s).normalized();
        d.y() = std::abs(d.y());
        std::vector<Vec3> line;
        for (int i = 0; i < 12; ++i) {
            const double t = i / 11.0;
            const Vec3 out(d.x(), d.y() * (1 - t) - 0.4 * t, d.z());
            line.emplace_back(0.1 * out.normalized() * (1.0 + 0.1 * std::sin(2 * t)) -
                              Vec3(0, 0.05 * t * t, 0));
        }
        lines.push_back(line);
    }
    Snapshot snapshot = test::drawing_of(test::strands_of(lines, 0.0006));
    DrawnMesh ball{test::shared(make_sphere())};
    const Box box = [&] {
        Box result;
        for (const Vec3& p : ball.mesh->positions()) result.extend(p);
        return result;
    }();
    ball.transform.linear = 0.19 / (box.max.y() - box.min.y()) * Mat3::Identity();
    snapshot.meshes = {ball};
    return snapshot;
}

Hair hair_of(const Snapshot& snapshot) {
    Hair hair;
    for (const DrawnStrands& drawn : snapshot.strands) {
        hair.parts.push_back({drawn, std::make_shared<const PackedStrands>(pack_strands(drawn))});
    }
    if (!snapshot.strands.empty()) {
        hair.light = std::make_shared<const HairLight>(snapshot, Vec3::Zero());
    }
    return hair;
}

Camera camera_at(double azimuth) {
    return Camera({.eye = Vec3(0.6 * std::sin(azimuth), 0.1, 0.6 * std::cos(azimuth)),
                   .target = Vec3(0, -0.03, 0)});
}

void show(Screen& screen, const Snapshot& snapshot) {
    screen.update(snapshot);
    screen.set_hair(hair_of(snapshot));
}

// All strands, as at rest.
Image filled(Screen& screen, const Camera& camera) {
    screen.draw(camera, kCanvas, kGround, 1);
    if (screen.hair().empty()) return screen.picture();
    const Mat4 view = view_matrix(camera, Vec3::Zero());
    screen.direct_light(screen.hair().light()->directed(view.topLeftCorner<3, 3>()));
    screen.begin_fill(camera, kCanvas, kGround, 60.0);
    while (screen.filling()) screen.fill();
    return screen.picture();
}

double mean_difference(const Image& a, const Image& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    }
    return sum / static_cast<double>(a.rgba.size());
}

// Mean byte of the pixels that differ from a picture without hair, and their number.
struct HairPixels {
    double brightness = 0.0, count = 0.0;
};
HairPixels hair_pixels(const Image& image, const Image& bald) {
    HairPixels result;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        int apart = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            apart = std::max(apart, std::abs(int{image.rgba[i + k]} - int{bald.rgba[i + k]}));
        }
        if (apart < 12) continue;
        result.count += 1.0;
        for (std::size_t k = 0; k < 3; ++k) result.brightness += image.rgba[i + k] / 3.0;
    }
    if (result.count > 0.0) result.brightness /= result.count;
    return result;
}

// Bytes that calls of OpenGL send, from now on.
struct Sent {
    static inline std::size_t bytes = 0;
    static inline PFNGLBUFFERDATAPROC buffer = nullptr;
    static inline PFNGLTEXIMAGE3DPROC volume = nullptr;
    static inline PFNGLTEXSUBIMAGE2DPROC texels = nullptr;

    static void EPOXY_CALLSPEC count_buffer(GLenum target, GLsizeiptr size, const void* data,
                                            GLenum use) {
        bytes += static_cast<std::size_t>(size);
        buffer(target, size, data, use);
    }
    static void EPOXY_CALLSPEC count_volume(GLenum target, GLint level, GLint format, GLsizei width,
                                            GLsizei height, GLsizei depth, GLint border,
                                            GLenum parts, GLenum type, const void* data) {
        bytes += at(width) * height * depth * 4;
        volume(target, level, format, width, height, depth, border, parts, type, data);
    }
    static void EPOXY_CALLSPEC count_texels(GLenum target, GLint level, GLint x, GLint y,
                                            GLsizei width, GLsizei height, GLenum parts,
                                            GLenum type, const void* data) {
        bytes += at(width) * height * 4;
        texels(target, level, x, y, width, height, parts, type, data);
    }

    Sent() {
        buffer = std::exchange(epoxy_glBufferData, &count_buffer);
        volume = std::exchange(epoxy_glTexImage3D, &count_volume);
        texels = std::exchange(epoxy_glTexSubImage2D, &count_texels);
        bytes = 0;
    }
    ~Sent() {
        epoxy_glBufferData = buffer;
        epoxy_glTexImage3D = volume;
        epoxy_glTexSubImage2D = texels;
    }
};

}  // namespace

TEST_CASE("hair screen: an orbit sends nothing, at rest or not") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    // libepoxy looks a function up when it is first called.
    show(screen, hairy_ball(10));
    const Snapshot snapshot = hairy_ball(2000);
    screen.update(snapshot);
    const Hair hair = hair_of(snapshot);
    {
        const Sent sent;
        const std::size_t told = screen.set_hair(hair);
        CHECK(told > 2000 * 14 * 16);
        CHECK(Sent::bytes == told);
    }
    filled(screen, camera_at(0.0));
    const Sent sent;
    for (int i = 1; i < 5; ++i) screen.draw(camera_at(0.2 * i), kCanvas, kGround, 1 + i % 2);
    screen.begin_fill(camera_at(0.8), kCanvas, kGround, 60.0);
    while (screen.filling()) screen.fill();
    CHECK(Sent::bytes == 0);
    CHECK(screen.set_hair(hair) == 0);
    CHECK(screen.update(snapshot).bytes() == 0);
    // Without hair neither.
    screen.set_hair({});
    for (int i = 1; i < 5; ++i) screen.draw(camera_at(0.2 * i), kCanvas, kGround, 1);
    CHECK(Sent::bytes == 0);
}

TEST_CASE("hair screen: filled, the picture is nearly that of lissom.render") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    const Snapshot snapshot = hairy_ball(4000);
    show(screen, snapshot);
    Renderer renderer(make_egl_platform());
    RenderOptions options = test::small_options(kCanvas.width, kCanvas.height);
    options.background = kGround;
    for (const double azimuth : {0.4, 2.5}) {
        const Camera camera = camera_at(azimuth);
        const Image wanted = renderer.render(snapshot, camera, options);
        Snapshot without = snapshot;
        without.strands.clear();
        const Image bald = renderer.render(without, camera, options);
        const Image image = filled(screen, camera);
        CHECK(mean_difference(image, wanted) < 3.0);
        const HairPixels got = hair_pixels(image, bald), right = hair_pixels(wanted, bald);
        CHECK(right.count > 3000);
        CHECK(std::abs(got.count - right.count) < 0.06 * right.count);
        CHECK(std::abs(got.brightness - right.brightness) < 4.0);
        // Few while it moves: as much hair, nearly as bright.
        screen.draw(camera, kCanvas, kGround, 1);
        const HairPixels few = hair_pixels(screen.picture(), bald);
        CHECK(std::abs(few.count - right.count) < 0.15 * right.count);
        CHECK(std::abs(few.brightness - right.brightness) < 14.0);
    }
}

TEST_CASE("hair screen: black and blond hair are as bright as in lissom.render") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    Renderer renderer(make_egl_platform());
    RenderOptions options = test::small_options(kCanvas.width, kCanvas.height);
    options.background = kGround;
    for (const double azimuth : {0.4, 3.5}) {
        const Camera camera = camera_at(azimuth);
        for (const Color& color : {Color{0.05, 0.04, 0.04}, Color{0.9, 0.78, 0.55}}) {
            Snapshot snapshot = hairy_ball(4000), without = snapshot;
            without.strands.clear();
            snapshot.strands[0].style.color = color;
            show(screen, snapshot);
            const Image bald = renderer.render(without, camera, options);
            const Image wanted = renderer.render(snapshot, camera, options);
            const HairPixels right = hair_pixels(wanted, bald);
            const Image image = filled(screen, camera);
            const HairPixels got = hair_pixels(image, bald);
            CAPTURE(color.r);
            CHECK(mean_difference(image, wanted) < 3.0);
            CHECK(std::abs(got.count - right.count) < 0.06 * right.count);
            CHECK(std::abs(got.brightness - right.brightness) < 4.0);
        }
    }
}

TEST_CASE("hair screen: strands that point to the eye cover as much as in lissom.render") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    Renderer renderer(make_egl_platform());
    RenderOptions options = test::small_options(kCanvas.width, kCanvas.height);
    options.background = kGround;
    const Camera camera = camera_at(0.0);
    const Vec3 eye = camera.eye();
    std::vector<std::vector<Vec3>> lines;
    for (int i = -3; i <= 3; ++i) {
        for (int j = -3; j <= 3; ++j) {
            const Vec3 tip(0.02 * i, -0.03 + 0.02 * j, 0.0);
            lines.push_back({tip + 0.05 * (tip - eye), tip});
        }
    }
    const Snapshot snapshot = test::drawing_of(test::strands_of(lines, 0.006));
    show(screen, {});
    const Image nothing = filled(screen, camera);
    show(screen, snapshot);
    const HairPixels got = hair_pixels(filled(screen, camera), nothing);
    const HairPixels right = hair_pixels(renderer.render(snapshot, camera, options), nothing);
    CHECK(right.count > 300);
    CHECK(got.count == doctest::Approx(right.count).epsilon(0.2));
}

TEST_CASE("hair screen: whatever is drawn ends a fill, and the next one begins anew") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    show(screen, hairy_ball(6000));
    const Camera camera = camera_at(0.4);
    const Image whole = filled(screen, camera);
    screen.draw(camera, kCanvas, kGround, 1);
    const Image moving = screen.picture();
    screen.begin_fill(camera, kCanvas, kGround, 60.0);
    CHECK_FALSE(screen.fill());
    REQUIRE(screen.filling());
    // Half a picture is not shown.
    CHECK(screen.picture() == moving);
    screen.draw(camera_at(1.0), kCanvas, kGround, 1);
    CHECK_FALSE(screen.filling());
    CHECK_FALSE(screen.fill());
    CHECK(test::difference(filled(screen, camera), whole) <= 1);
}

TEST_CASE("hair screen: no strands, one, one point, points that are not finite, very many") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    const Camera camera = test::front_camera(2.5);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3 low(0, -1, 0), high(0, 1, 0);
    const auto picture_of = [&](const Strands& strands) {
        show(screen, test::drawing_of(strands));
        return filled(screen, camera);
    };
    const Image nothing = picture_of(Strands());
    CHECK(hair_pixels(nothing, nothing).count == 0);
    CHECK(picture_of(test::strands_of({{low}, {high}})) == nothing);
    CHECK(picture_of(test::strands_of({{low, Vec3(nan, 0, 0)}})) == nothing);
    CHECK(picture_of(test::strands_of({{low, high}}, 0.0)) == nothing);
    const auto covered = [&](const Image& image) { return hair_pixels(image, nothing).count; };
    const double one = covered(picture_of(test::strands_of({{low, high}}, 0.1)));
    CHECK(one > 500);
    const Vec3 bad(0, 0, nan);
    const double split = covered(
        picture_of(test::strands_of({{low, Vec3(0, -0.5, 0), bad, Vec3(0, 0.5, 0), high}}, 0.1)));
    CHECK(split == doctest::Approx(0.5 * one).epsilon(0.15));
    const Image many = picture_of(test::curtain(100000, 0.0, 0.00002));
    CHECK(screen.hair().size() == 100000);
    CHECK(covered(many) > 0.9 * 128 * 128);
}

TEST_CASE("hair screen: strands that are hidden, changed or removed") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    const Camera camera = test::front_camera(2.5);
    Snapshot snapshot = test::drawing_of(test::curtain(40, 0.0, 0.02));
    snapshot.strands[0].style.color = Color{0.9, 0.1, 0.1};
    snapshot.strands.push_back(snapshot.strands[0]);
    snapshot.strands[1].transform = translation({0.0, 0.0, 0.5});
    snapshot.strands[1].style.color = Color{0.1, 0.1, 0.9};
    show(screen, snapshot);
    // The blue ones are before the red ones.
    const Image both = filled(screen, camera);
    Snapshot one = snapshot;
    one.strands.pop_back();
    show(screen, one);
    const Image red = filled(screen, camera);
    CHECK(mean_difference(both, red) > 5.0);
    const auto is_red = [](const Image& image) {
        double sum = 0.0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            sum += int{image.rgba[i]} - int{image.rgba[i + 2]};
        }
        return sum > 0.0;
    };
    CHECK(is_red(red));
    CHECK_FALSE(is_red(both));
    // Moved.
    one.strands[0].transform = translation({0.0, 10.0, 0.0});
    show(screen, one);
    CHECK(mean_difference(filled(screen, camera), red) > 5.0);
    one.strands.clear();
    show(screen, one);
    CHECK(screen.hair().empty());
    CHECK(screen.hair().light() == nullptr);
    show(screen, snapshot);
    CHECK(test::difference(filled(screen, camera), both) <= 1);
}

TEST_CASE("hair screen: meshes hide strands, and strands shade meshes") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    const Camera camera = test::front_camera(2.5);
    Snapshot snapshot = test::drawing_of(test::curtain(400, -0.5, 0.02));
    snapshot.strands[0].style.unit = 1.0;
    snapshot.meshes = {{test::shared(test::make_square())}};
    Snapshot bald = snapshot;
    bald.strands.clear();
    show(screen, bald);
    const Image square = filled(screen, camera);
    show(screen, snapshot);
    const Image behind = filled(screen, camera);
    const int cx = kCanvas.width / 2, cy = kCanvas.height / 2;
    CHECK(std::abs(behind.color(cx, cy).r - square.color(cx, cy).r) < 0.02);
    // A tenth before the square, towards the light from the pixel below.
    snapshot.strands[0].transform = translation({-0.58, 0.58, 0.6});
    show(screen, snapshot);
    const Image shaded = filled(screen, camera);
    CHECK(shaded.color(cx + 30, cy + 30).r < square.color(cx + 30, cy + 30).r - 0.05);
    // Blond hair lets more light through, black hair less; above all yellow.
    const auto under = [&](const Color& color) {
        snapshot.strands[0].style.color = color;
        show(screen, snapshot);
        return filled(screen, camera).color(cx + 30, cy + 30);
    };
    const Color blond = under({0.9, 0.78, 0.5}), black = under({0.06, 0.05, 0.05});
    CHECK(blond.r > shaded.color(cx + 30, cy + 30).r);
    CHECK(blond.r > black.r + 0.05);
    CHECK(blond.r - blond.b > square.color(cx + 30, cy + 30).r - square.color(cx + 30, cy + 30).b);
}
