// Parts that fit stay as they are.
#include "kernel/merge/fitting.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A prism over a polygon in the plane z = 0, along `axis`, with rings at `heights` from 0 on, that
// ends open or in a cap.
struct PrismShape {
    std::vector<Vec3> polygon;
    Vec3 axis = Vec3::UnitZ();
    std::vector<double> heights = {};
    bool closed = true, triangles = false;
};

Mesh prism(const PrismShape& shape) {
    const Index n = count_of(shape.polygon), rings = count_of(shape.heights);
    std::vector<Vec3> positions;
    for (const double h : shape.heights) {
        for (const Vec3& p : shape.polygon) positions.push_back(p + h * shape.axis);
    }
    const bool up = shape.heights.back() * shape.axis.z() > 0.0;
    FaceList faces;
    const auto add = [&](std::vector<Index> face) {
        if (!up) std::reverse(face.begin(), face.end());
        faces.add(face);
    };
    for (Index r = 0; r + 1 < rings; ++r) {
        for (Index k = 0; k < n; ++k) {
            const Index a = r * n + k, b = r * n + (k + 1) % n;
            if (shape.triangles) {
                add({a, b, b + n});
                add({a, b + n, a + n});
            } else {
                add({a, b, b + n, a + n});
            }
        }
    }
    if (shape.closed) {
        std::vector<Index> cap;
        for (Index k = 0; k < n; ++k) cap.push_back((rings - 1) * n + k);
        add(cap);
    }
    return {std::move(positions), std::move(faces)};
}

// A convex polygon with `count` corners, and `between` vertices more on each edge.
std::vector<Vec3> polygon(Index count, Index between, bool round, std::mt19937& random) {
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const double width = round ? 1.0 : 0.5 + any(random), start = round ? 0.0 : any(random);
    std::vector<Vec3> corners, all;
    for (Index k = 0; k < count; ++k) {
        const double shake = round ? 0.0 : 0.6 * (any(random) - 0.5);
        const double angle = 2.0 * kPi * (k + start + shake) / count;
        corners.push_back({width * std::cos(angle), std::sin(angle), 0.0});
    }
    for (Index k = 0; k < count; ++k) {
        for (Index i = 0; i <= between; ++i) {
            const double t = i / (between + 1.0);
            all.push_back((1.0 - t) * corners[k] + t * corners[(k + 1) % count]);
        }
    }
    return all;
}

std::vector<double> heights(Index rings, double height, std::mt19937& random) {
    std::uniform_real_distribution<double> any(0.3, 1.0);
    std::vector<double> steps{0.0};
    for (Index r = 0; r < rings; ++r) steps.push_back(steps.back() + any(random));
    for (double& h : steps) h *= height / steps[rings];
    return steps;
}

Path boundary_at(const Mesh& mesh, const Vec3& point) {
    for (const Path& path : boundaries(mesh)) {
        for (const Vec3& p : path.points(mesh)) {
            if ((p - point).norm() < 1e-9) return path;
        }
    }
    FAIL("no boundary there");
    return boundaries(mesh).front();
}

// How far vertices of both parts are from where they are to be: `places`, of the target and then of
// the source. Infinite if one is gone.
double max_move(const MergeResult& result, const std::vector<Vec3>& places) {
    std::vector<double> moved(places.size(), kInfinity);
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        for (const auto& source : result.provenance.vertices[v]) {
            if (!(source.weight >= 0.5)) continue;
            moved[source.element] = (result.mesh.position(v) - places[source.element]).norm();
        }
    }
    return *std::max_element(moved.begin(), moved.end());
}

std::vector<Vec3> places_of(const Mesh& target, const Mesh& source) {
    std::vector<Vec3> places(target.positions().begin(), target.positions().end());
    places.insert(places.end(), source.positions().begin(), source.positions().end());
    return places;
}

Affine any_similarity(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Affine result = rotation(Vec3(any(random), any(random), 1.0), 3.0 * any(random), Vec3::Zero());
    result.linear *= std::exp(2.0 * any(random));
    result.translation = 5.0 * Vec3(any(random), any(random), any(random));
    return result;
}

double total_volume(const Mesh& a, const Mesh& b) {
    return volume(a) + volume(b);
}

