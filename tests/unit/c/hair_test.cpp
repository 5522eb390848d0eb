#include <cmath>

#include "kernel/mesh/shapes/head.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

struct Style {
    explicit Style(const Host& host,
                   lissom_hairstyle_options options = lissom_default_hairstyle_options())
        : head(host.add(make_head({}))) {
        options.resolution = 12000;
        REQUIRE(lissom_hairstyle_create(host, head, &options, &style) == LISSOM_OK);
        double points[3][3];
        const double elevations[] = {1.0, 0.6, -0.3};
        for (int i = 0; i < 3; ++i) {
            REQUIRE(lissom_hairstyle_at(host, style, 1.3, elevations[i], 0.02, points[i]) ==
                    LISSOM_OK);
        }
        double normal[3];
        REQUIRE(lissom_hairstyle_normal_at(host, style, 1.3, 0.6, normal) == LISSOM_OK);
        CHECK(std::hypot(normal[0], normal[1], normal[2]) == doctest::Approx(1.0));
        CHECK(normal[0] > 0.5);
        const lissom_input list{points, 3, 0, LISSOM_FLOAT64};
        REQUIRE(lissom_hairstyle_add_stream(host, style, &list, &curve) == LISSOM_OK);
    }

    lissom_mesh head{};
    lissom_hairstyle style{};
    std::int32_t curve = -1;
};

std::vector<float> points_of(const Host& host, lissom_strands strands) {
    std::vector<float> points(3 * at(lissom_strands_point_count(host, strands)));
    const lissom_output out{points.data(), points.size() / 3, 0, LISSOM_FLOAT32};
    REQUIRE(lissom_strands_read_points(host, strands, &out) == LISSOM_OK);
    return points;
}

}  // namespace

TEST_CASE("hair grows, again into the same strands, and as a job") {
    const Host host;
    const Style made(host);
    auto options = lissom_default_grow_options();
    options.count = 500;
    lissom_strands strands{};
    REQUIRE(lissom_hairstyle_grow(host, made.style, &options, &strands) == LISSOM_OK);
    CHECK(lissom_strands_size(host, strands) == 500);
    const auto first = points_of(host, strands);
    std::vector<std::int32_t> offsets(501);
    const lissom_output out{offsets.data(), offsets.size(), 0, LISSOM_INT32};
    REQUIRE(lissom_strands_read_offsets(host, strands, &out) == LISSOM_OK);
    CHECK(offsets.front() == 0);
    CHECK(offsets.back() == lissom_strands_point_count(host, strands));

    const std::uint64_t id = strands.id;
    options.seed = 2;
    REQUIRE(lissom_hairstyle_grow(host, made.style, &options, &strands) == LISSOM_OK);
    CHECK(strands.id == id);
    CHECK(points_of(host, strands) != first);
    options.seed = 1;
    lissom_job job{};
    REQUIRE(lissom_hairstyle_begin_grow(host, made.style, &options, &job) == LISSOM_OK);
    lissom_strands again{};
    REQUIRE(lissom_job_finish(host, job, &again.id) == LISSOM_OK);
    CHECK(points_of(host, again) == first);
}

TEST_CASE("hair that no curve is near falls by default, and gravity is from 0 to 1") {
    const Host host;
    auto options = lissom_default_hairstyle_options();
    CHECK(options.gravity == 1.0);
    double down[2] = {};
    for (const double gravity : {0.0, 1.0}) {
        options.gravity = gravity;
        const Style made(host, options);
        double far[3], direction[3];
        REQUIRE(lissom_hairstyle_at(host, made.style, -1.5, -0.3, 0.03, far) == LISSOM_OK);
        REQUIRE(lissom_hairstyle_solve(host, made.style) == LISSOM_OK);
        REQUIRE(lissom_hairstyle_field(host, made.style, far, direction) == LISSOM_OK);
        down[gravity > 0.0] = direction[1];
    }
    CHECK(down[1] < -0.9);
    CHECK(down[1] != down[0]);
    options.gravity = 1.5;
    const lissom_mesh head = host.add(make_head({}));
    lissom_hairstyle style{};
    CHECK(lissom_hairstyle_create(host, head, &options, &style) == LISSOM_INVALID_ARGUMENT);
    CHECK(style.id == 0);
}

TEST_CASE("curves are listed, moved, switched off and removed") {
    const Host host;
    const Style made(host);
    CHECK(lissom_hairstyle_curve_count(host, made.style) == 1);
    double point[3], direction[3];
    REQUIRE(lissom_hairstyle_at(host, made.style, 1.3, 0.6, 0.02, point) == LISSOM_OK);
    CHECK(lissom_hairstyle_field(host, made.style, point, direction) == LISSOM_INVALID_ARGUMENT);
    REQUIRE(lissom_hairstyle_solve(host, made.style) == LISSOM_OK);
    REQUIRE(lissom_hairstyle_field(host, made.style, point, direction) == LISSOM_OK);
    // Hair flows down along the curve.
    CHECK(direction[1] < -0.5);
    CHECK(lissom_curve_enable(host, made.style, 999, false) == LISSOM_HANDLE_REMOVED);
    REQUIRE(lissom_curve_remove(host, made.style, made.curve) == LISSOM_OK);
    CHECK(lissom_hairstyle_curve_count(host, made.style) == 0);
    lissom_strands strands{};
    CHECK(lissom_hairstyle_grow(host, made.style, nullptr, &strands) == LISSOM_INVALID_ARGUMENT);
    CHECK(strands.id == 0);
}

TEST_CASE("a style is text, and fits the head it is read for") {
    const Host host;
    const Style made(host);
    lissom_bytes text{};
    REQUIRE(lissom_hairstyle_encode(host, made.style, &text) == LISSOM_OK);
    const std::string copy(static_cast<const char*>(text.data), text.size);
    lissom_hairstyle back{};
    REQUIRE(lissom_hairstyle_decode(host, copy.data(), copy.size(), made.head, nullptr, &back) ==
            LISSOM_OK);
    auto options = lissom_default_grow_options();
    options.count = 100;
    lissom_strands a{}, b{};
    REQUIRE(lissom_hairstyle_grow(host, made.style, &options, &a) == LISSOM_OK);
    REQUIRE(lissom_hairstyle_grow(host, back, &options, &b) == LISSOM_OK);
    CHECK(points_of(host, a) == points_of(host, b));
    CHECK(lissom_hairstyle_decode(host, "{", 1, made.head, nullptr, &back) == LISSOM_FILE_SYNTAX);
}

}  // namespace lissom::test
