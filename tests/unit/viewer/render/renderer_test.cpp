#include "viewer/render/renderer.h"

#include <limits>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/draw/image/colormap.h"

using namespace lissom;
using test::front_camera;
using test::small_options;

namespace {

Snapshot drawing_of(const Mesh& mesh, const MeshStyle& style = {}) {
    return {.meshes = {{test::shared(mesh), style}}};
}

// The colour where a world point is seen.
Color color_at(const Image& image, const Camera& camera, const Vec3& world) {
    const Vec3 pixel = camera.project(world, {double(image.width), double(image.height)});
    return image.color(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
}

}  // namespace

TEST_CASE("a sphere covers the area of its circle") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere({.segments = 48});
    for (const int supersample : {1, 2}) {
        RenderOptions options = small_options(240, 200);
        options.supersample = supersample;
        const Image image = renderer->render(drawing_of(sphere), front_camera(2.5), options);
        const double radius = 200.0 / 2.5;
        CHECK(test::covered(image) == doctest::Approx(kPi * radius * radius).epsilon(0.003));
    }
}

TEST_CASE("with perspective a sphere covers its silhouette cone") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere({.segments = 48});
    const Camera camera({.eye = Vec3(0, 0, 3), .fov = kPi / 3.0});
    const Image image = renderer->render(drawing_of(sphere), camera, small_options(200, 200));
    const double tangent = 1.0 / std::sqrt(8.0);  // of asin(1 / 3)
    const double radius = 100.0 * tangent / std::tan(kPi / 6.0);
    CHECK(test::covered(image) == doctest::Approx(kPi * radius * radius).epsilon(0.003));
}

TEST_CASE("strands change what is near them, and shade the rest") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (int s = 0; s < 400; ++s) {
        const float x = 0.5f + 0.001f * static_cast<float>(s);
        for (const float p : {x, -0.6f, 0.08f, x, 0.6f, 0.08f}) points.push_back(p);
        offsets.push_back(offsets.back() + 2);
    }
    const Strands strands(points, offsets);
    Snapshot drawing = drawing_of(square);
    const Image bare = renderer->render(drawing, front_camera(2.4), small_options());
    StrandStyle clear;
    clear.shadow = 0.0;
    clear.scalp_tint = 0.0;
    drawing.strands.push_back({test::shared(strands), clear, {}});
    const Image haired = renderer->render(drawing, front_camera(2.4), small_options());
    CHECK(test::difference(test::crop(bare, 0, 0, 60, 96), test::crop(haired, 0, 0, 60, 96)) <= 1);
    CHECK(test::difference(bare, haired) > 5);
    // Shadow falls away from the light, to the lower right: on the right half, not on the left.
    drawing.strands[0].style.shadow = 10.0;
    const Image shaded = renderer->render(drawing, front_camera(2.4), small_options());
    CHECK(test::difference(test::crop(shaded, 0, 0, 40, 96), test::crop(haired, 0, 0, 40, 96)) <=
          2);
    CHECK(test::brightness(shaded.color(86, 50)) < test::brightness(haired.color(86, 50)) - 0.01);
}

TEST_CASE("what is behind a mesh that is seen through shows: meshes, lines and strands") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    Snapshot drawing = drawing_of(square);
    Overlay line;
    line.lines.push_back({{Vec3(-0.5, 0, -0.5), Vec3(0.5, 0, -0.5)}, false, {0, 0, 1}, 8.0});
    drawing.overlays.push_back(std::make_shared<const Overlay>(line));
    const Strands strands({-5e-4f, 4e-4f, -3e-4f, 5e-4f, 4e-4f, -3e-4f}, {0, 2});
    StrandStyle style;
    style.unit = 0.001;
    style.shadow = style.scalp_tint = 0.0;
    drawing.strands.push_back({test::shared(strands), style, {}});
    const auto picture = [&](double opacity) {
        drawing.meshes[0].style.opacity = opacity;
        return renderer->render(drawing, front_camera(2.4), small_options());
    };
    const Image solid = picture(1.0), half = picture(0.5), open = picture(0.0);
    CHECK(solid.color(64, 48) == solid.color(64, 60));
    const double blue = half.color(64, 48).b - half.color(64, 48).r;
    CHECK(blue > 0.2);
    CHECK(open.color(64, 48).b - open.color(64, 48).r > blue);
    const auto dark = [](const Image& image) {
        double least = 1.0;
        for (int y = 24; y < 40; ++y) least = std::min(least, test::brightness(image.color(64, y)));
        return least;
    };
    CHECK(dark(half) < dark(solid));
    drawing.meshes[0].style.opacity = 1.5;
    CHECK(test::error_of([&] {
              renderer->render(drawing, front_camera(2.4), small_options());
          }).code() == ErrorCode::out_of_range);
}

