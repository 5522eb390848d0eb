#include "viewer/render/strands/strand_layer.h"

#include <limits>

#include "kernel/hair/strands/strand_place.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/render/strands/strand_support.h"
#include "viewer/render/draw/projection.h"

using namespace lissom;
using doctest::Approx;
using test::covered_by_strands;
using test::curtain;
using test::drawing_of;
using test::front_view;
using test::layer_of;
using test::small_options;

namespace {

bool same(const StrandLayer& a, const StrandLayer& b) {
    if (a.pixels.size() != b.pixels.size()) return false;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const StrandPixel &p = a.pixels[i], &q = b.pixels[i];
        if ((p.color != q.color).any() || p.strands != q.strands || p.meshes != q.meshes ||
            p.all_meshes != q.all_meshes) {
            return false;
        }
    }
    return true;
}

Eigen::Array3f mean_color(const StrandLayer& layer) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    float strands = 0.0f;
    for (const StrandPixel& pixel : layer.pixels) {
        sum += pixel.color;
        strands += pixel.strands;
    }
    return sum / strands;
}

}  // namespace

TEST_CASE("strand layer: drawing tells how far it is") {
    const Strands hair = test::curtain(20000, 0.0, 0.0002);
    std::vector<double> fractions;
    ContextOptions options;
    options.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
    const Context context(options);
    Progress progress(context, "render");
    test::layer_of(test::drawing_of(hair), test::front_view(), test::small_options(), context);
    CHECK(fractions.size() > 8);
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
}

TEST_CASE("strand layer: a strand covers its length times its width") {
    // One pixel is 1/48.
    for (const double width : {0.25, 0.5, 1.0, 4.0}) {
        const Strands strands = test::strands_of(
            {{Vec3(-0.5, -0.31, 0), Vec3(0.1, 0.2, 0), Vec3(0.5, 0.4, 0)}}, width / 48.0);
        const double length = 48.0 * (std::hypot(0.6, 0.51) + std::hypot(0.4, 0.2));
        CHECK(covered_by_strands(layer_of(drawing_of(strands), front_view())) ==
              Approx(length * width + 0.25 * kPi * width * width).epsilon(0.06));
    }
}

TEST_CASE("strand layer: a strand that points to the viewer covers a disc of its width") {
    for (const double width : {2.0, 4.0, 9.0}) {
        const Strands strands =
            test::strands_of({{Vec3(0.013, 0.02, -0.4), Vec3(0.013, 0.02, 0.4)}}, width / 48.0);
        CHECK(covered_by_strands(layer_of(drawing_of(strands), front_view())) ==
              Approx(0.25 * kPi * width * width).epsilon(0.08));
    }
}

TEST_CASE("strand layer: a few strands are as wide as can be seen, but for transparent ones") {
    CHECK(min_visible_width(1) == Approx(1.5));
    CHECK(min_visible_width(50) == Approx(1.5));
    CHECK(min_visible_width(160) == Approx(0.75).epsilon(0.02));
    CHECK(min_visible_width(500) == 0.0);
    CHECK(min_visible_width(100000) == 0.0);
    Strands strands = test::strands_of({{Vec3(-0.5, -0.3, 0), Vec3(0.5, 0.3, 0)}}, 1e-5);
    const double length = 48.0 * std::hypot(1.0, 0.6);
    for (const int fine : {1, 3}) {
        RenderOptions options = small_options();
        options.supersample = fine;
        CHECK(covered_by_strands(
                  test::layer_of_least(1.5, drawing_of(strands), front_view(), options)) ==
              Approx(1.5 * length).epsilon(0.06));
    }
    const double thin = covered_by_strands(layer_of(drawing_of(strands), front_view()));
    CHECK(thin < 0.01 * length);
    strands.set_transparency({0.5f});
    CHECK(covered_by_strands(test::layer_of_least(1.5, drawing_of(strands), front_view())) <= thin);
}