MergeOptions any_options(std::mt19937& random) {
    const auto one_of = [&](Index n) {
        return std::uniform_int_distribution<Index>(0, n - 1)(random);
    };
    MergeOptions options;
    options.smooth = one_of(2) * 3;
    options.collar = one_of(2) == 0;
    options.subdivide = one_of(2) == 0;
    options.seam = one_of(3) == 0   ? SeamKind::fair
                   : one_of(3) == 0 ? SeamKind::band
                                    : SeamKind::conform;
    options.auto_transition = one_of(3) == 0;
    if (!options.auto_transition && one_of(3) == 0) {
        options.source_transition = options.target_transition = 0.8;
    }
    return options;
}

std::string text_of(const MergeOptions& options) {
    return std::string(options.configuration == Configuration::free ? "free" : "fixed") +
           " smooth " + std::to_string(options.smooth) + " collar " +
           std::to_string(options.collar) + " subdivide " + std::to_string(options.subdivide) +
           " seam " + std::to_string(static_cast<int>(options.seam)) + " transition " +
           std::to_string(options.auto_transition) + " " +
           std::to_string(options.target_transition);
}

}  // namespace

TEST_CASE("parts that fit: every vertex stays, whatever the rings, ends and options") {
    std::mt19937 random(7);
    const auto one_of = [&](Index n) {
        return std::uniform_int_distribution<Index>(0, n - 1)(random);
    };
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int run = 0; run < 400; ++run) {
        const Index sides = 3 + one_of(22), between = one_of(3) == 0 ? 1 + one_of(2) : 0;
        PrismShape low{polygon(sides, between, one_of(2) == 0, random)};
        if (one_of(2) == 0) low.axis = Vec3(any(random), any(random), 1.0);
        PrismShape high = low;
        low.heights = heights(1 + one_of(10), -0.3 - 3.0 * std::abs(any(random)), random);
        high.heights = heights(1 + one_of(10), 0.3 + 3.0 * std::abs(any(random)), random);
        low.closed = one_of(2) == 0;
        high.closed = one_of(2) == 0;
        low.triangles = one_of(2) == 0;
        high.triangles = one_of(2) == 0;
        // The rims need not have the same vertices.
        if (one_of(4) == 0) {
            const std::vector<Vec3> all = high.polygon;
            high.polygon.clear();
            for (std::size_t k = 0; k < all.size(); ++k) {
                if (k % at(between + 1) == 0) high.polygon.push_back(all[k]);
            }
        }
        const Mesh target = prism(low), source = prism(high);
        MergeOptions options = any_options(random);
        const bool stays = one_of(2) == 0;
        options.configuration = stays ? Configuration::fixed : Configuration::free;
        Mesh given = source;
        if (!stays && one_of(2) == 0) transform(given, any_similarity(random));
        const Index corner =
            index_of(std::find(low.polygon.begin(), low.polygon.end(), high.polygon[0]) -
                     low.polygon.begin());
        const Mesh* targets[] = {&target};
        Join join{
            boundary_at(given, given.position(0)), boundary_at(target, low.polygon[0]), 0, {}};
        if (one_of(4) != 0 || !stays) join.keys = {{Index(0), corner}};
        INFO("run " << run << ": " << sides << " sides, " << between << " between, "
                    << text_of(options));
        const MergeResult result = Merger(given, targets, {join}, options).solve();
        CHECK(result.report.joins[0].fits);
        CHECK(max_move(result, places_of(target, source)) < 1e-9);
        // Rims whose vertices differ may leave narrow triangles.
        CHECK((between > 0 || result.report.ok));
        CHECK(result.report.seam.collar_added == 0);
        if (low.closed && high.closed) {
            CHECK(std::abs(volume(result.mesh) - total_volume(target, source)) < 1e-8);
        }
    }
}

namespace {

PrismShape square_prism(double height, Index rings = 1) {
    PrismShape shape{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}};
    for (Index r = 0; r <= rings; ++r) shape.heights.push_back(height * r / rings);
    return shape;
}

// A gable roof on the square, with its ridge along x.
Mesh roof(double height) {
    FaceList faces;
    faces.add({0, 1, 5, 4});
    faces.add({2, 3, 4, 5});
    faces.add({1, 2, 5});
    faces.add({3, 0, 4});
    return {{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 0, height}, {-1, 0, height}},
            std::move(faces)};
}