TEST_CASE("a raised mesh hides what it lies on, whichever comes first") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    Snapshot drawing = drawing_of(square);
    drawing.meshes.push_back(drawing.meshes[0]);
    drawing.meshes[0].style.color = {0, 0, 1};
    drawing.meshes[1].style.color = {1, 0, 0};
    for (const bool first : {false, true}) {
        drawing.meshes[first ? 0 : 1].style.raised = true;
        drawing.meshes[first ? 1 : 0].style.raised = false;
        Image image = renderer->render(drawing, front_camera(2.4), small_options());
        for (int y = 30; y < 60; ++y) {
            for (int x = 50; x < 80; ++x) {
                const Color seen = image.color(x, y);
                REQUIRE((first ? seen.b > 2.0 * seen.r : seen.r > 2.0 * seen.b));
            }
        }
    }
}

TEST_CASE("the same input gives the same pixels, in any order") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh torus = make_torus();
    MeshStyle style;
    style.wire = true;
    RenderOptions options = small_options();
    options.occlusion = 1.0;
    const Camera camera({.eye = Vec3(2, 3, 2)});
    const Image image = renderer->render(drawing_of(torus, style), camera, options);
    renderer->render(drawing_of(test::make_square()), camera, small_options());
    CHECK(renderer->render(drawing_of(torus, style), camera, options) == image);
}

TEST_CASE("the region is blue, its handle purple, the rest gray") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh bar = make_bar();
    MeshStyle style;
    std::vector<Index> upper;
    for (Index v = 0; v < bar.vertex_count(); ++v) {
        if (bar.position(v).y() > -0.01) upper.push_back(v);
    }
    style.region = Region(bar.shared_topology(), upper);
    style.handles = {*bar.find_region("top")};
    const Camera camera({.eye = Vec3(3, 8, 9), .fov = 0.9});
    const Image image = renderer->render(drawing_of(bar, style), camera, small_options());
    CHECK(test::is_blue(color_at(image, camera, Vec3(0.01, 1.5, 0.5))));
    CHECK(test::is_purple(color_at(image, camera, Vec3(0.01, 2.5, 0.01))));
    CHECK(test::is_gray(color_at(image, camera, Vec3(0.01, -1.5, 0.5))));
}

TEST_CASE("wire draws the sides of a quad and not its diagonal") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    MeshStyle wire;
    wire.wire = true;
    wire.wire_width = 2.0;
    const RenderOptions options = small_options(100, 100);
    const Camera camera = front_camera(2.5);
    const Image plain = renderer->render(drawing_of(square), camera, options);
    const Image lines = renderer->render(drawing_of(square, wire), camera, options);
    for (int i = 15; i < 85; ++i) {
        CHECK(lines.color(i, i) == plain.color(i, i));
        CHECK(lines.color(i, 99 - i) == plain.color(i, 99 - i));
        CHECK(test::brightness(lines.color(i, 10)) < test::brightness(plain.color(i, 10)) - 0.2);
        CHECK(test::brightness(lines.color(10, i)) < test::brightness(plain.color(10, i)) - 0.2);
    }
}

TEST_CASE("edges are as wide near as far") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    MeshStyle wire;
    wire.wire = true;
    wire.wire_width = 6.0;
    for (const double height : {2.5, 5.0}) {
        const Image image = renderer->render(drawing_of(square, wire), front_camera(height),
                                             small_options(200, 200));
        int dark = 0;
        for (int x = 0; x < 100; ++x) {
            dark += image.pixel(x, 100)[3] == 255 && test::brightness(image.color(x, 100)) < 0.4;
        }
        CHECK(dark == 3);  // the inner half; the outer one lies beyond the surface
    }
}

TEST_CASE("boundary loops are drawn in their colours, to the front of the surface") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    MeshStyle style;
    style.boundaries = true;
    const Image image =
        renderer->render(drawing_of(square, style), front_camera(2.5), small_options(100, 100));
    const Color color = image.color(50, 10);
    const Color expected = category_color(0);
    CHECK(color.r == doctest::Approx(expected.r).epsilon(0.02));
    CHECK(color.g == doctest::Approx(expected.g).epsilon(0.02));
    CHECK(test::is_gray(image.color(50, 50)));
}

