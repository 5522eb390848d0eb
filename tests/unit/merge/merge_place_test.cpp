// Where parts come to lie that are merged without keys.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/merge/merge.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/path.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A dome of radius 1 on the plane z = 0, open there, whose outline is `aspect` times as long in x.
// One side is swollen, so that only a whole turn maps it onto itself.
Mesh swollen_dome(Index count, double aspect = 1.0) {
    Mesh open = tube(count, 16, [&](double angle, double height) {
        const double swell = 1.0 + 0.4 * std::cos(angle) * height * (1.0 - height);
        const double r = swell * std::sqrt(1.0 - 0.98 * height * height);
        return Vec3(aspect * r * std::cos(angle), r * std::sin(angle), 1.6 * height);
    });
    FaceList faces = open.topology().faces();
    std::vector<Index> top;
    for (Index k = 0; k < count; ++k) top.push_back(15 * count + k);
    faces.add(top);
    return Mesh({open.positions().begin(), open.positions().end()}, faces);
}

// The same below the plane: swollen on the same side, twice as large.
Mesh swollen_bowl(Index count) {
    Affine over = rotation(Vec3::UnitX(), kPi, Vec3::Zero());
    over.linear *= 2.0;
    return moved(swollen_dome(count), over);
}

// A dome whose outline is an egg, pointed along x.
Mesh egg_dome(Index count) {
    Mesh dome = swollen_dome(count, 1.3);
    for (Vec3& p : dome.edit_positions()) p.y() *= 1.0 - 0.35 * p.x() / 1.3;
    return dome;
}

bool is_told_of_wrong_way(const MergeResult& result) {
    const std::vector<std::string>& warnings = result.report.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
        return warning.find("it may look the wrong way") != std::string::npos;
    });
}

MergeResult placed(const Mesh& source, const Mesh& target, const MergeOptions& options = {},
                   std::vector<KeyPair> keys = {}) {
    const Mesh* targets[] = {&target};
    Join join{boundaries(source).front(), boundaries(target).front(), 0, std::move(keys)};
    return Merger(source, targets, {std::move(join)}, options).solve();
}

double max_difference(const Mesh& a, const Mesh& b) {
    if (a.vertex_count() != b.vertex_count()) return kInfinity;
    double apart = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        apart = std::max(apart, (a.position(v) - b.position(v)).norm());
    }
    return apart / surface_radius(a);
}

}  // namespace

TEST_CASE("without keys a part is turned least from how it lies") {
    const Mesh dome = swollen_dome(40), bowl = swollen_bowl(56);
    for (const double angle : {0.0, 0.7, 2.0, -3.0}) {
        for (const double tilt : {0.0, 0.5, 2.0}) {
            // However the part was laid about the axis it stays; only its tilt is taken back.
            const Affine about = rotation(Vec3::UnitZ(), angle, Vec3::Zero());
            const Affine tilted = rotation(Vec3(1, 2, 0).normalized(), tilt, Vec3(3, 1, 4));
            const Mesh laid = moved(moved(dome, about), tilted);
            const JoinReport join = placed(laid, bowl).report.joins[0];
            CAPTURE(angle);
            CAPTURE(tilt);
            CHECK(join.placed == Placing::as_placed);
            CHECK(!join.guessed);
            CHECK(join.certainty == 1.0);
            CHECK((join.turn + tilt * Vec3(1, 2, 0).normalized()).norm() < 0.01);
        }
    }
}

