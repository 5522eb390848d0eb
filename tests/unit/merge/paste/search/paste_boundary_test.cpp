// Boundaries free of the mesh's edges, and what a paste refuses.
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>

#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Sum of the angles by which a closed line turns at its points, over a full turn.
double turning_of(const std::vector<Vec3>& points) {
    double sum = 0.0;
    const std::size_t n = points.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 in = points[k] - points[(k + n - 1) % n], out = points[(k + 1) % n] - points[k];
        sum += std::atan2(in.cross(out).norm(), in.dot(out));
    }
    return sum / (2.0 * kPi);
}

PasteOptions along(PasteBoundary loop) {
    PasteOptions options;
    options.loop = loop;
    return options;
}

}  // namespace

TEST_CASE("paste boundary: a smooth one is no sawtooth, costs no more, and pastes as well") {
    const Mesh horn = horned_ball(32), target = egg();
    for (const Vec3& at : {Vec3(0, 2, 0), Vec3(1, 1.2, 0.8), Vec3(0, 0, 1.6)}) {
        const PastePlacement placement{.at = at, .scale = 0.8};
        Paste teeth = horn_on_egg(horn, target, placement, along(PasteBoundary::mesh));
        Paste smooth = horn_on_egg(horn, target, placement, along(PasteBoundary::smooth));
        const double jagged = turning_of(teeth.optimize().points(horn));
        const Path line = smooth.optimize();
        REQUIRE(!line.on_mesh());
        CHECK(turning_of(line.points()) < 1.5);
        CHECK(turning_of(line.points()) < 0.8 * jagged);
        CHECK(*smooth.search().smooth_energy <= smooth.search().energy.back() * (1.0 + 1e-12));
        CHECK(smooth.image().points().size() == line.points().size());
        const PasteResult result = smooth.merge();
        CHECK(result.merged.mesh.topology().is_closed());
        CHECK(result.report.euler_characteristic == result.report.expected_characteristic);
        CHECK(result.report.near.energy <= 1.5 * teeth.merge().report.near.energy);
    }
}

TEST_CASE(
    "paste boundary: a part that slides keeps its boundary, and what is kept changes nothing") {
    const Mesh horn = horned_ball(32), target = egg();
    const PastePlacement first{.at = {0, 2, 0}, .angle = 0.2, .scale = 0.8};
    const PastePlacement second{.at = {0.5, 1.8, 0.4}, .angle = 0.3, .scale = 0.7};
    Paste often = horn_on_egg(horn, target, first), once = horn_on_egg(horn, target, first);
    const std::vector<Vec3> line = often.optimize().points();
    once.optimize();
    // Equal as it is made twice, and after another place.
    const std::uint64_t at_first = hash(often.merge().merged.mesh);
    CHECK(hash(often.merge().merged.mesh) == at_first);
    often.slide(second);
    REQUIRE(!often.loop().on_mesh());
    REQUIRE(often.loop().points().size() == line.size());
    for (std::size_t k = 0; k < line.size(); ++k) {
        CHECK((often.loop().points()[k] - line[k]).norm() < 1e-12);
    }
    const PasteResult slid = often.merge();
    CHECK(slid.report.smooth);
    CHECK(slid.merged.mesh.topology().is_closed());
    CHECK(slid.report.euler_characteristic == slid.report.expected_characteristic);
    CHECK(slid.report.search.smooth_energy);
    once.slide(second);
    CHECK(hash(once.merge().merged.mesh) == hash(slid.merged.mesh));
    often.move(first);
    once.move(first);
    CHECK(hash(once.merge().merged.mesh) == hash(often.merge().merged.mesh));
}