TEST_CASE("lines have their width in pixels, are hidden by surfaces and cut at the eye") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const Color red{1.0, 0.0, 0.0};
    const DrawnLine across{{Vec3(-5, 0, 0), Vec3(5, 0, 0)}, false, red, 8.0};
    const Image line = renderer->render({.overlays = test::marks({.lines = {across}})},
                                        front_camera(2.0), small_options());
    CHECK(test::covered(line) == doctest::Approx(96.0 * 8.0).epsilon(0.01));
    RenderOptions coarse = small_options();
    coarse.mark_scale = 0.5;
    const Image thin =
        renderer->render({.overlays = test::marks({.lines = {across}})}, front_camera(2.0), coarse);
    CHECK(test::covered(thin) == doctest::Approx(96.0 * 4.0).epsilon(0.01));

    DrawnLine behind = across;
    for (Vec3& p : behind.points) p.z() = -1.0;
    const Image hidden = renderer->render(
        {.meshes = {{test::shared(square)}}, .overlays = test::marks({.lines = {behind}})},
        front_camera(4.0), small_options());
    CHECK(test::is_gray(hidden.color(48, 48)));
    CHECK(hidden.color(5, 48).r > 0.9);
    const Image on_top =
        renderer->render({.meshes = {{test::shared(square)}},
                          .overlays = test::marks({.lines = {behind}, .on_top = true})},
                         front_camera(4.0), small_options());
    CHECK(on_top.color(48, 48).r > 0.9);
    CHECK(test::is_gray(on_top.color(48, 70)));

    const Camera inside({.eye = Vec3(0, 0, 0), .target = Vec3(0, 0, -1)});
    const DrawnLine past{{Vec3(0.1, -0.1, -9), Vec3(0.1, -0.1, 2)}, false, red, 4.0};
    const Image cut =
        renderer->render({.overlays = test::marks({.lines = {past}})}, inside, small_options());
    CHECK(test::covered(cut) > 100.0);
    CHECK(cut.color(95, 95).r > 0.9);
    CHECK(cut.pixel(10, 10)[3] == 0);
}

TEST_CASE("points have their radius in pixels and stand before the surface they are on") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const DrawnPoint point{Vec3::Zero(), kHandleColor, 10.0};
    const Image alone = renderer->render({.overlays = test::marks({.points = {point}})},
                                         front_camera(2.0), small_options());
    CHECK(test::covered(alone) == doctest::Approx(kPi * 100.0).epsilon(0.02));
    RenderOptions coarse = small_options();
    coarse.mark_scale = 0.5;
    const Image small =
        renderer->render({.overlays = test::marks({.points = {point}})}, front_camera(2.0), coarse);
    CHECK(test::covered(small) == doctest::Approx(kPi * 25.0).epsilon(0.04));
    const Image image = renderer->render(
        {.meshes = {{test::shared(square)}}, .overlays = test::marks({.points = {point}})},
        front_camera(2.5), small_options(97, 97));
    CHECK(test::is_purple(image.color(48, 48)));
    CHECK(test::is_gray(image.color(48, 70)));
}

TEST_CASE("values are drawn in the colours of the scale") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    MeshStyle style;
    style.values = {0.0, 1.0, 1.0, 0.0};
    const Image image =
        renderer->render(drawing_of(square, style), front_camera(2.0), small_options());
    const Color low = image.color(1, 48), high = image.color(94, 48);
    CHECK(low.b > low.g + 0.2);
    CHECK(high.r > high.b + 0.4);
    CHECK(lightness(image.color(48, 48)) > lightness(low));
    CHECK(lightness(image.color(48, 48)) < lightness(high));
}

TEST_CASE("the inside of an open surface has another tint") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const Camera behind({.eye = Vec3(0, 0, -10), .ortho = 3.0});
    const Image front = renderer->render(drawing_of(square), front_camera(3.0), small_options());
    const Image back = renderer->render(drawing_of(square), behind, small_options());
    CHECK(test::is_gray(front.color(48, 48)));
    CHECK(back.color(48, 48).r > back.color(48, 48).b + 0.05);
    CHECK(test::covered(back) == doctest::Approx(test::covered(front)));
}