MergeResult joined(const Mesh& source, const Mesh& target, const MergeOptions& options,
                   std::vector<KeyPair> keys = {}) {
    const Mesh* targets[] = {&target};
    return Merger(
               source, targets,
               {Join{boundaries(source).front(), boundaries(target).front(), 0, std::move(keys)}},
               options)
        .solve();
}

// Whether an edge inside a mesh turns by more than 30 degrees at `v`.
bool has_crease(const Mesh& mesh, Index v) {
    for (const Index w : mesh.topology().neighbors(v)) {
        if (edge_dihedral(mesh, v, w) > 30.0 * kDegree) return true;
    }
    return false;
}

bool same_faces(const Mesh& a, const Mesh& b) {
    if (a.face_count() != b.face_count()) return false;
    for (Index f = 0; f < a.face_count(); ++f) {
        if (!std::ranges::equal(a.topology().face(f), b.topology().face(f))) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a lid on a box, a roof on a house: no corner moves, in either configuration") {
    const Mesh box = prism(square_prism(-2.0));
    for (const Configuration configuration : {Configuration::fixed, Configuration::free}) {
        for (const Mesh& lid : {prism(square_prism(0.1)), roof(0.6), roof(1.0), roof(2.0)}) {
            MergeOptions options;
            options.configuration = configuration;
            const MergeResult result = joined(lid, box, options);
            CHECK(result.report.joins[0].fits);
            CHECK(result.report.ok);
            CHECK(result.mesh.topology().is_closed());
            CHECK(max_move(result, places_of(box, lid)) < 1e-9);
        }
    }
}

TEST_CASE("smoothing moves no vertex with a crease of its own") {
    std::mt19937 random(3);
    for (int run = 0; run < 20; ++run) {
        PrismShape shape{polygon(5 + run % 6, 0, false, random)};
        shape.heights = heights(1 + run % 2, 1.5, random);
        const Mesh source = prism(shape), box = prism(square_prism(-1.0, 1 + run % 3));
        MergeOptions options;
        options.configuration = run % 2 == 0 ? Configuration::fixed : Configuration::free;
        options.collar = run % 3 == 0;
        const MergeResult result = joined(source, box, options);
        CHECK_FALSE(result.report.joins[0].fits);
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            for (const auto& from : result.provenance.vertices[v]) {
                // A collar blends vertices of its own from those that were.
                if (from.element >= box.vertex_count()) continue;
                if (from.weight < (options.collar ? 1.0 : 0.5)) continue;
                if (!has_crease(box, from.element)) continue;
                CHECK((result.mesh.position(v) - box.position(from.element)).norm() < 1e-12);
            }
        }
    }
}

namespace {

// A flat disc over a regular polygon, with rings of vertices inside and one in the middle.
Mesh disc(Index sides, Index rings) {
    std::vector<Vec3> positions;
    for (Index r = rings; r > 0; --r) {
        for (Index k = 0; k < sides; ++k) {
            const double angle = 2.0 * kPi * k / sides, radius = static_cast<double>(r) / rings;
            positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        }
    }
    const Index middle = sides * rings;
    positions.emplace_back(0.0, 0.0, 0.0);
    FaceList faces;
    for (Index k = 0; k < sides; ++k) {
        const Index next = (k + 1) % sides;
        for (Index r = 0; r + 1 < rings; ++r) {
            const Index a = r * sides;
            faces.add({a + k, a + next, a + sides + next, a + sides + k});
        }
        const Index last = sides * (rings - 1);
        faces.add({last + k, last + next, middle});
    }
    return {std::move(positions), std::move(faces)};
}

PrismShape round_tube(Index sides, double height, Index rings) {
    std::mt19937 random(1);
    PrismShape shape{polygon(sides, 0, true, random)};
    for (Index r = 0; r <= rings; ++r) shape.heights.push_back(height * r / rings);
    return shape;
}

}  // namespace