TEST_CASE("strand layer: supersampling and perspective keep the cover") {
    const Strands strands = test::strands_of({{Vec3(-0.5, -0.3, 0), Vec3(0.4, 0.2, 0)}}, 0.02);
    RenderOptions fine = small_options();
    fine.supersample = 3;
    const double once = covered_by_strands(layer_of(drawing_of(strands), front_view()));
    CHECK(covered_by_strands(layer_of(drawing_of(strands), front_view(), fine)) ==
          Approx(once).epsilon(0.02));
    // From 4 away, half a unit a unit of depth: at depth 4 the picture shows -2 to 2.
    ViewParameters view;
    const Camera camera({.eye = Vec3(0, 0, 4), .fov = 2.0 * std::atan(0.5)});
    view.view = view_matrix(camera, Vec3::Zero());
    view.projection = projection_matrix(camera, 1.0, {0.5, 8.0});
    view.half_extent = Vec2(0.5, 0.5);
    view.near = 0.5;
    CHECK(covered_by_strands(layer_of(drawing_of(strands), view)) ==
          Approx(once / 4.0).epsilon(0.05));
}

TEST_CASE("strand layer: a prefix of the strands covers as much") {
    const Strands strands = curtain(2000, 0.0, 0.0004);
    const StrandLayer all = layer_of(drawing_of(strands), front_view());
    // Strands overlap: 2000 x 0.0004 / 2 = 0.4 in all.
    CHECK(covered_by_strands(all) == Approx(0.4 * 96 * 96).epsilon(0.03));
    for (const double level : {0.5, 0.25, 0.1}) {
        StrandStyle style;
        style.level = level;
        const StrandLayer some = layer_of(drawing_of(strands, style), front_view());
        CAPTURE(level);
        CHECK(covered_by_strands(some) == Approx(covered_by_strands(all)).epsilon(0.04));
        const Eigen::Array3f color = mean_color(some), expected = mean_color(all);
        CHECK(color[0] == Approx(expected[0]).epsilon(0.06));
    }
    CHECK(drawn_count({.level = 0.25}, 2000) == 500);
    CHECK(drawn_count({.level = 1e-9}, 2000) == 1);
    CHECK(drawn_count({.count = 5000}, 2000) == 2000);
    CHECK(drawn_count({.count = 3}, 0) == 0);
}

TEST_CASE("strand layer: meshes hide what is behind them, strands what is behind those") {
    Mesh square = test::make_square();
    for (Vec3& p : square.edit_positions()) p *= 0.5;
    const Strands behind = curtain(100, -0.5, 0.01), before = curtain(100, 0.5, 0.01);
    const auto with_square = [&](const Strands& strands) {
        Snapshot drawing = drawing_of(strands);
        drawing.meshes.push_back({test::shared(square)});
        return layer_of(drawing, front_view());
    };
    const StrandLayer hidden = with_square(behind), shown = with_square(before);
    const auto at = [](const StrandLayer& layer, int x, int y) {
        return layer.pixels[std::size_t(96 * y + x)];
    };
    for (int y = 26; y < 70; ++y) {
        for (int x = 26; x < 70; ++x) {
            CHECK(at(hidden, x, y).strands == 0.0f);
            CHECK(at(hidden, x, y).meshes == Approx(1.0));
            CHECK(at(shown, x, y).strands + at(shown, x, y).meshes == Approx(1.0));
            CHECK(at(shown, x, y).all_meshes == Approx(1.0));
        }
    }
    CHECK(covered_by_strands(shown) ==
          Approx(covered_by_strands(layer_of(drawing_of(before), front_view()))));
    const double outside = 1.0 - 0.25;
    CHECK(covered_by_strands(hidden) == Approx(outside * covered_by_strands(shown)).epsilon(0.03));
}