TEST_CASE("folds are darker with occlusion, ridges are not") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    for (const double side : {1.0, -1.0}) {  // a valley, then a roof
        FaceList faces;
        faces.add({0, 1, 2, 3});
        faces.add({1, 4, 5, 2});
        const Mesh mesh({Vec3(-1, -1, side), Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(-1, 1, side),
                         Vec3(1, -1, side), Vec3(1, 1, side)},
                        std::move(faces));
        RenderOptions options = small_options(200, 200);
        const Image open = renderer->render(drawing_of(mesh), front_camera(2.2), options);
        options.occlusion = 1.0;
        const Image image = renderer->render(drawing_of(mesh), front_camera(2.2), options);
        const auto darker = [&](int x) {
            return test::brightness(open.color(x, 100)) - test::brightness(image.color(x, 100));
        };
        CHECK((side > 0.0 ? darker(104) > 0.05 : std::abs(darker(104)) < 0.01));
        CHECK(std::abs(darker(185)) < 0.01);
    }
}

TEST_CASE("nothing but the background is drawn where there is nothing") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    RenderOptions options = small_options(20, 10);
    CHECK(test::covered(renderer->render({}, front_camera(1.0), options)) == 0.0);
    for (const char* name : {"white", "#336699", "#010203", "black"}) {
        options.background = parse_color(name);
        const Image image = renderer->render({}, front_camera(1.0), options);
        CHECK(image.is_opaque());
        for (int i = 0; i < 3; ++i) {
            CHECK(std::abs(image.pixel(3, 3)[i] - to_bytes(*options.background)[i]) <= 1);
        }
    }
}

TEST_CASE("edges blend with the background in linear light") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere({.segments = 32});
    RenderOptions options = small_options();
    const Image alone = renderer->render(drawing_of(sphere), front_camera(2.5), options);
    options.background = Color{};
    const Image on_black = renderer->render(drawing_of(sphere), front_camera(2.5), options);
    int edges = 0;
    for (int x = 0; x < 48; ++x) {
        const std::uint8_t alpha = alone.pixel(x, 48)[3];
        if (alpha == 0 || alpha == 255) continue;
        const double blended = srgb_to_linear(alone.color(x, 48).r) * alpha / 255.0;
        CHECK(on_black.color(x, 48).r == doctest::Approx(linear_to_srgb(blended)).epsilon(0.03));
        ++edges;
    }
    CHECK(edges > 0);
}

TEST_CASE("a mirrored mesh gives the mirrored silhouette, lit from outside") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh cactus = make_cactus({.vertices = 2000});
    DrawnMesh mirrored{test::shared(cactus)};
    mirrored.transform = scaling(Vec3(-1, 1, 1), Vec3::Zero());
    const Camera camera({.eye = Vec3(0, 1, 10), .target = Vec3(0, 1, 0), .ortho = 2.4});
    const Image plain = renderer->render(drawing_of(cactus), camera, small_options());
    const Image image = renderer->render({.meshes = {mirrored}}, camera, small_options());
    CHECK(test::covered(image) == doctest::Approx(test::covered(plain)).epsilon(0.002));
    for (int y = 0; y < 96; y += 4) {
        for (int x = 0; x < 96; x += 4) {
            if (image.pixel(x, y)[3] == 255) CHECK(test::is_gray(image.color(x, y)));
        }
    }
}

TEST_CASE("a mesh far from the origin is drawn as well as one at it") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh torus = make_torus();
    const Vec3 far_away(1e7, -2e7, 3e7);
    const Vec3 eye(2, 3, 2);
    const Image near = renderer->render(drawing_of(torus), Camera({.eye = eye}), small_options());
    DrawnMesh moved{test::shared(torus)};
    moved.transform = translation(far_away);
    const Camera camera({.eye = far_away + eye, .target = far_away});
    const Image image = renderer->render({.meshes = {moved}}, camera, small_options());
    CHECK(test::difference(near, image) <= 3);
}

TEST_CASE("large pictures are drawn in parts without a seam") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere({.segments = 24});
    MeshStyle style;
    style.wire = true;
    style.boundaries = true;
    RenderOptions options = small_options(2304, 128);
    options.occlusion = 1.0;
    // A pixel is 1 / 64; the sphere's center is seen at column 2048, where a part ends, or at 1024.
    const auto camera_at = [](double column) {
        const double x = (1152.0 - column) / 64.0;
        return Camera({.eye = Vec3(x, 0, 10), .target = Vec3(x, 0, 0), .ortho = 2.0});
    };
    const Image split = renderer->render(drawing_of(sphere, style), camera_at(2048), options);
    const Image whole = renderer->render(drawing_of(sphere, style), camera_at(1024), options);
    CHECK(test::difference(test::crop(split, 1972, 0, 152, 128),
                           test::crop(whole, 948, 0, 152, 128)) <= 12);
}