TEST_CASE("paste boundary: a line through faces divides values by its side") {
    const Mesh grid = make_grid({.size = {2, 2}, .segments = {20, 20}});
    std::vector<Vec2> uv, circle;
    std::vector<Index> vertices;
    for (Index v = 0; v < grid.vertex_count(); ++v) {
        vertices.push_back(v);
        uv.emplace_back(grid.position(v).x(), grid.position(v).z());
    }
    for (int k = 0; k < 200; ++k) {
        circle.emplace_back(0.6 * std::cos(kPi * k / 100.0), 0.6 * std::sin(kPi * k / 100.0));
    }
    CHECK(!crosses_itself(circle));
    std::vector<double> value(uv.size(), -1.0);
    REQUIRE(set_line_values(grid.topology(), vertices, uv, circle, value));
    for (std::size_t v = 0; v < uv.size(); ++v) {
        const double depth = 0.6 - uv[v].norm();
        if (std::abs(depth) > 1e-3) CHECK((value[v] > 0.0) == (depth > 0.0));
        if (std::abs(depth) < 0.05) CHECK(value[v] == doctest::Approx(depth).epsilon(0.02));
    }
    std::swap(circle[20], circle[120]);
    CHECK(crosses_itself(circle));
}

TEST_CASE("paste: what is refused names elements, and changes nothing") {
    const Mesh horn = horned_ball(), target = egg();
    const std::uint64_t before[] = {hash(horn), hash(target)};
    const Region region = around_horn(horn);
    const Region top = select_plane(target, {0, 0.2, 0}, {0, 1, 0});
    const auto refused = [&](const Region& marked, const std::optional<Region>& onto,
                             const PastePlacement& placement) {
        const Error error = error_of(
            [&] { Paste(horn, target, marked, std::nullopt, onto, placement).optimize(); });
        CHECK(hash(horn) == before[0]);
        CHECK(hash(target) == before[1]);
        return error;
    };
    // A target smaller than the part, and a placement outside the target's region.
    const Region small = select_sphere(target, {0, 2, 0}, 0.3);
    for (const Error& error : {refused(region, small, {.at = {0, 2, 0}}),
                               refused(region, top, {.at = {0, 2, 0}, .scale = 20.0}),
                               refused(region, top, {.at = {0, -2, 0}})}) {
        CHECK(error.code() == ErrorCode::boundary_conflict);
        CHECK(!error.elements().ids.empty());
    }
    // Regions of other meshes.
    CHECK(refused(top, std::nullopt, {.at = {0, 2, 0}}).code() == ErrorCode::topology_mismatch);
    CHECK(refused(region, region, {.at = {0, 2, 0}}).code() == ErrorCode::topology_mismatch);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(region, top, {.at = {0, nan, 0}}).code() == ErrorCode::not_finite);
    CHECK(refused(region, top, {.at = {0, 2, 0}, .scale = 0.0}).code() ==
          ErrorCode::invalid_argument);
    CHECK(refused(region, top, {.at = {0, 2, 0}, .toward = Vec3(0, 0, 0)}).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE(
    "paste: a region whose map turns faces over whatever is done is refused, and they are named") {
    // Each ring of a needle is a few times smaller in the plane than the one before, until it is
    // lost to rounding.
    const Mesh horn = horned_ball();
    const Mesh needle =
        make_cylinder({.radius = 1.0, .height = 900.0, .segments = 3, .rings = 300});
    const Region onto = select_plane(needle, {0, -445, 0}, {0, 1, 0});
    const std::uint64_t before[] = {hash(horn), hash(needle)};
    const Error error = error_of([&] {
        Paste(horn, needle, around_horn(horn), std::nullopt, onto,
              {.at = {0, 450, 0}, .scale = 0.1});
    });
    CAPTURE(error.what());
    CHECK(error.code() == ErrorCode::boundary_conflict);
    CHECK(std::string(error.what()).find("turns over") != std::string::npos);
    CHECK(error.elements().kind == ElementKind::face);
    CHECK(!error.elements().ids.empty());
    CHECK(hash(horn) == before[0]);
    CHECK(hash(needle) == before[1]);
}
