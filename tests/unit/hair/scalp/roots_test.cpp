#include "kernel/hair/scalp/roots.h"

#include <algorithm>

#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// The upper half of a sphere of radius 0.1 as a scalp with a sharp hairline.
struct Dome {
    Mesh mesh =
        test::moved(make_sphere({.segments = 24}), scaling(Vec3::Constant(0.1), Vec3::Zero()));
    ScalpOptions options;
    double area = 0.0;

    Dome() {
        options.hints = {Vec3::UnitY(), Vec3::UnitZ()};
        options.region = select_plane(mesh, Vec3::Zero(), Vec3::UnitY());
        options.softness = 0.0;
        const std::vector<double> areas = face_areas(mesh);
        for (const Index f : options.region->faces()) area += areas[f];
    }
    Scalp scalp() const { return Scalp(mesh, options); }
};

bool same(const Root& a, const Root& b) {
    return a.face == b.face && a.triangle == b.triangle && a.barycentric == b.barycentric &&
           a.position == b.position && a.normal == b.normal;
}

double min_distance(std::vector<Root> roots) {
    std::sort(roots.begin(), roots.end(),
              [](const Root& a, const Root& b) { return a.position.x() < b.position.x(); });
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < roots.size(); ++i) {
        for (std::size_t j = i + 1; j < roots.size(); ++j) {
            if (roots[j].position.x() - roots[i].position.x() >= least) break;
            least = std::min(least, (roots[i].position - roots[j].position).norm());
        }
    }
    return least;
}

// The farthest that any of some points of the scalp is from the nearest root.
double widest_gap(const std::vector<Root>& roots, const std::vector<Root>& probes) {
    double widest = 0.0;
    for (const Root& probe : probes) {
        double least = std::numeric_limits<double>::infinity();
        for (const Root& root : roots) {
            least = std::min(least, (root.position - probe.position).squaredNorm());
        }
        widest = std::max(widest, std::sqrt(least));
    }
    return widest;
}

}  // namespace

