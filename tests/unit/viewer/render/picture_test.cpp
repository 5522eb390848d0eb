#include "viewer/render/picture.h"

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"

using namespace lissom;

namespace {

Picture picture_of(const Mesh& mesh, int width = 120, int height = 90) {
    Picture picture;
    picture.meshes = {{test::shared(mesh)}};
    picture.options = test::small_options(width, height);
    return picture;
}

// Columns and rows that anything is drawn in.
Box drawn_box(const Image& image) {
    Box box;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.pixel(x, y)[3]) box.extend({x + 0.5, y + 0.5, 0.0});
        }
    }
    return box;
}

}  // namespace

TEST_CASE("a standard view shows all of the mesh, in the middle, with a margin") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh cactus = make_cactus({.vertices = 2000});
    for (const StandardView view : {StandardView::front, StandardView::three_quarter}) {
        Picture picture = picture_of(cactus);
        picture.view = view;
        const Box box = drawn_box(draw_picture(*renderer, picture));
        CHECK(box.min.y() == doctest::Approx(0.06 * 90).epsilon(0.2));
        CHECK(box.max.y() == doctest::Approx(90 - 0.06 * 90).epsilon(0.02));
        CHECK(std::abs(box.center().x() - 60.0) < 3.0);
    }
}

TEST_CASE("cells show their meshes side by side at one scale") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh large = make_sphere(), small = make_sphere({.radius = 0.5});
    Picture picture = picture_of(large, 200, 100);
    picture.meshes.push_back({test::shared(small)});
    picture.columns = 2;
    picture.framing.ortho = true;
    const Image image = draw_picture(*renderer, picture);
    const double left = test::covered(test::crop(image, 0, 0, 100, 100));
    const double right = test::covered(test::crop(image, 100, 0, 100, 100));
    CHECK(left == doctest::Approx(4.0 * right).epsilon(0.02));
    CHECK(image.pixel(50, 50)[3] == 255);
    CHECK(image.pixel(150, 50)[3] == 255);

    picture.fit_each = true;
    const Image fitted = draw_picture(*renderer, picture);
    CHECK(test::covered(test::crop(fitted, 100, 0, 100, 100)) ==
          doctest::Approx(test::covered(test::crop(fitted, 0, 0, 100, 100))).epsilon(0.001));
}

TEST_CASE("cells fill rows, and cells without a mesh stay empty") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    Picture picture = picture_of(sphere, 100, 100);
    picture.meshes.resize(3, {test::shared(sphere)});
    picture.columns = 2;
    const Image image = draw_picture(*renderer, picture);
    CHECK(image.pixel(25, 75)[3] == 255);
    CHECK(image.pixel(75, 25)[3] == 255);
    CHECK(image.pixel(75, 75)[3] == 0);
}

TEST_CASE("captions stand below their cells, and meshes make room for them") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    Picture picture = picture_of(sphere, 400, 200);
    picture.meshes.resize(2, {test::shared(sphere)});
    picture.columns = 2;
    picture.captions = {"before", ""};
    const Image image = draw_picture(*renderer, picture);
    CHECK(test::covered(test::crop(image, 0, 180, 200, 20)) > 20);
    CHECK(test::covered(test::crop(image, 200, 180, 200, 20)) == 0);
    picture.captions = {std::string(200, 'm'), "after"};
    const Image narrowed = draw_picture(*renderer, picture);
    CHECK(test::covered(test::crop(narrowed, 198, 180, 4, 20)) == 0);
}

TEST_CASE("a legend appears beside the mesh where it has values") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    Picture picture = picture_of(sphere, 400, 300);
    picture.framing.margin = 0.0;
    picture.view = StandardView::front;
    const double without = drawn_box(draw_picture(*renderer, picture)).max.x();
    for (const Vec3& p : sphere.positions()) picture.meshes[0].style.values.push_back(p.y());
    const double with = drawn_box(draw_picture(*renderer, picture)).max.x();
    picture.legend = false;
    CHECK(with > without + 10.0);
    CHECK(drawn_box(draw_picture(*renderer, picture)).max.x() == without);
}

TEST_CASE("names of parts appear beside the mesh, instead of a scale") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere();
    Picture picture = picture_of(sphere, 400, 300);
    CHECK_FALSE(legend_of(picture));
    const double without = drawn_box(draw_picture(*renderer, picture)).max.x();
    const Color red{1.0, 0.0, 0.0};
    picture.meshes[0].style.parts = {{Region::all(sphere.shared_topology()), red}};
    picture.legend_parts = {{"all of it", red}};
    REQUIRE(legend_of(picture));
    CHECK(legend_of(picture)->parts == picture.legend_parts);
    CHECK(drawn_box(draw_picture(*renderer, picture)).max.x() > without + 10.0);
}

TEST_CASE("a range that is given decides the colours") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    Picture picture = picture_of(square);
    picture.meshes[0].style.values = {0.0, 0.0, 1.0, 1.0};
    picture.view = StandardView::front;
    picture.legend = false;
    const Image narrow = draw_picture(*renderer, picture);
    picture.range = ValueRange{0.0, 100.0};
    const Image wide = draw_picture(*renderer, picture);
    CHECK(lightness(wide.color(60, 15)) < lightness(narrow.color(60, 15)) - 0.3);
}

TEST_CASE("lines and points are framed and drawn without any mesh") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    Picture picture;
    picture.marks.lines = {{{Vec3(0, 0, 0), Vec3(1, 1, 0)}}};
    picture.options = test::small_options();
    CHECK(test::covered(draw_picture(*renderer, picture)) > 100.0);
}

TEST_CASE("the pixels of a picture are charged before they are there, beside those of its cells") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    Picture picture = picture_of(make_box(), 1000, 1000);
    picture.options.samples = 1;
    picture.meshes.resize(25, picture.meshes[0]);
    picture.columns = 5;
    const auto message_at = [&](std::size_t limit) {
        ContextOptions options;
        options.memory_limit = limit;
        const Context context(options);
        std::string message;
        try {
            draw_picture(*renderer, picture, context);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::memory_limit);
            message = error.message();
        }
        CHECK(context.memory()->used() == 0);
        return message;
    };
    CHECK(message_at(3'999'999).find("the picture needs 4000000 bytes") == 0);
    CHECK(message_at(20'000'000).empty());
}

TEST_CASE("pictures that cannot be made are refused") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh sphere = make_sphere(), empty;
    const auto code = [&](const Picture& picture) {
        return test::error_of([&] { draw_picture(*renderer, picture); }).code();
    };
    CHECK(code(picture_of(empty)) == ErrorCode::mesh_empty);
    CHECK(code(Picture{}) == ErrorCode::invalid_argument);

    Picture picture = picture_of(sphere);
    picture.range = ValueRange{1.0, 1.0};
    CHECK(code(picture) == ErrorCode::invalid_argument);

    picture = picture_of(sphere);
    picture.columns = -1;
    CHECK(code(picture) == ErrorCode::invalid_argument);

    picture = picture_of(sphere);
    picture.captions = {"alone"};
    CHECK(code(picture) == ErrorCode::invalid_argument);
    picture.columns = 1;
    picture.captions = {"one", "too many"};
    CHECK(code(picture) == ErrorCode::invalid_argument);

    picture = picture_of(sphere, 20, 90);
    picture.meshes[0].style.values.assign(static_cast<std::size_t>(sphere.vertex_count()), 1.0);
    CHECK(code(picture) == ErrorCode::invalid_argument);

    picture = picture_of(sphere, 1 << 20, 90);
    CHECK(code(picture) == ErrorCode::out_of_range);
}
