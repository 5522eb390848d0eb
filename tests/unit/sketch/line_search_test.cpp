#include "kernel/sketch/line_search.h"

#include <algorithm>
#include <limits>

#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/picking.h"
#include "tests/unit/sketch/pick_support.h"

using namespace lissom;

namespace {

struct Lines {
    std::vector<float> points;
    std::vector<Index> offsets{0};
};

// Random walks of one to a few points.
Lines random_lines(test::Random& random, Index count) {
    Lines lines;
    for (Index i = 0; i < count; ++i) {
        Vec3 at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        for (int k = 0; k < 1 + i % 5; ++k) {
            for (const double x : at) lines.points.push_back(static_cast<float>(x));
            at += Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        }
        lines.offsets.push_back(count_of(lines.points) / 3);
    }
    return lines;
}

PolylineSet all_of(const Lines& lines) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < lines.points.size(); i += 3) {
        points.emplace_back(lines.points[i], lines.points[i + 1], lines.points[i + 2]);
    }
    return {std::move(points), lines.offsets};
}

}  // namespace

// From outside and from between the lines, with and without perspective, wherever they stand.
TEST_CASE("line search: every line that picking finds within the radius is found, and few others") {
    test::Random random(5);
    for (int trial = 0; trial < 60; ++trial) {
        const Lines lines = random_lines(random, 200);
        const PolylineSet set = all_of(lines);
        CameraOptions camera;
        camera.eye = Vec3(0.3, 0.2, trial % 3 ? 6.0 : 0.5);
        if (trial % 2) camera.ortho = 4.0;
        Affine place;
        place.linear = trial % 4 ? Mat3(2.0 * Mat3::Identity()) : Mat3(Mat3::Identity());
        place.translation = Vec3(0.1, -0.2, 0.05 * trial);
        const View view{Camera(camera), {640, 480}};
        const Vec2 cursor(random.uniform(0, 640), random.uniform(0, 480));
        const double radius = trial % 5 ? 20.0 : 0.0;
        const auto near = lines_near(lines.points, lines.offsets, place, view, cursor, radius);
        CHECK(near.size() < 120);
        PickScene scene;
        scene.add(set, {.to_world = place});
        PickOptions options;
        options.kinds = {PickKind::polyline};
        options.radius = radius;
        for (const PickHit& hit : pick_all(scene, view, cursor, options)) {
            const auto run = std::find_if(near.begin(), near.end(), [&](const LineRun& one) {
                return one.line == hit.index;
            });
            REQUIRE(run != near.end());
            CHECK(run->first <= hit.segment);
            CHECK((hit.segment < run->last || run->first == run->last));
        }
    }
}

TEST_CASE("line search: empty lines, lines that are not finite, bad radii") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> points{0, 0, 0, 0, 0.1f, 0, nan, 0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<Index> offsets{0, 2, 4, 4, 5};
    CameraOptions camera;
    camera.eye = Vec3(0, 0, 5);
    const View view{Camera(camera), {640, 480}};
    CHECK(lines_near(points, offsets, {}, view, {320, 240}, 5.0) ==
          std::vector<LineRun>{{0, 0, 1}, {3, 0, 0}});
    CHECK(lines_near({}, {}, {}, view, {320, 240}, 5.0).empty());
    CHECK(lines_near(points, offsets, {}, view, {20, 20}, 5.0).empty());
    for (const double radius : {-1.0, double(nan)}) {
        CHECK_THROWS_AS(lines_near(points, offsets, {}, view, {320, 240}, radius), Error);
    }
}
