// What a report says of a result, and handles that nearly touch.
#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "kernel/deform/deform_report.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/first_solution.h"
#include "kernel/mesh/measure/distortion.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

/// A bar whose two halves are handles, `apart` rows of vertices of it free between them.
Scene halves(Index apart) {
    const Mesh bar = make_bar({1.0, 5.0, 6, 30});
    const Box box = bounds(bar);
    const double row = (box.max.y() - box.min.y()) / 30.0, middle = box.min.y() + 15.1 * row;
    Scene scene{bar, {}, {}, surface_radius(bar), Vec3::UnitX()};
    for (Index v = 0; v < bar.vertex_count(); ++v) {
        const double y = bar.position(v).y();
        if (y < middle) scene.low.push_back(v);
        if (y > middle + apart * row) scene.high.push_back(v);
    }
    return scene;
}

struct Result {
    DeformReport report;
    std::vector<Vec3> positions;
};

Result reported(const Scene& scene, const Affine& move, const DeformOptions& options = {}) {
    Edit edit = make_edit(scene, options);
    edit.deformer.set_transform(edit.high, move);
    std::vector<Vec3> x = edit.deformer.solve();
    return {report_of(edit.deformer, scene.mesh, {.crossings = true}), std::move(x)};
}

Affine turned(const Scene& scene, double degrees) {
    Vec3 center = Vec3::Zero();
    for (const Index v : scene.high) {
        center += scene.mesh.position(v) / static_cast<double>(scene.high.size());
    }
    return rotation(Vec3::UnitX(), degrees * kPi / 180.0, center);
}

bool contains(const std::vector<Index>& list, Index v) {
    return std::find(list.begin(), list.end(), v) != list.end();
}

}  // namespace

TEST_CASE("report: at rest nothing has changed") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    const DeformReport report = report_of(edit.deformer, scene.mesh, {.crossings = true});
    CHECK(report.stretch == 1.0);
    CHECK(report.flipped.empty());
    CHECK(report.crossings->empty());
    CHECK(*report.volume_change == 0.0);
    CHECK(report.tears.empty());
    CHECK(report.warnings.empty());
    CHECK(!report_of(edit.deformer, scene.mesh).crossings);
}

TEST_CASE("report: stretch, its edge and the volume are those of the surface") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    DeformOptions options;
    options.local_size = LocalSize::scale;
    Edit edit = make_edit(scene, options);
    const Affine twice = scaling(Vec3::Constant(2.0), Vec3::Zero());
    edit.deformer.set_transform(edit.low, twice);
    edit.deformer.set_transform(edit.high, twice);
    edit.deformer.solve();
    DeformReport report = report_of(edit.deformer, scene.mesh);
    CHECK(report.stretch == doctest::Approx(2.0).epsilon(1e-6));
    CHECK(*report.volume_change == doctest::Approx(7.0).epsilon(1e-6));
    edit.deformer.set_transform(edit.low, {});
    edit.deformer.set_transform(edit.high, translation(2.0 * Vec3::UnitY()));
    const std::vector<Vec3> x = edit.deformer.solve();
    report = report_of(edit.deformer, scene.mesh);
    const auto [a, b] = report.stretched;
    const double rest = (scene.mesh.position(a) - scene.mesh.position(b)).norm();
    CHECK(report.stretch == doctest::Approx((x[a] - x[b]).norm() / rest));
    CHECK(report.stretch > 1.3);
}

TEST_CASE("report: folds and crossings are counted where there were none at rest") {
    const Result twisted = reported(halves(1), turned(halves(1), 150.0));
    CHECK(!twisted.report.crossings->empty());
    CHECK(!twisted.report.flipped.empty());
    const Scene far = make_scene(make_bar({1.0, 5.0, 6, 30}));
    const Result bent = reported(far, turned(far, 30.0));
    CHECK(bent.report.crossings->empty());
    CHECK(bent.report.flipped.empty());
}

TEST_CASE("handles that nearly touch: the report names the vertices that part, and what helps") {
    for (const Index apart : {0, 1}) {
        const Scene scene = halves(apart);
        const DeformReport report = reported(scene, turned(scene, 60.0)).report;
        REQUIRE(!report.tears.empty());
        for (const Tear& tear : report.tears) {
            CHECK(tear.slip > 1.5);
            CHECK(contains(scene.low, tear.vertices[0]) != contains(scene.low, tear.vertices[1]));
            CHECK(contains(scene.high, tear.vertices[0]) != contains(scene.high, tear.vertices[1]));
        }
        CHECK(report.tears.front().slip >= report.tears.back().slip);
        REQUIRE(!report.warnings.empty());
        const DeformWarning& warning = report.warnings.front();
        CHECK(warning.harm == DeformHarm::torn);
        CHECK(warning.message.find("free_rings = ") != std::string::npos);
        CHECK(warning.elements.count == 2 * report.tears.size());
    }
    const Scene apart = halves(4);
    CHECK(reported(apart, turned(apart, 60.0)).report.tears.empty());
    const Scene touching = halves(0);
    CHECK(reported(touching, translation(0.1 * Vec3::UnitX())).report.tears.empty());
}

TEST_CASE("handles that nearly touch: rings given up at both borders bridge what was torn") {
    const Scene scene = halves(0);
    const Affine move = turned(scene, 60.0);
    const Result torn = reported(scene, move);
    double before = torn.report.stretch;
    CHECK(!torn.report.crossings->empty());
    for (const int rings : {2, 4}) {
        DeformOptions options;
        options.free_rings = rings;
        const Result bridged = reported(scene, move, options);
        CHECK(bridged.report.stretch < 0.7 * before);
        before = bridged.report.stretch;
        // What is farther from the gap is held as before, to the bit.
        Index held = 0;
        for (const Index v : scene.high) held += bridged.positions[v] == torn.positions[v];
        CHECK(held < static_cast<Index>(scene.high.size()));
        CHECK(held > static_cast<Index>(scene.high.size()) / 2);
    }
    DeformOptions options;
    options.free_rings = 4;
    CHECK(reported(scene, move, options).report.crossings->empty());
    CHECK(reported(scene, move, options).report.tears.empty());
}

