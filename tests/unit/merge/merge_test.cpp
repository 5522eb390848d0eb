// What merges promise, on generated shapes.
#include "kernel/merge/merge.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/merge/thesis_parts.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/mesh/morph_support.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A tube with bumps, standing on the plane z = 0 with an open end there, closed at the top.
Mesh bumpy_dome(Index count, Index rings) {
    Mesh open = tube(count, rings, [](double angle, double height) {
        const double r = (1.0 + 0.08 * std::cos(3.0 * angle) * std::sin(5.0 * height)) *
                         std::sqrt(1.0 - 0.98 * height * height);
        return Vec3(r * std::cos(angle), 0.8 * r * std::sin(angle), 2.5 * height);
    });
    FaceList faces = open.topology().faces();
    std::vector<Index> top;
    for (Index k = 0; k < count; ++k) top.push_back((rings - 1) * count + k);
    faces.add(top);
    return Mesh({open.positions().begin(), open.positions().end()}, faces);
}

// The same upside down, twice as large, with its opening at the top.
Mesh bowl(Index count, Index rings) {
    Mesh mesh = bumpy_dome(count, rings);
    Affine over = rotation(Vec3::UnitX(), kPi, Vec3::Zero());
    over.linear *= 2.0;
    transform(mesh, over);
    return mesh;
}

// The same surface with vertices in a random order, and faces that begin elsewhere in the opposite.
Mesh renumbered(const Mesh& mesh, unsigned seed) {
    std::vector<Index> to(static_cast<std::size_t>(mesh.vertex_count()));
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), std::mt19937(seed));
    std::vector<Vec3> positions(to.size());
    for (Index v = 0; v < mesh.vertex_count(); ++v) positions[to[v]] = mesh.position(v);
    FaceList faces;
    for (Index f = mesh.face_count(); f-- > 0;) {
        std::vector<Index> face;
        for (const Index v : mesh.topology().face(f)) face.push_back(to[v]);
        std::rotate(face.begin(), face.begin() + 1, face.end());
        faces.add(face);
    }
    return Mesh(std::move(positions), std::move(faces));
}

Path opening(const Mesh& mesh) {
    return boundaries(mesh).front();
}

MergeResult merged(const Mesh& source, const Mesh& target, const MergeOptions& options = {},
                   std::vector<KeyPair> keys = {}) {
    const Mesh* targets[] = {&target};
    return Merger(source, targets, {Join{opening(source), opening(target), 0, std::move(keys)}},
                  options)
        .solve();
}

Region above(const Mesh& mesh, double height) {
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).z() > height) vertices.push_back(v);
    }
    return Region(mesh.shared_topology(), std::move(vertices));
}

// The vertex of the result that is nothing but a vertex of the source.
Index result_vertex(const MergeResult& result, Index target_count, Index v) {
    for (Index r = 0; r < result.mesh.vertex_count(); ++r) {
        const auto sources = result.provenance.vertices[r];
        if (sources.size() == 1 && sources.front().element == target_count + v) return r;
    }
    return kNoIndex;
}

// How far points are from the similarity image of others that fits them best.
double shape_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    const auto n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        from += a[i] / n;
        to += b[i] / n;
    }
    Mat3 products = Mat3::Zero();
    double squares_a = 0.0, squares_b = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        products += (b[i] - to) * (a[i] - from).transpose();
        squares_a += (a[i] - from).squaredNorm();
        squares_b += (b[i] - to).squaredNorm();
    }
    const double scale = std::sqrt(squares_b / squares_a);
    const Mat3 turn = nearest_rotation(products / std::sqrt(squares_a * squares_b));
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, (b[i] - to - scale * (turn * (a[i] - from))).norm());
    }
    return worst / std::sqrt(squares_b / n);
}

}  // namespace