TEST_CASE("strand layer: the same to the bit for any number of threads") {
    Mesh sphere = make_sphere({.segments = 16});
    for (Vec3& p : sphere.edit_positions()) p *= 0.4;
    const Strands strands = curtain(3000, 0.3, 0.001);
    Snapshot drawing = drawing_of(strands);
    drawing.meshes.push_back({test::shared(sphere)});
    const auto with = [&](int threads) {
        ContextOptions options;
        options.threads = threads;
        return layer_of(drawing, front_view(), small_options(150, 130), Context(options));
    };
    const StrandLayer one = with(1);
    CHECK(same(one, with(2)));
    CHECK(same(one, with(5)));
}

TEST_CASE("strand layer: broken strands are left out, the others stay") {
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> good = {Vec3(-0.5, 0, 0), Vec3(0, 0.1, 0), Vec3(0.5, 0, 0)};
    const Strands alone = test::strands_of({good}, 0.02);
    const Strands mixed = test::strands_of({good,
                                            {Vec3(0, 0, 0)},
                                            {Vec3(nan, 0, 0), Vec3(0, -0.5, 0)},
                                            {Vec3(0, -0.5, 0), Vec3(0, infinite, 0)},
                                            {Vec3(0.3, -0.3, 0), Vec3(0.3, -0.3, 0)}},
                                           0.02);
    const double one = covered_by_strands(layer_of(drawing_of(alone), front_view()));
    const StrandLayer layer = layer_of(drawing_of(mixed), front_view());
    // The strand without length is a dot.
    CHECK(covered_by_strands(layer) == Approx(one + kPi * 0.48 * 0.48).epsilon(0.02));
    for (const StrandPixel& pixel : layer.pixels) REQUIRE(pixel.color.allFinite());
    CHECK(covered_by_strands(layer_of(drawing_of(test::strands_of({good}, 0.0)), front_view())) ==
          0.0);
    CHECK(covered_by_strands(layer_of(drawing_of(Strands()), front_view())) == 0.0);
}

TEST_CASE("strand layer: widths have their profile, transparent strands cover less") {
    Strands strands =
        test::strands_of({{Vec3(-0.5, 0, 0), Vec3(0, 0.01, 0), Vec3(0.5, 0, 0)}}, 0.04);
    const double full = covered_by_strands(layer_of(drawing_of(strands), front_view()));
    StrandWidths widths = strands.widths();
    widths.profile = {1.0f, 0.0f};
    strands.set_widths(widths);
    const double tapered = covered_by_strands(layer_of(drawing_of(strands), front_view()));
    CHECK(tapered == Approx(0.5 * full).epsilon(0.04));
    strands.set_transparency({0.5f});
    CHECK(covered_by_strands(layer_of(drawing_of(strands), front_view())) ==
          Approx(0.5 * tapered).epsilon(0.06));
}

TEST_CASE("strand layer: strands have their colours, or that of the style") {
    Strands strands = curtain(300, 0.0, 0.002);
    StrandStyle plain;
    plain.primary.strength = 0.0;
    const auto ratio = [](const Eigen::Array3f& c) { return c[0] / c[2]; };
    const float brown = ratio(mean_color(layer_of(drawing_of(strands, plain), front_view())));
    CHECK(brown > 2.5f);
    strands.set_colors({Eigen::Vector3f(0.1f, 0.2f, 0.3f)});
    const float blue = ratio(mean_color(layer_of(drawing_of(strands, plain), front_view())));
    CHECK(blue < 0.5f);
    plain.color = Color{0.8, 0.1, 0.1};
    CHECK(ratio(mean_color(layer_of(drawing_of(strands, plain), front_view()))) > 10.0f);
}

TEST_CASE("strand layer: styles out of range are refused") {
    const Strands strands = curtain(3, 0.0, 0.01);
    const auto refused = [&](const StrandStyle& style) {
        CHECK_THROWS_AS(view_strands(drawing_of(strands, style), Mat4::Identity(), Vec3::Zero()),
                        Error);
    };
    refused({.level = 0.0});
    refused({.level = 1.5});
    refused({.count = 0});
    refused({.unit = 0.0});
    refused({.strand_tone = 2.0});
    refused({.clump_size = 0.0});
    refused({.shadow = -1.0});
    refused({.scalp_tint = std::nan("")});
}

