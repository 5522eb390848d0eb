#include "kernel/merge/blend/transition.h"

#include "kernel/merge/blend/band_chart.h"
#include "kernel/merge/blend/band_map.h"
#include "kernel/merge/blend/fair_seam.h"
#include "tests/unit/merge/blend/fairing_scenes.h"

using namespace lissom;
using doctest::Approx;

namespace {

constexpr double kWidth = 0.9;

TransitionReport blend(Sewn& sewn, double target = kWidth, double source = kWidth,
                       const TransitionOptions& options = {}) {
    const std::vector<TransitionWidths> widths(sewn.seams.size(), {target, source});
    return blend_transition(sewn, widths, options);
}

// A plain cone below, a bumpy one above, and a crease between.
Sewn bumpy() {
    return test::revolution(96, 24, [](double angle, double z) {
        return z < 0.0 ? 1.0 - 0.2 * z
                       : 1.0 + 0.3 * z + 0.03 * std::sin(8 * angle) * std::sin(8 * z);
    });
}

// Difference of two fractions of a turn.
double turn_between(double a, double b) {
    return std::abs(a - b - std::round(a - b));
}

// Fraction of a turn of a point around z, as the chart of a surface of revolution counts it.
double turn_of(const Sewn& sewn, const Vec3& p) {
    const Vec3& start = sewn.mesh.position(sewn.seams[0][0]);
    const Vec3& next = sewn.mesh.position(sewn.seams[0][1]);
    const auto angle = [](const Vec3& q) { return std::atan2(q.y(), q.x()) / (2.0 * kPi); };
    const double way = angle(next) - angle(start);
    const double sign = way - std::round(way) > 0.0 ? 1.0 : -1.0;
    return sign * (angle(p) - angle(start));
}

void check_no_folds(const TransitionReport& report) {
    for (const std::vector<TransitionBand>* side : {&report.target, &report.source}) {
        for (const TransitionBand& band : *side) {
            CHECK(band.flipped == 0);
            CHECK(band.unmapped == 0);
        }
    }
}

}  // namespace

TEST_CASE("on a cylinder the coordinates are the angle and the height") {
    const Sewn tube = test::revolution(48, 20, [](double, double) { return 1.0; });
    for (const SeamSide side : {SeamSide::target, SeamSide::source}) {
        const BandChart chart = make_band_chart(tube, tube.seams[0], side, 1.0, {});
        for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
            const Vec3& p = tube.mesh.position(chart.vertex[i]);
            CHECK(turn_between(chart.angle[i], turn_of(tube, p)) < 1e-12);
            CHECK(chart.distance[i] == Approx(std::abs(p.z())).epsilon(1e-3));
            CHECK((side == SeamSide::source ? p.z() : -p.z()) > -1e-12);
        }
        CHECK(BandMap(chart, 1.0).flipped() == 0);
    }
}

TEST_CASE("on a cone the angle is exact and the distance that along the slope") {
    const Sewn cone = test::creased(0.5);
    const BandChart chart = make_band_chart(cone, cone.seams[0], SeamSide::source, 1.0, {});
    const double slope = std::sqrt(1.25);
    for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
        const Vec3& p = cone.mesh.position(chart.vertex[i]);
        CHECK(turn_between(chart.angle[i], turn_of(cone, p)) < 1e-12);
        CHECK(chart.distance[i] == Approx(slope * p.z()).epsilon(0.01));
    }
}

TEST_CASE("each vertex of a band is found in the other at the same coordinates") {
    const Sewn tube = bumpy();
    const BandChart below = make_band_chart(tube, tube.seams[0], SeamSide::target, 0.9, {});
    const BandChart above = make_band_chart(tube, tube.seams[0], SeamSide::source, 0.6, {});
    const BandMap map(above, 0.6);
    CHECK(map.flipped() == 0);
    std::vector<double> turn(static_cast<std::size_t>(tube.mesh.vertex_count())), way = turn;
    for (std::size_t i = 0; i < above.vertex.size(); ++i) {
        turn[above.vertex[i]] = above.angle[i];
        way[above.vertex[i]] = above.distance[i] / 0.6;
    }
    for (std::size_t i = 0; i < below.vertex.size(); ++i) {
        const double distance = below.distance[i] / 0.9;
        if (distance > 1.0) continue;
        const std::optional<BandPlace> place = map.locate(below.angle[i], distance);
        REQUIRE(place);
        double sum = 0.0, around = 0.0, away = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = place->vertices[k];
            CHECK(place->weights[k] > -1e-8);
            sum += place->weights[k];
            around += place->weights[k] *
                      (turn[v] - std::round(turn[v] - below.angle[i]) - below.angle[i]);
            away += place->weights[k] * way[v];
        }
        CHECK(sum == Approx(1.0));
        CHECK(std::abs(around) < 1e-9);
        CHECK(std::abs(away - distance) < 1e-9);
    }
}