TEST_CASE("a dome on a bowl: closed, the dome twice as large, the report says what happened") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    const MergeResult result = merged(source, target, {}, {{Vec3(1, 0, 0), Vec3(2, 0, 0)}});
    CHECK(result.mesh.topology().is_closed());
    CHECK(euler_characteristic(result.mesh.topology()) == 2);
    CHECK(volume(result.mesh) > 0.0);
    CHECK(result.report.joins[0].scale == doctest::Approx(2.0).epsilon(0.01));
    CHECK(!result.report.joins[0].guessed);
    CHECK(result.report.warnings.empty());
    CHECK(result.report.seam.after.max_dihedral < 0.3);
    CHECK(result.side_of_face.size() == static_cast<std::size_t>(result.mesh.face_count()));
    CHECK(result.seams.size() == 1);
    // The top of the dome comes to lie where the dome, twice as large, has it.
    CHECK(bounds(result.mesh).max.z() == doctest::Approx(5.0).epsilon(0.05));
}

TEST_CASE("provenance: every vertex is the mean it says, corners and faces are complete") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(57, 20);
    const MergeResult result = merged(source, target);
    const Index vertices = source.vertex_count() + target.vertex_count();
    const Index corners = source.topology().corner_count() + target.topology().corner_count();
    const Index faces = source.face_count() + target.face_count();
    const auto complete = [](const ElementMap& map, Index count, Index limit) {
        REQUIRE(map.size() == count);
        for (Index i = 0; i < count; ++i) {
            double sum = 0.0;
            for (const auto& [element, weight] : map[i]) {
                CHECK(element >= 0);
                CHECK(element < limit);
                sum += weight;
            }
            CHECK(sum == doctest::Approx(1.0));
        }
    };
    complete(result.provenance.vertices, result.mesh.vertex_count(), vertices);
    complete(result.provenance.corners, result.mesh.topology().corner_count(), corners);
    complete(result.provenance.faces, result.mesh.face_count(), faces);
    CHECK(result_vertex(result, target.vertex_count(), 500) != kNoIndex);
}

TEST_CASE("a fixed feature keeps its shape in the free configuration, and moves as a whole") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    // A boundary that is pressed flat, so that the dome bends.
    Mesh pressed = target;
    for (Vec3& p : pressed.edit_positions()) p.y() *= 0.6;
    const Region feature = above(source, 1.5);
    const auto positions_of = [&](const MergeResult& result) {
        std::vector<Vec3> positions;
        for (const Index v : feature.vertices()) {
            positions.push_back(
                result.mesh.position(result_vertex(result, target.vertex_count(), v)));
        }
        return positions;
    };
    std::vector<Vec3> rest;
    for (const Index v : feature.vertices()) rest.push_back(source.position(v));
    const std::vector<KeyPair> keys{{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    MergeOptions options;
    const double bent =
        shape_difference(rest, positions_of(merged(source, pressed, options, keys)));
    CHECK(bent > 1e-3);
    options.fixed = {feature};
    std::vector<std::vector<Vec3>> places;
    for (const ThesisFormulas* thesis :
         {static_cast<const ThesisFormulas*>(nullptr), test::thesis()}) {
        for (const FeatureMotion motion : {FeatureMotion::common, FeatureMotion::fitted}) {
            options.thesis = thesis;
            options.feature_motion = motion;
            const MergeResult kept = merged(source, pressed, options, keys);
            places.push_back(positions_of(kept));
            CHECK(shape_difference(rest, places.back()) < 1e-9);
            CHECK(kept.mesh.topology().is_closed());
        }
    }
    // Two ways, near each other.
    for (const std::size_t k : {0, 2}) {
        double apart = 0.0;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            apart = std::max(apart, (places[k][i] - places[k + 1][i]).norm());
        }
        CHECK(apart > 1e-6);
        CHECK(apart < 0.3);
    }
}