TEST_CASE("strand layer: it lies over the meshes without a seam") {
    // Half mesh, half nothing, in all pixels.
    Image meshes(7, 1);
    for (int x = 0; x < 7; ++x) {
        const std::uint8_t half[4] = {200, 200, 200, 128};
        std::copy_n(half, 4, meshes.pixel(x, 0));
    }
    StrandLayer layer{7, 1, std::vector<StrandPixel>(7)};
    CHECK(test::difference(lay_over(meshes, layer, std::nullopt), meshes) <= 1);
    // Black strands cover the other half of the first pixels.
    for (int x = 0; x < 3; ++x) {
        layer.pixels[std::size_t(x)] = {Eigen::Array3f::Zero(), 0.5f, 0.5f, 0.5f};
    }
    const Image over = lay_over(meshes, layer, kWhite);
    const double mesh = srgb_to_linear(200 / 255.0);
    CHECK(over.is_opaque());
    // Nothing of the background shines through.
    CHECK(over.color(1, 0).g == Approx(linear_to_srgb(0.5 * mesh)).epsilon(0.02));
    CHECK(over.color(5, 0).g == Approx(linear_to_srgb(0.5 * mesh + 0.5)).epsilon(0.02));
    // Lines beside the mesh stay in what strands leave of the rest.
    StrandLayer beside{3, 1, std::vector<StrandPixel>(3)};
    Image lines(3, 1);
    for (int x = 0; x < 3; ++x) {
        const std::uint8_t line[4] = {0, 0, 0, 255};
        std::copy_n(line, 4, lines.pixel(x, 0));
        beside.pixels[std::size_t(x)] = {Eigen::Array3f::Constant(0.25f), 0.25f, 0.0f, 0.0f};
    }
    CHECK(lay_over(lines, beside, kWhite).color(1, 0).g ==
          Approx(linear_to_srgb(0.25)).epsilon(0.02));
}

TEST_CASE("strand place: hair on a mesh that is not in metres is doubted") {
    const Strands hair = test::strands_of({{{0, 0, 0}, {0, 0.2, 0.2}}});
    const auto head = [](double size) { return make_sphere({.radius = size, .segments = 8}); };
    CHECK(doubt_about_unit(hair, head(0.1), 1.0).empty());
    CHECK(doubt_about_unit(hair, head(0.9), 1.0).empty());
    CHECK(doubt_about_unit(hair, head(10.0), 0.01).empty());
    CHECK(doubt_about_unit(hair, head(10.0), 1.0).find("unit = 0.01 }") != std::string::npos);
    CHECK(doubt_about_unit(hair, head(100.0), 1.0).find("millimetres") != std::string::npos);
    CHECK(doubt_about_unit(hair, head(0.1), 0.001).find("unit = 1 }") != std::string::npos);
    CHECK(doubt_about_unit(Strands(), head(100.0), 1.0).empty());
}

TEST_CASE("strand place: roots tell the unit of the mesh") {
    const Mesh square = test::make_square();
    std::vector<std::vector<Vec3>> lines;
    StrandRoots roots;
    for (int i = 0; i < 9; ++i) {
        const float a = 0.1f * static_cast<float>(i), b = 0.02f * static_cast<float>(i * i % 7);
        roots.faces.push_back(0);
        roots.barycentrics.emplace_back(1.0f - a - b, a, b);
        const Vec3 place =
            (1.0 - a - b) * square.position(0) + a * square.position(1) + b * square.position(2);
        lines.push_back({0.01 * place, 0.01 * place + Vec3(0, 0, 0.1)});
    }
    Strands strands = test::strands_of(lines);
    CHECK_FALSE(unit_of_roots(strands, square));
    strands.set_roots(roots);
    REQUIRE(unit_of_roots(strands, square));
    CHECK(*unit_of_roots(strands, square) == Approx(0.01));
    roots.faces.back() = 1;
    strands.set_roots(roots);
    CHECK_FALSE(unit_of_roots(strands, square));
}