TEST_CASE("a part that lies turned from how the shapes suggest is told of") {
    Affine under = rotation(Vec3::UnitX(), kPi, Vec3::Zero());
    under.linear *= 2.0;
    const Mesh bowl = moved(egg_dome(56), under), dome = egg_dome(40);
    for (const double degrees : {0.0, 40.0, -60.0}) {
        CAPTURE(degrees);
        const Affine about = rotation(Vec3::UnitZ(), degrees * kDegree, Vec3::Zero());
        CHECK(!is_told_of_wrong_way(placed(moved(dome, about), bowl)));
    }
    for (const double degrees : {120.0, 180.0, -140.0}) {
        CAPTURE(degrees);
        const Affine about = rotation(Vec3::UnitZ(), degrees * kDegree, Vec3::Zero());
        const MergeResult result = placed(moved(dome, about), bowl);
        CHECK(is_told_of_wrong_way(result));
        CHECK(result.report.joins[0].placed == Placing::as_placed);
    }
}

TEST_CASE("a part that lies beside its place comes onto it without a turn") {
    const Mesh dome = swollen_dome(40), bowl = swollen_bowl(40);
    const Mesh beside = moved(dome, translation(Vec3(9, -2, 5)));
    const MergeResult result = placed(beside, bowl);
    CHECK(result.report.joins[0].turn.norm() < 1e-9);
    CHECK(result.report.ok);
}

TEST_CASE("the key that a report names makes the same result") {
    const Mesh bowl = swollen_bowl(56);
    const Mesh laid =
        moved(swollen_dome(40), rotation(Vec3(1, 1, 3).normalized(), 0.8, Vec3::Zero()));
    MergeOptions shape;
    shape.place = Place::shape;
    for (const MergeOptions& options : {MergeOptions{}, shape}) {
        const MergeResult first = placed(laid, bowl, options);
        REQUIRE(first.report.joins[0].key);
        const MergeResult again = placed(laid, bowl, {}, {*first.report.joins[0].key});
        CHECK(again.report.joins[0].placed == Placing::keys);
        CHECK(max_difference(first.mesh, again.mesh) < 1e-9);
        CHECK((first.report.joins[0].turn - again.report.joins[0].turn).norm() < 1e-9);
    }
}

TEST_CASE("as placed is the same if both move together, and if the source moves and is scaled") {
    const Mesh bowl = swollen_bowl(56);
    const Mesh laid =
        moved(swollen_dome(40), rotation(Vec3(1, 1, 3).normalized(), 0.8, Vec3::Zero()));
    const Mesh first = placed(laid, bowl).mesh;
    Random random(3);
    for (const double scale : {0.02, 1.0, 40.0}) {
        const Affine together = similarity(random, scale);
        const Mesh both = placed(moved(laid, together), moved(bowl, together)).mesh;
        CHECK(max_difference(both, moved(first, together)) < 1e-9);
        const Affine away =
            translation(7.0 * random.direction()) * scaling(Vec3::Constant(scale), Vec3::Zero());
        CHECK(max_difference(placed(moved(laid, away), bowl).mesh, first) < 1e-9);
    }
}

TEST_CASE("placed by shape a part is the same under any similarity of the source") {
    // Nearly its own mirror image, so that the plane is sought.
    Mesh dome = swollen_dome(40);
    for (Vec3& p : dome.edit_positions()) p.y() += 0.06 * p.z() * std::sin(3.0 * p.x() + p.z());
    const Mesh bowl = swollen_bowl(56);
    MergeOptions options;
    options.place = Place::shape;
    const MergeResult first = placed(dome, bowl, options);
    CHECK(first.report.joins[0].placed == Placing::shape);
    CHECK(first.report.joins[0].guessed);
    Random random(11);
    for (const double scale : {0.02, 1.0, 40.0}) {
        const Mesh elsewhere = moved(dome, similarity(random, scale));
        CHECK(max_difference(placed(elsewhere, bowl, options).mesh, first.mesh) < 1e-9);
    }
}