TEST_CASE("the fixed configuration leaves the source where it is, apart from its end") {
    Mesh source = bumpy_dome(40, 24);
    Affine place;
    place.linear = 2.1 * Mat3::Identity();
    place.translation = Vec3(0.3, 0.2, 0.4);
    transform(source, place);
    const Mesh target = bowl(50, 20);
    MergeOptions options;
    options.configuration = Configuration::fixed;
    SUBCASE("by features that stay") {
        options.fixed = {above(source, 2.5)};
    }
    SUBCASE("by a reach") {
        options.reach = 1.5;
    }
    SUBCASE("with frames that stay") {
        options.reach = 1.5;
        options.turn_frames = false;
    }
    const MergeResult result = merged(source, target, options, {{Vec3(2.4, 0, .4), Vec3(2, 0, 0)}});
    CHECK(result.mesh.topology().is_closed());
    for (const Index v : above(source, 2.5).vertices()) {
        const Index r = result_vertex(result, target.vertex_count(), v);
        CHECK(result.mesh.position(r) == source.position(v));
    }
    CHECK(result.report.deform.free_vertices < source.vertex_count() - 100);
}

TEST_CASE("full frames meet the target more smoothly than those that stay") {
    Mesh source = bumpy_dome(40, 24);
    const Affine tilted = rotation(Vec3::UnitX(), 0.6, Vec3::Zero());
    Affine place = tilted;
    place.linear *= 2.0;
    place.translation = Vec3(0, 0, 0.8);
    transform(source, place);
    const Mesh target = bowl(50, 20);
    MergeOptions options;
    options.configuration = Configuration::fixed;
    options.smooth = 0;
    options.reach = 2.0;
    const double full = merged(source, target, options, {{Vec3(2, 0, .8), Vec3(2, 0, 0)}})
                            .report.seam.after.rms_dihedral;
    options.turn_frames = false;
    const double kept = merged(source, target, options, {{Vec3(2, 0, .8), Vec3(2, 0, 0)}})
                            .report.seam.after.rms_dihedral;
    CHECK(full < 0.6 * kept);
}

TEST_CASE("parts of the source without a join go along with what is nearest to them") {
    Mesh source = bumpy_dome(40, 24);
    SphereOptions small;
    small.radius = 0.1;
    Mesh eye = make_sphere(small);
    Affine place;
    place.translation = Vec3(0.8, 0, 1.4);
    transform(eye, place);
    const Index first = source.vertex_count();
    append(source, eye);
    const Mesh target = bowl(50, 20);
    const MergeResult result = merged(source, target, {}, {{Vec3(1, 0, 0), Vec3(2, 0, 0)}});
    CHECK(result.mesh.topology().component_count() == 2);
    std::vector<Vec3> before, after;
    for (Index v = first; v < source.vertex_count(); ++v) {
        before.push_back(source.position(v));
        after.push_back(result.mesh.position(result_vertex(result, target.vertex_count(), v)));
    }
    CHECK(shape_difference(before, after) < 1e-9);
    CHECK((after[0] - after[1]).norm() / (before[0] - before[1]).norm() ==
          doctest::Approx(2.0).epsilon(0.01));
}

TEST_CASE("one source onto several targets: a cross of four tubes between four of other sizes") {
    // Two tubes through one another would cross; four arms of a plate with holes do not.
    const Mesh source = [] {
        Mesh mesh = round_tube(32, 24);
        return mesh;
    }();
    // The two ends of a tube on two others of different size that stand askew.
    Mesh low = round_tube(40, 8), high = round_tube(24, 8);
    Affine down = rotation(Vec3::UnitX(), kPi, Vec3::Zero());
    down.linear *= 3.0;
    transform(low, down);
    Affine up = rotation(Vec3(1, 1, 0), 0.4, Vec3::Zero());
    up.linear *= 0.7;
    up.translation = Vec3(1, 2, 9);
    transform(high, up);
    const auto facing = [](const Mesh& mesh, double z) {
        for (const Path& path : boundaries(mesh)) {
            Vec3 mean = Vec3::Zero();
            for (const Vec3& p : path.points(mesh)) mean += p / path.size();
            if (std::abs(mean.z() - z) < 0.5) return path;
        }
        FAIL("no boundary there");
        return boundaries(mesh).front();
    };
    const Mesh* targets[] = {&low, &high};
    Merger merge(source, targets,
                 {Join{facing(source, 0.0), facing(low, 0.0), 0},
                  Join{facing(source, 2.0), facing(high, 9.0), 1}});
    const MergeResult result = merge.solve();
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(result.mesh.topology().boundary_loops().size() == 2);
    CHECK(euler_characteristic(result.mesh.topology()) == 0);
    CHECK(result.report.joins[0].scale == doctest::Approx(3.0).epsilon(0.01));
    CHECK(result.report.joins[1].scale == doctest::Approx(0.7).epsilon(0.01));
    CHECK(result.report.intersections.empty());
    // Between the ends the size goes from one to the other.
    CHECK(result.mesh.vertex_count() > 32 * 20);
}