TEST_CASE("a crease goes and bumps fade across, without folds in the map") {
    Sewn tube = bumpy();
    const Mesh before = tube.mesh;
    const double crease = test::seam_dihedral(tube.mesh, tube.seams);
    const TransitionReport report = blend(tube);
    check_no_folds(report);
    CHECK(report.target[0].width == kWidth);
    CHECK(test::seam_dihedral(tube.mesh, tube.seams) < 0.15 * crease);

    // Roundness of the rows: none below the band, growing through it.
    const auto bumps = [&](const Mesh& mesh, double low, double high) {
        double sum = 0.0;
        Index count = 0;
        for (Index row = 0; row < 49; ++row) {
            double mean = 0.0, square = 0.0;
            for (Index i = 0; i < 96; ++i) {
                const double r = mesh.position(row * 96 + i).head<2>().norm();
                mean += r / 96;
                square += r * r / 96;
            }
            const double z = before.position(row * 96).z();
            if (z < low || z > high) continue;
            sum += std::sqrt(std::max(0.0, square - mean * mean));
            ++count;
        }
        return sum / count;
    };
    CHECK(bumps(tube.mesh, -2.0, -0.95) < 1e-7);
    CHECK(bumps(before, -0.9, 0.0) < 1e-7);
    CHECK(bumps(tube.mesh, -0.5, -0.2) > 0.1 * bumps(before, 0.2, 0.5));
    CHECK(bumps(tube.mesh, 0.2, 0.5) < 0.8 * bumps(before, 0.2, 0.5));
    CHECK(bumps(tube.mesh, 0.95, 2.0) == bumps(before, 0.95, 2.0));
}

TEST_CASE("a side of width 0 stays to the bit, and the other one takes over its shape") {
    for (const bool source : {true, false}) {
        Sewn tube = bumpy();
        const Mesh before = tube.mesh;
        const double crease = test::seam_dihedral(tube.mesh, tube.seams);
        const TransitionReport report =
            source ? blend(tube, 0.0, kWidth) : blend(tube, kWidth, 0.0);
        check_no_folds(report);
        CHECK((source ? report.target : report.source)[0].vertices == 0);
        CHECK((source ? report.source : report.target)[0].vertices > 500);
        for (const Index v : test::moved_vertices(before, tube.mesh)) {
            CHECK((source ? 1.0 : -1.0) * before.position(v).z() > 1e-12);
        }
        CHECK(test::seam_dihedral(tube.mesh, tube.seams) < 0.5 * crease);
    }
    Sewn tube = bumpy();
    const Mesh before = tube.mesh;
    CHECK(blend(tube, 0.0, 0.0).moved.empty());
    CHECK(test::same_shape(before, tube.mesh));
}

TEST_CASE("the seam is the same from both sides") {
    // The same shape with the sides exchanged gives the same result.
    Sewn tube = bumpy(), exchanged = tube;
    for (SeamSide& side : exchanged.side_of_face) {
        side = side == SeamSide::target ? SeamSide::source : SeamSide::target;
    }
    std::reverse(exchanged.seams[0].begin(), exchanged.seams[0].end());
    blend(tube, 0.9, 0.7);
    blend(exchanged, 0.7, 0.9);
    CHECK(test::max_move(tube.mesh, exchanged.mesh) < 1e-9);
}

TEST_CASE("a smooth surface stays as it is") {
    Sewn tube = test::revolution(64, 24, [](double, double) { return 1.0; });
    blend(tube);
    for (const Vec3& p : tube.mesh.positions()) {
        CHECK(std::abs(p.head<2>().norm() - 1.0) < 1e-5);
    }
    Mesh mesh = make_sphere({.segments = 16, .kind = SphereKind::triangles});
    const Region top = select_plane(mesh, {0, 0, 0.1}, {0, 0.2, 1});
    Sewn ball = test::sewn(std::move(mesh), top);
    check_no_folds(blend(ball, 0.6, 0.6));
    for (const Vec3& p : ball.mesh.positions()) CHECK(std::abs(p.norm() - 1.0) < 0.01);
}