TEST_CASE("a flat lid with vertices inside fits the tube that it was laid on: all vertices stay") {
    for (const Index sides : {4, 8, 24}) {
        for (const Index rings : {1, 3}) {
            const Mesh tube = prism(round_tube(sides, -2.0, 4)), lid = disc(sides, rings);
            for (const Configuration configuration : {Configuration::fixed, Configuration::free}) {
                MergeOptions options;
                options.configuration = configuration;
                const MergeResult result = joined(lid, tube, options);
                CHECK(result.report.joins[0].fits);
                CHECK(result.report.ok);
                CHECK(max_move(result, places_of(tube, lid)) < 1e-9);
            }
        }
    }
}

TEST_CASE("fair seams and transitions move no vertex of the target with a crease of its own") {
    std::mt19937 random(5);
    for (int run = 0; run < 12; ++run) {
        PrismShape shape{polygon(5 + run % 6, 1, false, random)};
        shape.heights = heights(4, 2.0, random);
        const Mesh source = prism(shape), box = subdivide(prism(square_prism(-2.0, 2)));
        MergeOptions options;
        options.collar = false;
        if (run % 2 == 0) options.seam = SeamKind::fair;
        options.auto_transition = run % 2 == 1;
        const MergeResult result = joined(source, box, options);
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            for (const auto& from : result.provenance.vertices[v]) {
                if (from.element >= box.vertex_count() || from.weight < 1.0) continue;
                if (!has_crease(box, from.element)) continue;
                CHECK((result.mesh.position(v) - box.position(from.element)).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("a tube on a like tube stays a tube: fair seams and transitions do not make it bulge") {
    for (const Index sides : {24, 25, 32}) {
        const Mesh source = prism(round_tube(sides, 3.0, 12));
        const Mesh target = prism(round_tube(24, -3.0, 12));
        for (int how = 0; how < 3; ++how) {
            MergeOptions options;
            if (how == 1) options.seam = SeamKind::fair;
            options.auto_transition = how == 2;
            const MergeResult result =
                joined(source, target, options, {{Vec3(1, 0, 0), Vec3(1, 0, 0)}});
            double least = kInfinity, most = 0.0;
            for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
                const Vec3& p = result.mesh.position(v);
                if (std::abs(p.z()) > 1.5) continue;
                const double radius = std::hypot(p.x(), p.y());
                least = std::min(least, radius);
                most = std::max(most, radius);
            }
            CAPTURE(sides);
            CAPTURE(how);
            CHECK(most < 1.01);
            CHECK(least > 0.98);
        }
    }
}

TEST_CASE("a collar does not bite the edges of a box of one ring") {
    for (const Index sides : {6, 8, 12}) {
        const Mesh source = prism(round_tube(sides, 1.0, 1)), box = prism(square_prism(-1.5));
        MergeOptions options;
        const MergeResult collared = joined(source, box, options);
        options.collar = false;
        options.smooth = 0;
        const MergeResult plain = joined(source, box, options);
        CAPTURE(sides);
        CHECK(volume(collared.mesh) > 0.98 * volume(plain.mesh));
    }
}

TEST_CASE("of several joins the one that fits is left as it is") {
    std::mt19937 random(5);
    PrismShape shape{polygon(12, 0, true, random)};
    shape.closed = false;
    shape.heights = heights(12, 4.0, random);
    const Mesh source = prism(shape);
    shape.heights = heights(3, -2.0, random);
    const Mesh low = prism(shape);
    shape.heights = heights(4, 2.0, random);
    Mesh high = prism(shape);
    Affine place = rotation(Vec3(1, 0, 0), 0.3, Vec3::Zero());
    place.linear *= 1.4;
    place.translation = Vec3(0.4, 0.2, 4.5);
    transform(high, place);
    const Mesh* targets[] = {&low, &high};
    const Vec3 end = source.position(source.vertex_count() - 1);
    for (const bool blends : {false, true}) {
        MergeOptions options;
        options.configuration = Configuration::fixed;
        options.auto_transition = blends;
        if (!blends) options.seam = SeamKind::fair;
        const MergeResult result =
            Merger(source, targets,
                   {Join{boundary_at(source, source.position(0)), boundary_at(low, low.position(0)),
                         0},
                    Join{boundary_at(source, end), boundary_at(high, high.position(0)), 1}},
                   options)
                .solve();
        CHECK(result.report.joins[0].fits);
        CHECK_FALSE(result.report.joins[1].fits);
        for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
            for (const auto& from : result.provenance.vertices[v]) {
                if (from.element >= low.vertex_count() || from.weight < 0.5) continue;
                CHECK((result.mesh.position(v) - low.position(from.element)).norm() < 1e-9);
            }
        }
    }
}

TEST_CASE("a source that stays on the target's side is told, with vertices and what helps") {
    std::mt19937 random(9);
    PrismShape shape{polygon(9, 0, true, random)};
    shape.heights = {0.0, 1.0, 2.0};
    const Mesh source = prism(shape), target = prism(shape);
    MergeOptions options;
    options.configuration = Configuration::fixed;
    const MergeResult result = joined(source, target, options);
    CHECK(result.report.joins[0].same_side);
    CHECK_FALSE(result.report.ok);
    CHECK(result.report.verdict.find("same side") != std::string::npos);
    const auto told = [](const std::string& text) {
        return text.find("vertices 0, 1, 2") != std::string::npos &&
               text.find("turn the source round") != std::string::npos;
    };
    CHECK(std::any_of(result.report.warnings.begin(), result.report.warnings.end(), told));
    // If it may move it comes to the other side.
    const MergeResult free = joined(source, target, {}, {{Index(0), Index(0)}});
    CHECK(free.report.ok);
    CHECK_FALSE(free.report.joins[0].same_side);
    CHECK(volume(free.mesh) == doctest::Approx(2.0 * volume(target)));
}

TEST_CASE("a part that was cut off and moved comes back to the vertex") {
    std::mt19937 random(21);
    const Mesh ball = make_sphere({.segments = 12});
    for (const double height : {0.0, 0.13, 0.4}) {
        const Mesh target = cut(ball, CutPlane{{0, height, 0}, {0.2, -1, 0.1}}).kept.mesh;
        const Mesh part = cut(ball, CutPlane{{0, height, 0}, {-0.2, 1, -0.1}}).kept.mesh;
        Mesh given = part;
        transform(given, any_similarity(random));
        const Index key = boundaries(part).front().vertices().front();
        const MergeResult result = joined(given, target, {}, {{key, part.position(key)}});
        CHECK(result.report.joins[0].fits);
        CHECK(max_move(result, places_of(target, part)) < 1e-9);
    }
}

TEST_CASE("a key that turns parts against each other is kept, though they would fit") {
    std::mt19937 random(2);
    PrismShape shape{polygon(8, 0, false, random)};
    shape.heights = heights(6, -2.0, random);
    const Mesh target = prism(shape);
    shape.heights = heights(6, 2.0, random);
    const Mesh source = prism(shape);
    CHECK_FALSE(joined(source, target, {}, {{Index(0), Index(3)}}).report.joins[0].fits);
    CHECK(joined(source, target, {}, {{Index(3), Index(3)}}).report.joins[0].fits);
}

TEST_CASE("with keys a merge is the same under any similarity of the source, and moves with both") {
    std::mt19937 random(31);
    for (int run = 0; run < 6; ++run) {
        PrismShape low{polygon(11, 0, false, random)}, high{polygon(14, 0, false, random)};
        low.heights = heights(7, -3.0, random);
        high.heights = heights(9, 3.0, random);
        low.triangles = high.triangles = run % 2 == 0;
        const Mesh target = prism(low), source = prism(high);
        const std::vector<KeyPair> keys{{Index(0), Index(0)}};
        const MergeResult first = joined(source, target, {}, keys);
        CHECK_FALSE(first.report.joins[0].fits);
        const auto check = [&](const MergeResult& other, const Affine& way, double size) {
            REQUIRE(same_faces(other.mesh, first.mesh));
            double worst = 0.0;
            for (Index v = 0; v < first.mesh.vertex_count(); ++v) {
                worst =
                    std::max(worst, (other.mesh.position(v) - way(first.mesh.position(v))).norm());
            }
            CHECK(worst < 1e-9 * size);
        };
        const Affine way = any_similarity(random);
        Mesh elsewhere = source, with = target;
        transform(elsewhere, way);
        transform(with, way);
        check(joined(elsewhere, target, {}, keys), {}, 3.0);
        check(joined(elsewhere, with, {}, keys), way, 3.0 * std::cbrt(way.linear.determinant()));
    }
}