TEST_CASE("a moved key gives what a merge made with it gives") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    const Mesh* targets[] = {&target};
    const std::vector<KeyPair> first{{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    const std::vector<KeyPair> moved{{Vec3(1, 0, 0), Vec3(0, 1.6, 0)}};
    Merger merge(source, targets, {Join{opening(source), opening(target), 0, first}});
    const MergeResult before = merge.solve();
    merge.set_keys(0, moved);
    const MergeResult after = merge.solve();
    CHECK(hash(after.mesh) == hash(merged(source, target, {}, moved).mesh));
    CHECK(hash(after.mesh) != hash(before.mesh));
    merge.set_keys(0, first);
    CHECK(hash(merge.solve().mesh) == hash(before.mesh));
    CHECK_THROWS_AS(merge.set_keys(1, {}), Error);
}

TEST_CASE("a moved key on a trimmed side gives what a merge made with it gives, targets too") {
    Mesh source = bumpy_dome(40, 24);
    const Mesh target = bowl(50, 20);
    const std::vector<Index> rim = opening(source).vertices();
    const Vec3 inward = source.position(rim[0]) - source.position(rim[20]);
    const Vec3 axis =
        inward.cross(source.position(rim[10]) - source.position(rim[30])).normalized();
    for (std::size_t k = 0; k < rim.size(); k += 2) {
        source.set_position(rim[k], source.position(rim[k]) + 0.06 * axis);
    }
    test::add_telling_targets(source);
    const Mesh* targets[] = {&target};
    const std::vector<KeyPair> first{{rim[0], Vec3(2, 0, 0)}}, moved{{rim[0], Vec3(0, 1.6, 0)}};
    Merger merge(source, targets, {Join{opening(source), opening(target), 0, first}});
    CHECK(merge.solve().report.joins[0].source_trimmed);
    merge.set_keys(0, moved);
    const MergeResult after = merge.solve(), fresh = merged(source, target, {}, moved);
    REQUIRE(fresh.report.joins[0].source_trimmed);
    CHECK(hash(after.mesh) == hash(fresh.mesh));
    for (const int number : {1, 2, 3, 4}) {
        const std::vector<Vec3> a = test::target(after.mesh, number);
        const std::vector<Vec3> b = test::target(fresh.mesh, number);
        CHECK(a == b);
        CHECK(std::any_of(a.begin(), a.end(), [](const Vec3& d) { return d.norm() > 0.1; }));
    }
}

TEST_CASE("the number of threads changes nothing") {
    const Mesh source = bumpy_dome(60, 40), target = bowl(50, 20);
    const Mesh* targets[] = {&target};
    const auto hash_with = [&](int threads) {
        ContextOptions how;
        how.threads = threads;
        const Context context(how);
        MergeOptions options;
        options.source_transition = options.target_transition = 0.5;
        Merger merge(source, targets, {Join{opening(source), opening(target)}}, options, context);
        return hash(merge.solve(context).mesh);
    };
    CHECK(hash_with(1) == hash_with(2));
    CHECK(hash_with(1) == hash_with(5));
}

TEST_CASE("a jagged boundary is trimmed, keys on it still count, and the report says so") {
    const Mesh smooth = bumpy_dome(60, 40), target = bowl(50, 20);
    // Every other triangle of the first ring is gone.
    std::vector<char> drop(static_cast<std::size_t>(smooth.face_count()), 0);
    for (Index f = 0; f < 2 * 60; f += 4) drop[f] = 1;
    FaceList faces;
    for (Index f = 0; f < smooth.face_count(); ++f) {
        if (!drop[f]) faces.add(smooth.topology().face(f));
    }
    const Mesh source({smooth.positions().begin(), smooth.positions().end()}, faces);
    const Path boundary = opening(source);
    const KeyPair key{boundary.vertices()[3], Vec3(2, 0, 0)};
    const MergeResult result = merged(source, target, {}, {key});
    CHECK(result.report.joins[0].source_trimmed);
    CHECK(result.report.joins[0].source_turn > 0.35);
    CHECK(result.report.warnings.size() == 1);
    CHECK(result.mesh.topology().is_closed());
    MergeOptions options;
    options.trim = false;
    CHECK(!merged(source, target, options, {key}).report.joins[0].source_trimmed);
}

TEST_CASE("the thesis to the letter still gives one surface, whatever the unit") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    MergeOptions options;
    options.thesis = test::thesis();
    const MergeResult result = merged(source, target, options, {{Vec3(1, 0, 0), Vec3(2, 0, 0)}});
    CHECK(result.mesh.topology().is_closed());
    Mesh large = source;
    transform(large, scaling(Vec3::Constant(1000.0), Vec3::Zero()));
    const MergeResult same = merged(large, target, options, {{Vec3(1000, 0, 0), Vec3(2, 0, 0)}});
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        CHECK((result.mesh.position(v) - same.mesh.position(v)).norm() < 1e-7);
    }
}