TEST_CASE("pictures of one pixel and of uneven sizes are drawn") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    RenderOptions options = small_options(1, 1);
    options.occlusion = 1.0;
    CHECK(renderer->render(drawing_of(square), front_camera(1.0), options).pixel(0, 0)[3] == 255);
    const Image strip =
        renderer->render(drawing_of(square), front_camera(2.0), small_options(301, 7));
    CHECK(test::covered(strip) == doctest::Approx(49.0).epsilon(0.02));
}

TEST_CASE("a camera inside a mesh or looking away draws what is there") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    const Camera inside({.eye = Vec3(0, 0, 0.1)});
    CHECK(test::covered(renderer->render(drawing_of(sphere), inside, small_options())) ==
          doctest::Approx(96.0 * 96.0));
    const Camera away({.eye = Vec3(0, 0, 5), .target = Vec3(0, 0, 9)});
    CHECK(test::covered(renderer->render(drawing_of(sphere), away, small_options())) == 0.0);
    const Camera parallel_inside({.eye = Vec3(0, 0, 0.1), .ortho = 1.0});
    CHECK(test::covered(renderer->render(drawing_of(sphere), parallel_inside, small_options())) ==
          doctest::Approx(96.0 * 96.0));
}

TEST_CASE("sizes and options that cannot be drawn are refused") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const auto code = [&](auto change) {
        RenderOptions options = small_options();
        change(options);
        return test::error_of([&] { renderer->render({}, front_camera(1.0), options); }).code();
    };
    CHECK(code([](RenderOptions& o) { o.width = 0; }) == ErrorCode::invalid_argument);
    CHECK(code([](RenderOptions& o) { o.height = -5; }) == ErrorCode::invalid_argument);
    CHECK(code([](RenderOptions& o) { o.width = 1 << 20; }) == ErrorCode::out_of_range);
    CHECK(code([](RenderOptions& o) { o.samples = 3; }) == ErrorCode::out_of_range);
    CHECK(code([](RenderOptions& o) { o.samples = 1024; }) == ErrorCode::out_of_range);
    CHECK(code([](RenderOptions& o) { o.supersample = 0; }) == ErrorCode::out_of_range);
    CHECK(code([](RenderOptions& o) { o.occlusion = 1.5; }) == ErrorCode::out_of_range);
    CHECK(code([](RenderOptions& o) { o.occlusion = std::nan(""); }) == ErrorCode::out_of_range);
}

TEST_CASE("NaN in a drawing is refused") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    DrawnMesh drawn{test::shared(square)};
    drawn.transform.translation = nan;
    const auto code = [&](const Snapshot& drawing) {
        return test::error_of([&] { renderer->render(drawing, front_camera(1.0)); }).code();
    };
    CHECK(code({.meshes = {drawn}}) == ErrorCode::not_finite);
    CHECK(code({.overlays = test::marks({.lines = {{{nan, nan}}}})}) == ErrorCode::not_finite);
    CHECK(code({.overlays = test::marks({.points = {{nan}}})}) == ErrorCode::not_finite);
}

TEST_CASE("a cancel ends drawing, and the renderer draws again afterwards") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const Context context;
    context.cancel();
    const auto draw = [&] {
        return renderer->render(drawing_of(square), front_camera(1.0), small_options(), context);
    };
    CHECK(test::error_of(draw).code() == ErrorCode::cancelled);
    context.clear_cancel();
    CHECK(test::covered(draw()) == doctest::Approx(96.0 * 96.0));
}

TEST_CASE("memory for the picture and its geometry is charged, and given back") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    for (const std::size_t limit : {std::size_t{1000}, std::size_t{60000}}) {
        ContextOptions options;
        options.memory_limit = limit;
        const Context context(options);
        const auto draw = [&] {
            renderer->render(drawing_of(sphere), front_camera(1.0), small_options(), context);
        };
        CHECK(test::error_of(draw).code() == ErrorCode::memory_limit);
        CHECK(context.memory()->used() == 0);
    }
}

TEST_CASE("a renderer may move between threads") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    const auto draw = [&] {
        return renderer->render(drawing_of(square), front_camera(3.0), small_options());
    };
    const Image here = draw();
    Image there;
    std::thread([&] { there = draw(); }).join();
    CHECK(there == here);
}