TEST_CASE("round parts take any turn, which is said and no fault") {
    const auto dome = [](Index count, double swell) {
        return tube(count, 16, [=](double angle, double height) {
            const double r = (1.0 + swell * std::cos(angle) * height * (1.0 - height)) *
                             std::sqrt(1.0 - 0.9 * height * height);
            return Vec3(r * std::cos(angle), r * std::sin(angle), 1.6 * height);
        });
    };
    const auto at_plane = [](const Mesh& mesh) {
        const std::vector<Path> open = boundaries(mesh);
        return open[0].length(mesh) > open[1].length(mesh) ? open[0] : open[1];
    };
    MergeOptions options;
    options.place = Place::shape;
    for (const double swell : {0.0, 0.8}) {
        const Mesh source = dome(40, swell);
        const Mesh target = moved(dome(56, swell), rotation(Vec3::UnitX(), kPi, Vec3::Zero()));
        const Mesh* targets[] = {&target};
        Merger merge(source, targets, {Join{at_plane(source), at_plane(target)}}, options);
        const MergeReport report = merge.solve().report;
        CHECK(report.joins[0].any_turn == (swell == 0.0));
        if (swell == 0.0) CHECK(report.verdict.find("guess") == std::string::npos);
    }
}

TEST_CASE("several joins are placed by where their boundaries lie, and then turned least") {
    const auto open_tube = [](double low, double high, double radius) {
        return tube(32, 12, [=](double angle, double height) {
            return Vec3(radius * std::cos(angle), radius * std::sin(angle),
                        low + (high - low) * height);
        });
    };
    const Mesh between =
        moved(open_tube(0.0, 2.0, 1.0), rotation(Vec3::UnitZ(), 0.3, Vec3::Zero()));
    const Mesh below = open_tube(-3.0, -1.0, 1.0), above = open_tube(4.0, 6.0, 1.0);
    const auto facing = [](const Mesh& mesh, double z) {
        for (const Path& path : boundaries(mesh)) {
            if (std::abs(mesh.position(path.vertices()[0]).z() - z) < 0.1) return path;
        }
        return boundaries(mesh).front();
    };
    const Mesh* targets[] = {&below, &above};
    Merger merge(between, targets,
                 {Join{facing(between, 0.0), facing(below, -1.0), 0},
                  Join{facing(between, 2.0), facing(above, 4.0), 1}});
    for (const JoinReport& join : merge.solve().report.joins) {
        CHECK(join.placed == Placing::as_placed);
        CHECK(join.turn.norm() < 0.01);
    }
}

TEST_CASE("a thin outline that meets a round one is told before anything is solved") {
    const Mesh bowl = swollen_bowl(56);
    const Mesh* targets[] = {&bowl};
    const auto warnings = [&](double aspect) {
        const Mesh thin = swollen_dome(60, aspect);
        const Merger merge(thin, targets,
                           {Join{boundaries(thin).front(), boundaries(bowl).front()}});
        return merge.warnings();
    };
    CHECK(warnings(1.5).empty());
    const std::vector<std::string> told = warnings(6.0);
    REQUIRE(told.size() == 1);
    CHECK(told[0].find("6.0 : 1") != std::string::npos);
    CHECK(told[0].find("1.0 : 1") != std::string::npos);
    CHECK(told[0].find("lissom.paste") != std::string::npos);
    const MergeReport report = placed(swollen_dome(60, 6.0), bowl).report;
    CHECK(report.warnings.front() == told[0]);
}

TEST_CASE("a part that must be turned over is placed by its shape, and that is told") {
    const Mesh bowl = swollen_bowl(56);
    const Mesh over = moved(swollen_dome(40), rotation(Vec3::UnitX(), kPi, Vec3::Zero()));
    const MergeReport report = placed(over, bowl).report;
    CHECK(report.joins[0].placed == Placing::shape);
    REQUIRE(!report.warnings.empty());
    CHECK(report.warnings[0].find("turned over") != std::string::npos);
}

TEST_CASE("a source that stays is not placed by shape") {
    MergeOptions options;
    options.configuration = Configuration::fixed;
    options.place = Place::shape;
    CHECK_THROWS_AS(placed(swollen_dome(40), swollen_bowl(56), options), Error);
}