TEST_CASE("section 3.3 to the letter: raw loops and a band, and nothing is mended") {
    if (!test::thesis()) return;
    // A jagged loop of few vertices on a dense dome, so that everything would like to be mended.
    Mesh source = bumpy_dome(24, 40);
    const Path boundary = opening(source);
    for (std::size_t k = 0; k < boundary.vertices().size(); k += 2) {
        Vec3 p = source.position(boundary.vertices()[k]);
        p.z() -= 0.12;
        source.set_position(boundary.vertices()[k], p);
    }
    const Mesh target = bowl(57, 20);
    const KeyPair key{boundary.vertices()[5], opening(target).vertices()[11]};
    MergeOptions options = test::thesis_or_default();
    options.smooth = 0;
    const MergeResult result = merged(source, target, options, {key});
    CHECK(result.report.seam.band_removed > 0);
    CHECK(result.report.seam.collar_added == 0);
    CHECK(result.report.seam.flipped == 0);
    CHECK(!result.report.joins[0].source_trimmed);
    CHECK(!result.report.joins[0].subdivided);
    CHECK(result.mesh.topology().is_closed());
    // The seam is the source's loop, each vertex where arc length has it on the target's.
    REQUIRE(result.seams[0].size() == boundary.vertices().size());
    const auto fractions = [](const Mesh& mesh, std::vector<Index> loop, Index first) {
        std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), first), loop.end());
        std::vector<double> at{0.0};
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Index next = loop[(k + 1) % loop.size()];
            at.push_back(at.back() + (mesh.position(next) - mesh.position(loop[k])).norm());
        }
        return std::pair(loop, at);
    };
    std::vector<Index> against(boundary.vertices().rbegin(), boundary.vertices().rend());
    const auto [from, s] = fractions(source, against, std::get<Index>(key.source));
    const auto [to, t] = fractions(target, opening(target).vertices(), std::get<Index>(key.target));
    for (std::size_t k = 0; k < from.size(); ++k) {
        const double u = s[k] / s.back() * t.back();
        std::size_t segment = 0;
        while (segment + 1 < to.size() && t[segment + 1] <= u + 1e-12) ++segment;
        const double part = (u - t[segment]) / (t[segment + 1] - t[segment]);
        const Vec3 place = (1.0 - part) * target.position(to[segment]) +
                           part * target.position(to[(segment + 1) % to.size()]);
        double nearest = 1e9;
        for (const Index v : result.seams[0]) {
            nearest = std::min(nearest, (result.mesh.position(v) - place).norm());
        }
        CHECK(nearest < 1e-9);
    }
    // Options that are given count.
    options.trim = options.collar = true;
    options.seam = SeamKind::conform;
    const MergeReport asked = merged(source, target, options, {key}).report;
    CHECK(asked.seam.band_removed == 0);
    CHECK(asked.joins[0].source_trimmed);
}