TEST_CASE("roots are evenly spread, whatever their number") {
    const Dome dome;
    const Scalp scalp = dome.scalp();
    const std::vector<Root> all = make_roots(dome.mesh, scalp, {.count = 20000});
    const std::vector<Root> probes = make_roots(dome.mesh, scalp, {.count = 500, .seed = 77});
    for (const std::size_t n : {100, 1000, 5000, 20000}) {
        const std::vector<Root> roots(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
        const double spacing = std::sqrt(dome.area / static_cast<double>(n));
        CHECK(min_distance(roots) >= 0.55 * spacing);
        CHECK(widest_gap(roots, probes) <= 1.5 * spacing);
    }
}

TEST_CASE("the first roots of many are those of few, on any number of threads") {
    const Dome dome;
    const Scalp scalp = dome.scalp();
    for (const RootPattern pattern : {RootPattern::poisson, RootPattern::angles}) {
        const std::vector<Root> all =
            make_roots(dome.mesh, scalp, {.count = 9000, .pattern = pattern}, test::threads(2));
        REQUIRE(all.size() == 9000);
        for (const Index count : {0, 1, 255, 4097, 9000}) {
            const std::vector<Root> some =
                make_roots(dome.mesh, scalp, {.count = count, .pattern = pattern});
            REQUIRE(some.size() == static_cast<std::size_t>(count));
            CHECK(std::equal(some.begin(), some.end(), all.begin(), same));
        }
    }
}

TEST_CASE("seeds give other roots") {
    const Dome dome;
    const Scalp scalp = dome.scalp();
    for (const RootPattern pattern : {RootPattern::poisson, RootPattern::angles}) {
        const auto a = make_roots(dome.mesh, scalp, {.count = 100, .seed = 1, .pattern = pattern});
        const auto b = make_roots(dome.mesh, scalp, {.count = 100, .seed = 2, .pattern = pattern});
        CHECK(!std::equal(a.begin(), a.end(), b.begin(), same));
    }
}

TEST_CASE("a root knows its face, its place in it and its normal") {
    const Mesh head = make_head({.vertices = 3000});
    const Scalp scalp(head);
    for (const RootPattern pattern : {RootPattern::poisson, RootPattern::angles}) {
        for (const Root& root : make_roots(head, scalp, {.count = 500, .pattern = pattern})) {
            const auto face = head.topology().face(root.face);
            Vec3 position = Vec3::Zero();
            for (int corner = 0; corner < 3; ++corner) {
                CHECK(std::find(face.begin(), face.end(), root.triangle[corner]) != face.end());
                position += root.barycentric[corner] * head.position(root.triangle[corner]);
            }
            CHECK(root.barycentric.minCoeff() >= 0.0);
            CHECK(root.barycentric.sum() == Approx(1.0));
            CHECK((position - root.position).norm() < 1e-12);
            CHECK(root.normal.norm() == Approx(1.0));
            CHECK(root.normal.dot(root.position) > 0.0);
            CHECK(std::binary_search(scalp.root_faces().begin(), scalp.root_faces().end(),
                                     root.face));
        }
    }
}

TEST_CASE("densities set the share of roots") {
    const Dome dome;
    const Scalp scalp = dome.scalp();
    std::vector<double> density;
    for (const Vec3& p : dome.mesh.positions()) density.push_back(p.x() > 0.0 ? 2.0 : 0.5);
    const auto roots = make_roots(dome.mesh, scalp, {.count = 10000, .density = density});
    double left = 0.0, right = 0.0;
    for (const Root& root : roots) {
        left += root.position.x() > 0.02;
        right += root.position.x() < -0.02;
    }
    CHECK(left / right == Approx(4.0).epsilon(0.15));
    for (double& d : density) d = d > 1.0 ? 1.0 : 0.0;
    for (const Root& root : make_roots(dome.mesh, scalp, {.count = 2000, .density = density})) {
        CHECK(root.position.x() > -0.01);
    }
}

TEST_CASE("hair thins out at a guessed hairline and stays behind it") {
    const auto mesh = test::load_head("ict_head.obj");
    if (!mesh) return;
    const Scalp scalp(*mesh);
    int behind = 0, between = 0, before = 0;
    for (const Root& root : make_roots(*mesh, scalp, {.count = 20000})) {
        const ScalpDirection at = scalp.direction_of(root.position);
        if (std::abs(at.azimuth) > 0.4) continue;
        const double above = at.elevation - hairline_elevation(default_hairline(), at.azimuth);
        CHECK(above > -0.05);
        behind += above > 0.10 && above < 0.15;
        between += above > 0.0 && above < 0.05;
        before += above < 0.0;
    }
    CHECK(behind > 80);
    CHECK(between > behind / 10);
    CHECK(between < behind);
    CHECK(before < behind / 5);
}

TEST_CASE("a guessed hairline is as sharp on large faces as on small ones") {
    Mesh head = make_head({.vertices = 3000});
    REQUIRE(head.remove_region("scalp"));
    const Scalp scalp(head);
    REQUIRE(scalp.guessed());
    int at_the_line = 0;
    for (const Root& root : make_roots(head, scalp, {.count = 20000})) {
        const ScalpDirection to = scalp.direction_of(root.position);
        if (std::abs(to.azimuth) > 0.6) continue;
        const double angle = to.elevation - hairline_elevation(default_hairline(), to.azimuth);
        const double above = angle * scalp.to_metres(root.position).norm();
        CHECK(above > -0.0025);
        at_the_line += above < 0.005;
    }
    CHECK(at_the_line > 20);
}

TEST_CASE("roots by angles are dense at the crown") {
    const Dome dome;
    const auto roots =
        make_roots(dome.mesh, dome.scalp(), {.count = 4000, .pattern = RootPattern::angles});
    int crown = 0, rim = 0;
    for (const Root& root : roots) {
        crown += root.position.y() > 0.09;
        rim += root.position.y() < 0.01;
    }
    // Both zones of the sphere have the same area.
    CHECK(crown > 2 * rim);
}

TEST_CASE("roots without sense are refused, and memory is charged") {
    const Dome dome;
    const Scalp scalp = dome.scalp();
    const auto code = [&](const RootOptions& options) {
        return test::error_of([&] { (void)make_roots(dome.mesh, scalp, options); }).code();
    };
    CHECK(code({.count = -1}) == ErrorCode::out_of_range);
    CHECK(code({.count = kMaximumRoots + 1}) == ErrorCode::out_of_range);
    CHECK(code({.count = 10, .density = {1.0}}) == ErrorCode::invalid_argument);
    std::vector<double> density(static_cast<std::size_t>(dome.mesh.vertex_count()), 0.0);
    CHECK(code({.count = 10, .density = density}) == ErrorCode::region_empty);
    density[3] = test::kNaN;
    CHECK(code({.count = 10, .density = density}) == ErrorCode::not_finite);
    const Mesh other = make_sphere();
    CHECK(test::error_of([&] { (void)make_roots(other, scalp, {}); }).code() ==
          ErrorCode::topology_mismatch);
    ContextOptions options;
    options.memory_limit = 1000;
    CHECK(test::error_of([&] {
              (void)make_roots(dome.mesh, scalp, {}, Context(options));
          }).code() == ErrorCode::memory_limit);
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { (void)make_roots(dome.mesh, scalp, {}, context); }).code() ==
          ErrorCode::cancelled);
}