TEST_CASE("only what is reported moves, and lies within the widths") {
    Sewn tube = bumpy();
    const Mesh before = tube.mesh;
    const TransitionReport report = blend(tube, 0.5, 0.8);
    CHECK(test::moved_vertices(before, tube.mesh) == report.moved);
    CHECK(report.moved.size() ==
          static_cast<std::size_t>(report.target[0].vertices + report.source[0].vertices) - 96);
    for (const Index v : report.moved) {
        CHECK(before.position(v).z() > -0.5);
        CHECK(before.position(v).z() < 0.8);
    }
}

TEST_CASE("the result follows a similarity of the input, and not the threads") {
    test::Random random(8);
    Sewn tube = bumpy();
    const Mesh rest = tube.mesh;
    blend(tube);
    for (const double scale : {1e-3, 1e4}) {
        Sewn image = bumpy();
        const Affine map = test::similarity(random, scale);
        image.mesh = test::moved(rest, map);
        blend(image, scale * kWidth, scale * kWidth);
        CHECK(test::max_move(test::moved(tube.mesh, map), image.mesh) < 1e-9 * scale);
    }
    Sewn threads = bumpy();
    ContextOptions options;
    options.threads = 4;
    const std::vector<TransitionWidths> widths{{kWidth, kWidth}};
    blend_transition(threads, widths, {}, Context(options));
    CHECK(hash(threads.mesh) == hash(tube.mesh));
}

TEST_CASE("a transition does not depend on how vertices and faces are numbered") {
    Sewn tube = bumpy();
    const Index n = tube.mesh.vertex_count();
    std::vector<std::vector<Index>> orders = {test::shuffled_numbers(n, 3)};
    std::vector<Index>& first = orders.emplace_back(static_cast<std::size_t>(n));
    for (Index v = 0; v < n; ++v) first[v] = (v - tube.seams[0].front() + n) % n;
    std::vector<Sewn> images;
    for (const std::vector<Index>& to : orders) images.push_back(test::renumbered(tube, to));
    blend(tube);
    for (std::size_t i = 0; i < orders.size(); ++i) {
        blend(images[i]);
        CHECK(test::max_move(tube.mesh, images[i].mesh, orders[i]) < 1e-9);
    }
}

TEST_CASE("bands stop where the surface has no more room") {
    SUBCASE("at half the way to another seam") {
        const Mesh torus = make_torus();
        Sewn ring = test::sewn(torus, select_plane(torus, Vec3::Zero(), {1, 0, 0}));
        const TransitionReport report = blend(ring, 5.0, 5.0);
        for (const TransitionBand& band : report.source) {
            // The inner way around half the torus is 0.65 pi long.
            CHECK(band.width < 0.51 * kPi * 0.65);
            CHECK(band.width > 0.45 * kPi * 0.65);
        }
        CHECK(test::max_move(ring.mesh, torus) < 0.2);
    }
    SUBCASE("at the open end of a tube") {
        Sewn tube = test::revolution(48, 6, [](double, double) { return 1.0; });
        const Mesh before = tube.mesh;
        const TransitionReport report = blend(tube, 3.0, 3.0);
        const double end = before.position(before.vertex_count() - 1).z();
        CHECK(report.source[0].width <= end);
        CHECK(report.source[0].width > 0.85 * end);
        for (const auto& loop : before.topology().boundary_loops()) {
            for (const Index v : loop) CHECK(tube.mesh.position(v) == before.position(v));
        }
    }
    SUBCASE("before the top of a cap") {
        Mesh mesh = make_sphere({.segments = 16, .kind = SphereKind::triangles});
        const Region top = select_plane(mesh, {0, 0, 0.6}, {0, 0, 1});
        Sewn ball = test::sewn(std::move(mesh), top);
        const TransitionReport report = blend(ball, 0.5, 9.0);
        const double cap = std::acos(0.6);
        CHECK(report.source[0].width < 0.95 * cap);
        CHECK(report.source[0].width > 0.8 * cap);
        CHECK(report.target[0].width == 0.5);
        for (const Vec3& p : ball.mesh.positions()) CHECK(std::abs(p.norm() - 1.0) < 0.02);
    }
    SUBCASE("nowhere, where two seams touch") {
        Sewn tube = bumpy();
        tube.seams.push_back(tube.seams[0]);
        const Mesh before = tube.mesh;
        for (Index& v : tube.seams[1]) v += 96;
        // The second goes by way of a vertex of the first.
        const Index common = tube.seams[0][0];
        const std::span<const Index> ring = tube.mesh.topology().neighbors(common);
        const auto is_near = [&](Index v) {
            return std::find(ring.begin(), ring.end(), v) != ring.end();
        };
        std::vector<Index>& second = tube.seams[1];
        std::size_t k = 0;
        while (!is_near(second[k]) || !is_near(second[(k + 1) % second.size()])) ++k;
        second.insert(second.begin() + static_cast<std::ptrdiff_t>(k) + 1, common);
        const TransitionReport report = blend(tube);
        CHECK(report.source[0].width == 0.0);
    }
}