TEST_CASE("two coarse loops beside a dense source are split on both sides, and it lies firmer") {
    // Rings that thin out to six vertices at the open end.
    const auto dense_dome = [] {
        Mesh dome = bumpy_dome(96, 60);
        FaceList faces = dome.topology().faces();
        std::vector<Vec3> points(dome.positions().begin(), dome.positions().end());
        const Path rim = opening(dome);
        const auto n = count_of(rim.vertices());
        std::vector<Index> coarse;
        for (Index k = 0; k < 6; ++k) {
            coarse.push_back(count_of(points));
            points.push_back(points[rim.vertices()[k * n / 6]] - Vec3(0, 0, 0.3));
        }
        for (Index k = 0; k < n; ++k) {
            const Index a = rim.vertices()[k], b = rim.vertices()[(k + 1) % n];
            const Index at = (6 * k + n / 2) / n, next = (6 * (k + 1) + n / 2) / n;
            faces.add({b, a, coarse[at % 6]});
            if (next != at) faces.add({b, coarse[at % 6], coarse[next % 6]});
        }
        return Mesh(std::move(points), faces);
    };
    const Mesh source = dense_dome(), target = bowl(6, 20);
    Mesh shaken = target;
    const Index corner = opening(target).vertices()[2];
    shaken.set_position(corner, target.position(corner) + Vec3(0, 0, 0.2));
    const std::vector<KeyPair> keys{{Vec3(1, 0, -0.3), Vec3(2, 0, 0)}};
    const auto top = [&](const Mesh& below, const MergeOptions& options) {
        const MergeResult result = merged(source, below, options, keys);
        CHECK(result.mesh.topology().is_closed());
        CHECK(result.report.joins[0].subdivided == options.subdivide);
        CHECK(result.report.joins[0].target_subdivided == options.subdivide);
        if (options.subdivide) {
            CHECK(result.report.joins[0].source_size >= 24);
            CHECK(result.report.joins[0].target_size >= 24);
        }
        const Index highest = above(source, 2.45).vertices().front();
        return result.mesh.position(result_vertex(result, target.vertex_count(), highest));
    };
    MergeOptions options;
    const double refined = (top(shaken, options) - top(target, options)).norm();
    options.subdivide = false;
    const double plain = (top(shaken, options) - top(target, options)).norm();
    MESSAGE("the top moves by " << refined << ", and by " << plain << " without");
    CHECK(refined < 0.8 * plain);
}

TEST_CASE("placed by shape a merge is the same wherever its source lies") {
    // Round loops could meet anywhere, and nothing of the parts says where.
    const auto round_dome = [](Index count) {
        return tube(count, 20, [](double angle, double height) {
            const double r = std::sqrt(1.0 - 0.98 * height * height);
            return Vec3(r * std::cos(angle), r * std::sin(angle), 2.5 * height);
        });
    };
    const Mesh source = round_dome(40);
    Mesh target = round_dome(56);
    transform(target, rotation(Vec3::UnitX(), kPi, Vec3::Zero()));
    const auto low = [](const Mesh& mesh) {
        const std::vector<Path> paths = boundaries(mesh);
        const auto length = [&](const Path& path) { return path.length(mesh); };
        return length(paths[0]) > length(paths[1]) ? paths[0] : paths[1];
    };
    const Mesh* targets[] = {&target};
    MergeOptions options;
    options.place = Place::shape;
    const auto merged_from = [&](const Mesh& mesh) {
        return Merger(mesh, targets, {Join{low(mesh), low(target)}}, options).solve();
    };
    const MergeResult first = merged_from(source);
    // Any turn fits, which is said, and no fault.
    CHECK(first.report.joins[0].any_turn);
    REQUIRE(!first.report.warnings.empty());
    CHECK(first.report.warnings.back().find("any turn fits") != std::string::npos);
    Random random(8);
    for (int trial = 0; trial < 4; ++trial) {
        Mesh moved = source;
        transform(moved, similarity(random, trial % 2 == 0 ? 0.02 : 40.0));
        const MergeResult other = merged_from(moved);
        REQUIRE(other.mesh.vertex_count() == first.mesh.vertex_count());
        double apart = 0.0;
        for (Index v = 0; v < first.mesh.vertex_count(); ++v) {
            apart = std::max(apart, (other.mesh.position(v) - first.mesh.position(v)).norm());
        }
        CHECK(apart < 1e-8);
    }
}