TEST_CASE("handles that nearly touch: small ones keep a ring, and rigid motions are exact") {
    const Scene scene = halves(0);
    DeformOptions options;
    options.free_rings = 10;
    Deformer d(scene.mesh, scene.all(), options);
    std::vector<Index> ring;
    const double y = scene.mesh.position(scene.high.front()).y();
    double lowest = 1e300;
    for (const Index v : scene.high) lowest = std::min(lowest, scene.mesh.position(v).y());
    for (const Index v : scene.high) {
        if (scene.mesh.position(v).y() < lowest + 1e-6) ring.push_back(v);
    }
    REQUIRE(y >= lowest);
    d.add_handle(scene.region(scene.low));
    const HandleId high = d.add_handle(scene.region(ring));
    const Affine rigid = rotation({1, -1, 2}, 1.1, {0, 0, 1});
    for (const HandleId handle : d.handles()) d.set_transform(handle, rigid);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), rigid)) < 1e-9);
    d.set_transform(high, translation(Vec3::UnitX()) * rigid);
    const std::vector<Vec3> x = d.solve();
    for (const Index v : ring) {
        CHECK(x[v] == (translation(Vec3::UnitX()) * rigid)(scene.mesh.position(v)));
    }
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) < 1e-9);
}

namespace {

bool warns_of(const DeformReport& report, DeformHarm harm) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [&](const DeformWarning& warning) { return warning.harm == harm; });
}

}  // namespace

TEST_CASE("report: each harm is warned of, with its elements and what helps") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    const DeformReport crumpled = reported(halves(1), turned(halves(1), 150.0)).report;
    REQUIRE(crumpled.stretch > 3.0);
    REQUIRE(!crumpled.flipped.empty());
    REQUIRE(!crumpled.crossings->empty());
    for (const DeformHarm harm :
         {DeformHarm::stretched, DeformHarm::folded, DeformHarm::crossing}) {
        CHECK(warns_of(crumpled, harm));
    }
    for (const DeformWarning& warning : crumpled.warnings) {
        CHECK(warning.message.find(';') != std::string::npos);
        const bool of_volume = warning.harm == DeformHarm::volume;
        CHECK((warning.elements.count == 0) == of_volume);
        if (warning.harm == DeformHarm::folded) {
            CHECK(warning.elements.kind == ElementKind::face);
            CHECK(warning.elements.count == crumpled.flipped.size());
        }
    }
    const DeformReport wrung = reported(scene, rotation(Vec3::UnitY(), 3.1, Vec3::Zero())).report;
    CHECK(warns_of(wrung, DeformHarm::volume) == (*wrung.volume_change < -0.25));
}

TEST_CASE("report: its text names the harms, the measures and what helps") {
    DeformReport report;
    report.stretch = 1.25;
    CHECK(report_text(report) == "ok: edges stretch up to 1.25 times, no folded faces");
    report.flipped = {3};
    report.crossings.emplace(2);
    report.volume_change = -0.25;
    report.tears.resize(1);
    report.warnings.push_back({DeformHarm::torn, "free them", {}});
    report.warnings.push_back({DeformHarm::volume, "scale it", {}});
    CHECK(report_text(report) ==
          "torn, volume: edges stretch up to 1.25 times, 1 folded face, 2 pairs of faces cross, "
          "1 tear, volume -25 %\n  torn: free them\n  volume: scale it");
}

TEST_CASE("report: a good result is warned of nothing, nor is a size that handles ask for") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    CHECK(reported(scene, turned(scene, 60.0)).report.warnings.empty());
    CHECK(reported(scene, rotation(Vec3::UnitY(), 1.2, Vec3::Zero())).report.warnings.empty());
    Vec3 center = Vec3::Zero();
    for (const Index v : scene.high) center += scene.mesh.position(v);
    center /= static_cast<double>(scene.high.size());
    CHECK(reported(scene, scaling(Vec3::Constant(2.5), center)).report.warnings.empty());
    CHECK(reported(scene, scaling(Vec3::Constant(0.4), center)).report.warnings.empty());
}

TEST_CASE("report: steep faces that a small move tilts on have not flipped") {
    // A ledge whose narrow face stands at more than a right angle to the mean of its neighbours
    // after a slight turn.
    const std::vector<Vec3> rest{{0, 0, 0},    {1, 0, 0},    {0, 1, 0},    {1, 1, 0},
                                 {0, 1, 0.02}, {1, 1, 0.02}, {0, 2, 0.02}, {1, 2, 0.02}};
    FaceList faces;
    for (const Index a : {0, 2, 4}) {
        faces.add({a, a + 1, a + 3});
        faces.add({a, a + 3, a + 2});
    }
    const Mesh before(rest, faces);
    std::vector<Vec3> tilted = rest;
    for (const Index v : {4, 5, 6, 7}) tilted[at(v)].y() -= 0.002;
    const Mesh after(tilted, before.shared_topology());
    CHECK(distortion(after, before).flipped.empty());
    for (const Index v : {4, 5, 6, 7}) tilted[at(v)].y() -= 0.2;
    CHECK(!distortion(Mesh(tilted, before.shared_topology()), before).flipped.empty());
}
