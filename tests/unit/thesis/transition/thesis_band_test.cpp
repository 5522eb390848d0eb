#include "kernel/thesis/transition/thesis_band.h"

#include <doctest/doctest.h>

#include "kernel/merge/blend/band_map.h"
#include "tests/unit/merge/real_pairs.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

ThesisBand band_of(const test::SewScene& scene, SeamSide side, double width, Index start = 0) {
    const LoopPair& pair = scene.joins[0];
    return side == SeamSide::target
               ? make_thesis_band(scene.target, target_band_loop(scene.target, pair.target, start),
                                  width, {})
               : make_thesis_band(scene.source, source_band_loop(scene.target, pair, start), width,
                                  {});
}

// Fraction of a turn of a point around y from where the seam begins, in the seam's direction.
double turn_of(const test::SewScene& scene, const Vec3& p) {
    const auto angle = [](const Vec3& q) { return std::atan2(q.z(), q.x()) / (2.0 * kPi); };
    const std::vector<Index>& loop = scene.joins[0].target;
    const double first = angle(scene.target.position(loop[0]));
    const double way = angle(scene.target.position(loop[1])) - first;
    const double turn = (way - std::round(way) > 0.0 ? 1.0 : -1.0) * (angle(p) - first);
    return turn - std::floor(turn);
}

double turn_between(double a, double b) {
    return std::abs(a - b - std::round(a - b));
}

Mesh closed_tube() {
    // A cup: open above only.
    Mesh sphere = make_sphere({.radius = 1.0, .segments = 12});
    return test::cut_in_two(sphere, [](const Vec3& p) { return p.y() < 0.3; }).target;
}

}  // namespace

TEST_CASE("on a tube the square is the angle and the height, wherever it is cut") {
    const test::SewScene scene = test::two_tubes(32, 32);
    for (const Index start : {0, 5, 31}) {
        for (const SeamSide side : {SeamSide::target, SeamSide::source}) {
            const Mesh& mesh = side == SeamSide::target ? scene.target : scene.source;
            const ThesisBand band = band_of(scene, side, 1.1, start);
            CHECK(BandMap(band.chart, band.width).flipped() == 0);
            CHECK(band.cut.front() == (side == SeamSide::target ? scene.joins[0].target
                                                                : scene.joins[0].source)[start]);
            double highest = 0.0;
            for (const Index v : band.chart.vertex) {
                highest = std::max(highest, std::abs(mesh.position(v).y()));
            }
            CHECK(highest == Approx(1.0));
            for (std::size_t i = 0; i < band.chart.vertex.size(); ++i) {
                const Vec3& p = mesh.position(band.chart.vertex[i]);
                CHECK(turn_between(band.chart.angle[i], turn_of(scene, p)) < 1e-9);
                CHECK(band.chart.distance[i] ==
                      Approx(band.width * std::abs(p.y()) / highest).epsilon(1e-9));
                CHECK(band.chart.distance[i] <= band.width * (1.0 + 1e-9));
            }
        }
    }
}

TEST_CASE("counterparts on two tubes are those of the same angle and height, for any numbers") {
    const test::SewScene scene = test::two_tubes(24, 37);
    const ThesisBand below = band_of(scene, SeamSide::target, 1.1);
    const ThesisBand above = band_of(scene, SeamSide::source, 1.1);
    const BandMap map(above.chart, above.width);
    Index inner = 0;
    for (std::size_t i = 0; i < below.chart.vertex.size(); ++i) {
        const Vec3& p = scene.target.position(below.chart.vertex[i]);
        const auto place = map.locate(below.chart.angle[i], below.chart.distance[i] / below.width);
        REQUIRE(place);
        Vec3 there = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            there += place->weights[k] * scene.source.position(place->vertices[k]);
        }
        CHECK(there.y() == Approx(-p.y()).epsilon(0.02));
        CHECK((Vec3(p.x(), 0.0, p.z()) - Vec3(there.x(), 0.0, there.z())).norm() < 0.04);
        inner += p.y() < -0.1 ? 1 : 0;
    }
    CHECK(inner >= 3 * 24);
}

TEST_CASE("the cut is the shortest path to the other end, and a region's holes count as filled") {
    const Mesh tube = test::make_tube(32, 0.0, 2.0, 1.0, 16);
    std::vector<Index> faces;
    for (Index f = 0; f < tube.face_count(); ++f) {
        const std::span<const Index> face = tube.topology().face(f);
        // One vertex of the second row goes.
        const bool hole = std::any_of(face.begin(), face.end(), [&](Index v) {
            const Vec3& p = tube.position(v);
            return p.x() < -0.99 && p.y() > 0.1 && p.y() < 0.2;
        });
        if (!hole) faces.push_back(f);
    }
    for (const Mesh& source : {tube, extract_faces(tube, faces).mesh}) {
        test::SewScene scene{test::make_tube(32, -2.0, 2.0, 1.0, 16), source, {}};
        test::add_join(scene, test::boundary_towards(scene.target, 1.0),
                       test::boundary_towards(scene.source, -1.0), Vec3(1.0, 0.0, 1e-3));
        const ThesisBand band = band_of(scene, SeamSide::source, 0.99);
        CHECK(band.cut.size() == 8);
        CHECK(BandMap(band.chart, band.width).flipped() == 0);
        for (const double away : band.chart.distance) {
            CHECK(away >= 0.0);
            CHECK(away <= band.width);
        }
    }
}

TEST_CASE("real parts: no triangle of the square turns over") {
    for (const test::RealPair& pair : test::real_pairs()) {
        const auto part = test::load_part(pair.target);
        if (!part) return;
        CAPTURE(pair.name);
        const double width = 0.16 * part->boundary.length(part->mesh);
        const ThesisBand band = make_thesis_band(
            part->mesh, target_band_loop(part->mesh, part->boundary.vertices(), 0), width, {});
        double whole = 0.0;
        for (const Triangle& t : band.chart.triangles) {
            std::array<Vec2, 3> at;
            for (std::size_t k = 0; k < 3; ++k) {
                const double first = band.chart.angle[t[0]], angle = band.chart.angle[t[k]];
                at[k] = {angle - std::round(angle - first), band.chart.distance[t[k]] / width};
            }
            const Vec2 a = at[1] - at[0], b = at[2] - at[0];
            const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
            CHECK(area > -1e-12);
            whole += area;
        }
        CHECK(whole == Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("a region that is no band is an error that says what to do") {
    const test::SewScene tubes = test::two_tubes(24, 24);
    const auto code = [](const test::SewScene& scene, double width) {
        return test::error_of([&] { band_of(scene, SeamSide::target, width); }).code();
    };
    CHECK(code(tubes, 0.01) == ErrorCode::invalid_argument);
    test::SewScene cup = tubes;
    cup.target = closed_tube();
    cup.joins[0].target = cup.target.topology().boundary_loops()[0];
    CHECK_NOTHROW(band_of(cup, SeamSide::target, 0.7));
    CHECK(code(cup, 10.0) == ErrorCode::invalid_argument);
}