TEST_CASE("a merge of the thesis does not depend on how vertices and faces are numbered") {
    if (!test::thesis()) return;
    const Mesh source = bumpy_dome(30, 16), target = bowl(36, 14);
    const std::vector<KeyPair> keys = {{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    // Flips at the seam go in the order of faces; the thesis has none.
    for (const Configuration configuration : {Configuration::free, Configuration::fixed}) {
        const MergeOptions options = test::thesis_or_default(configuration);
        const MergeResult first = merged(source, target, options, keys);
        for (const unsigned seed : {1u, 2u}) {
            const MergeResult other =
                merged(renumbered(source, seed), renumbered(target, seed + 7), options, keys);
            REQUIRE(other.mesh.vertex_count() == first.mesh.vertex_count());
            CHECK(other.mesh.face_count() == first.mesh.face_count());
            double worst = 0.0;
            for (const Vec3& p : first.mesh.positions()) {
                double nearest = kInfinity;
                for (const Vec3& q : other.mesh.positions()) {
                    nearest = std::min(nearest, (p - q).norm());
                }
                worst = std::max(worst, nearest);
            }
            CHECK(worst < 1e-7);
        }
    }
}

TEST_CASE("a transition wider than there is room is told, one that is chosen fits") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    const std::vector<KeyPair> keys{{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    MergeOptions options;
    options.source_transition = 0.5;
    options.target_transition = 1.0;
    CHECK(merged(source, target, options, keys).report.warnings.empty());
    options.source_transition = 100.0;
    const MergeReport wide = merged(source, target, options, keys).report;
    REQUIRE(wide.warnings.size() == 1);
    CHECK(wide.warnings[0].find("join 1: the transition on the source is ") == 0);
    CHECK(wide.warnings[0].find("in place of 200") != std::string::npos);
    CHECK(wide.transition.source[0].width < 20.0);

    options.source_transition = options.target_transition = 0.0;
    options.auto_transition = true;
    const MergeReport chosen = merged(source, target, options, keys).report;
    CHECK(chosen.warnings.empty());
    CHECK(chosen.transition.source[0].width > 1.0);
    CHECK(chosen.transition.target[0].width > 1.0);
    if (!test::thesis()) return;
    options.thesis = test::thesis();
    CHECK(error_of([&] { (void)merged(source, target, options, keys); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("keys are checked when they are set, and those of before stay") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    const Mesh* targets[] = {&target};
    const std::vector<KeyPair> keys{{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    Merger merge(source, targets, {Join{opening(source), opening(target), 0, keys}});
    const std::uint64_t before = hash(merge.solve().mesh);
    const Index inner = source.vertex_count() - 1;
    const Error off = error_of([&] { merge.set_keys(0, {{inner, Vec3(2, 0, 0)}}); });
    CHECK(off.code() == ErrorCode::key_conflict);
    CHECK(off.elements().ids == std::vector<Index>{inner});
    CHECK(error_of([&] {
              merge.set_keys(0, {{Vec3(9, 9, 9), Vec3(2, 0, 0)}});
          }).code() == ErrorCode::key_conflict);
    CHECK(hash(merge.solve().mesh) == before);
}

TEST_CASE("normals and morph targets of loose parts turn and grow with what they move along with") {
    Mesh source = bumpy_dome(40, 24);
    SphereOptions small;
    small.radius = 0.1;
    Mesh eye = make_sphere(small);
    for (Vec3& p : eye.edit_positions()) p += Vec3(0.8, 0, 1.4);
    const Index first = source.vertex_count();
    append(source, eye);
    for (const char* name : {"normal", "morph.1.position"}) {
        Attribute attribute;
        attribute.name = name;
        attribute.width = 3;
        for (Index v = 0; v < source.vertex_count(); ++v) {
            for (const double x : {0.0, 0.6, 0.8}) attribute.values.push_back(x);
        }
        source.attributes().add(attribute);
    }
    MergeOptions options;
    options.collar = false;
    const MergeResult result =
        merged(source, bowl(50, 20), options, {{Vec3(1, 0, 0), Vec3(0, 2, 0)}});
    const Attribute& normals = *result.mesh.attributes().find("normal");
    const Attribute& morphs = *result.mesh.attributes().find("morph.1.position");
    const Index shift = result.mesh.vertex_count() - source.vertex_count();
    // The similarity that took the eye along, by three of its vertices.
    const auto now = [&](Index v) { return result.mesh.position(v + shift); };
    Mat3 from, to;
    const Index spread = eye.vertex_count() / 4;
    for (int k = 0; k < 3; ++k) {
        const Index v = first + (k + 1) * spread + 3 * k;
        from.col(k) = source.position(v) - source.position(first);
        to.col(k) = now(v) - now(first);
    }
    const Mat3 turn = to * from.inverse();
    const double scale = std::cbrt(turn.determinant());
    CHECK(std::abs(turn(2, 1)) < scale);
    for (Index v = first; v < source.vertex_count(); ++v) {
        const auto n = normals.at(v + shift), m = morphs.at(v + shift);
        const Vec3 wanted = turn * Vec3(0.0, 0.6, 0.8);
        CHECK((Vec3(n[0], n[1], n[2]) - wanted / scale).norm() < 1e-6);
        CHECK((Vec3(m[0], m[1], m[2]) - wanted).norm() < 1e-6);
    }
}

TEST_CASE("loose parts that move along are told") {
    Mesh source = bumpy_dome(40, 24);
    SphereOptions small;
    small.radius = 0.1;
    Mesh eye = make_sphere(small);
    for (Vec3& p : eye.edit_positions()) p += Vec3(0.8, 0, 1.4);
    append(source, eye);
    for (Vec3& p : eye.edit_positions()) p.x() -= 1.6;
    append(source, eye);
    const Mesh target = bowl(50, 20);
    const MergeReport report = merged(source, target, {}, {{Vec3(1, 0, 0), Vec3(2, 0, 0)}}).report;
    CHECK(report.loose_parts == 2);
    // The eyes stick in the surface before and after; that is not new.
    CHECK(report.ok);
    REQUIRE(!report.warnings.empty());
    CAPTURE(report.warnings.back());
    CHECK(std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& told) {
        return told.find("2 parts of the source") == 0;
    }));
}

TEST_CASE("the report says in one line whether the seam is good") {
    const Mesh source = bumpy_dome(40, 24), target = bowl(50, 20);
    const std::vector<KeyPair> keys{{Vec3(1, 0, 0), Vec3(2, 0, 0)}};
    const MergeReport good = merged(source, target, {}, keys).report;
    CHECK(good.ok);
    CHECK(good.verdict.find("good: ") == 0);
    // Both in one line, and nothing is claimed that was not looked for.
    MergeOptions quick;
    quick.find_intersections = false;
    const MergeReport unsought = merged(source, target, quick, keys).report;
    CHECK(unsought.verdict.find("were not looked for") != std::string::npos);
    CHECK(unsought.verdict.find('\n') == std::string::npos);
}