TEST_CASE("the smallest meshes come through") {
    FaceList faces;
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
        faces.add({a, b, 3});
        faces.add({b, a, 4});
    }
    Sewn sewn;
    sewn.mesh =
        Mesh({{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.8, 0}, {0, 0, 1}, {0, 0, -1}}, std::move(faces));
    for (int k = 0; k < 3; ++k) {
        sewn.side_of_face.push_back(SeamSide::source);
        sewn.side_of_face.push_back(SeamSide::target);
    }
    sewn.seams = {{2, 1, 0}};
    const Mesh before = sewn.mesh;
    const TransitionReport report = blend(sewn, 10.0, 10.0);
    CHECK(report.moved == std::vector<Index>{0, 1, 2});
    CHECK(sewn.mesh.position(3) == before.position(3));
    CHECK(test::max_move(sewn.mesh, before) < 2.0);
}

TEST_CASE("bad widths and options, and a cancel at any step, change nothing") {
    Sewn tube = bumpy();
    const std::uint64_t before = hash(tube.mesh);
    const auto code = [&](double target, double source, const TransitionOptions& options = {}) {
        return test::error_of([&] { blend(tube, target, source, options); }).code();
    };
    CHECK(code(-1.0, 1.0) == ErrorCode::invalid_argument);
    CHECK(code(1.0, test::kNaN) == ErrorCode::invalid_argument);
    CHECK(code(1.0, test::kInfinity) == ErrorCode::invalid_argument);
    CHECK(code(1.0, 1.0, {.core = 0}) == ErrorCode::invalid_argument);
    CHECK(code(1.0, 1.0, {.umbrella = -1}) == ErrorCode::invalid_argument);
    CHECK(code(1.0, 1.0, {.passes = 0}) == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { blend_transition(tube, {}); }).code() ==
          ErrorCode::invalid_argument);

    const std::vector<TransitionWidths> widths{{kWidth, kWidth}};
    bool finished = false;
    for (int limit = 0; !finished && limit < 200; ++limit) {
        int calls = 0;
        const Context* running = nullptr;
        ContextOptions options;
        options.progress = [&](std::string_view, double) {
            if (calls++ == limit) running->cancel();
        };
        const Context context(options);
        running = &context;
        Sewn copy = tube;
        try {
            blend_transition(copy, widths, {}, context);
            finished = true;
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
            CHECK(hash(copy.mesh) == before);
        }
    }
    CHECK(finished);
    CHECK(hash(tube.mesh) == before);
}

TEST_CASE("widths that suit a seam: nine tenths of its radius where there is room") {
    // Seven units of tube on either side of a seam of radius 1.
    const Sewn tube = test::revolution(48, 60, [](double, double) { return 1.0; });
    const TransitionWidths wide = suitable_widths(tube).front();
    CHECK(wide.source == Approx(0.9).epsilon(0.01));
    CHECK(wide.target == Approx(0.9).epsilon(0.01));
    // Half of what there is on a short side.
    const Sewn ring = test::revolution(48, 8, [](double, double) { return 1.0; });
    double end = 0.0;
    for (const Vec3& p : ring.mesh.positions()) end = std::max(end, p.z());
    CHECK(suitable_widths(ring).front().source == Approx(0.5 * end).epsilon(0.02));
    // Three edges on a coarse one.
    const Sewn coarse = test::revolution(10, 30, [](double, double) { return 1.0; });
    CHECK(suitable_widths(coarse).front().source > 1.7);
    // The transition uses them as they are.
    Sewn copy = tube;
    const std::vector<TransitionWidths> widths = suitable_widths(copy);
    const TransitionReport report = blend_transition(copy, widths);
    CHECK(report.source[0].width == widths[0].source);
    CHECK(report.target[0].width == widths[0].target);
}
