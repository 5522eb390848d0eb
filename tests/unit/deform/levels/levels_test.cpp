// Deformation on two levels: a thinned surface that all vertices follow.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/levels/thinned_surface.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene dense_bar(Index across = 24) {
    BarOptions options;
    options.length = 6.0;
    options.across = across;
    options.along = 6 * across;
    return make_scene(make_bar(options));
}

DeformOptions on_levels(Index vertices = 1'500) {
    DeformOptions options;
    options.level_vertices = vertices;
    return options;
}

Affine bend_of(const Scene& scene, const Edit& edit) {
    return bend(scene, edit.deformer.handle(edit.high).center);
}

double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
}

Mesh with_positions(const Mesh& mesh, const std::vector<Vec3>& positions) {
    Mesh moved = mesh;
    moved.set_positions(positions);
    return moved;
}

double mean_turn_of_normals(const Mesh& a, const Mesh& b) {
    const std::vector<Vec3> one = vertex_normals(a), other = vertex_normals(b);
    double sum = 0.0;
    for (std::size_t v = 0; v < one.size(); ++v) {
        sum += std::acos(std::clamp(one[v].dot(other[v]), -1.0, 1.0));
    }
    return sum / double(one.size());
}

// The positions that `fine` has been given at the places of the vertices of a coarser mesh.
std::vector<Vec3> at_vertices_of(const Mesh& coarse, const Mesh& fine,
                                 const std::vector<Vec3>& positions) {
    std::vector<Vec3> result;
    for (const Vec3& p : coarse.positions()) {
        Index nearest = 0;
        for (Index v = 0; v < fine.vertex_count(); ++v) {
            const double square = (fine.position(v) - p).squaredNorm();
            if (square < (fine.position(nearest) - p).squaredNorm()) nearest = v;
        }
        result.push_back(positions[at(nearest)]);
    }
    return result;
}

std::vector<Index> parts_of(const Mesh& mesh, double height) {
    std::vector<Index> part;
    for (const Vec3& p : mesh.positions()) part.push_back(p.y() < height ? 0 : 1);
    return part;
}

}  // namespace

TEST_CASE("levels: the thinned surface has the topology, and vertices of the whole one") {
    const Scene scene = dense_bar(16);
    Mesh mesh = scene.mesh;
    triangulate(mesh);
    const std::vector<Index> part = parts_of(mesh, 0.3);
    const ThinnedSurface thinned = thinned_surface(mesh, part, 600, {});
    CHECK(thinned.mesh.vertex_count() < 800);
    CHECK(thinned.mesh.topology().is_closed());
    CHECK(euler_characteristic(thinned.mesh.topology()) == euler_characteristic(mesh.topology()));
    for (Index v = 0; v < thinned.mesh.vertex_count(); ++v) {
        CHECK(thinned.mesh.position(v) == mesh.position(thinned.from[at(v)]));
    }
    std::vector<char> kept(at(mesh.vertex_count()), 0);
    for (const Index v : thinned.from) kept[at(v)] = 1;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(part[at(thinned.from[at(thinned.onto[at(v)])])] == part[at(v)]);
        const auto ring = mesh.topology().neighbors(v);
        const bool beside = std::any_of(ring.begin(), ring.end(),
                                        [&](Index n) { return part[at(n)] != part[at(v)]; });
        CHECK((!beside || kept[at(v)]));
    }
    CHECK(volume(thinned.mesh) == doctest::Approx(volume(mesh)).epsilon(0.02));
}

TEST_CASE("levels: handles hold their vertices, and the rest shape comes back to the bit") {
    const Scene scene = dense_bar();
    Edit edit = make_edit(scene, on_levels());
    const HandleId single = edit.deformer.add_handle(scene.region({scene.between(500)}));
    const Affine map = bend_of(scene, edit), lift = translation(Vec3(0.1, 0.2, 0.0));
    edit.deformer.set_transform(edit.high, map);
    edit.deformer.set_transform(single, lift);
    const std::vector<Vec3> x = edit.deformer.solve();
    CHECK(stats_of(edit.deformer).level_vertices > 1'000);
    for (const Index v : scene.low) CHECK(x[at(v)] == scene.mesh.position(v));
    for (const Index v : scene.high) {
        CHECK((x[at(v)] - map(scene.mesh.position(v))).norm() < 1e-12 * scene.size);
    }
    const Index v = scene.between(500);
    CHECK((x[at(v)] - lift(scene.mesh.position(v))).norm() < 1e-12 * scene.size);
    edit.deformer.set_transform(edit.high, {});
    edit.deformer.set_transform(single, {});
    CHECK(std::ranges::equal(edit.deformer.solve(), scene.mesh.positions()));
}

TEST_CASE("levels: a motion that all handles share is that of every vertex") {
    const Scene scene = dense_bar(16);
    Edit edit = make_edit(scene, on_levels(600));
    const Affine map = translation(Vec3(3.0, -2.0, 1.0)) *
                       rotation(Vec3(1.0, 2.0, 3.0).normalized(), 1.1, Vec3::Zero());
    edit.deformer.set_transform(edit.low, map);
    edit.deformer.set_transform(edit.high, map);
    const std::vector<Vec3> rest(scene.mesh.positions().begin(), scene.mesh.positions().end());
    CHECK(max_distance(edit.deformer.solve(), mapped(rest, map)) < 1e-9 * scene.size);
}

TEST_CASE("levels: the result is about as near that of the whole as a coarser mesh's, and smooth") {
    const Scene scene = dense_bar(), sparse = dense_bar(8);
    Edit alone = make_edit(sparse);
    alone.deformer.set_transform(alone.high, bend_of(scene, make_edit(scene)));
    const std::vector<Vec3> few = alone.deformer.solve();
    for (const FrameQuality quality : {FrameQuality::full, FrameQuality::draft}) {
        Edit whole = make_edit(scene), coarse = make_edit(scene, on_levels());
        whole.deformer.set_transform(whole.high, bend_of(scene, whole));
        coarse.deformer.set_transform(coarse.high, bend_of(scene, coarse));
        const std::vector<Vec3> a = whole.deformer.solve(quality);
        const std::vector<Vec3> b = coarse.deformer.solve(quality);
        const double of_sparse = rms_distance(few, at_vertices_of(sparse.mesh, scene.mesh, a));
        CHECK(of_sparse < 0.05 * scene.size);
        CHECK(rms_distance(a, b) < 2.0 * of_sparse);
        CHECK(mean_turn_of_normals(with_positions(scene.mesh, a), with_positions(scene.mesh, b)) <
              2.0 * kDegree);
    }
}

TEST_CASE("levels: details turn with the surface that they stand on") {
    Scene scene = dense_bar();
    const std::vector<Vec3> normals = vertex_normals(scene.mesh);
    std::vector<Vec3> bumpy;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double lift = 0.01 * scene.size * ((v * 7919) % 13) / 13.0;
        bumpy.push_back(scene.mesh.position(v) + lift * normals[at(v)]);
    }
    const Scene smooth = scene;
    scene.mesh.set_positions(bumpy);
    Edit plain = make_edit(smooth, on_levels()), detailed = make_edit(scene, on_levels());
    const Affine map = bend_of(smooth, plain);
    plain.deformer.set_transform(plain.high, map);
    detailed.deformer.set_transform(detailed.high, map);
    const std::vector<Vec3> a = plain.deformer.solve(), b = detailed.deformer.solve();
    const std::vector<Vec3> turned = vertex_normals(with_positions(smooth.mesh, a));
    double along = 0.0, lifted = 0.0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double lift = (bumpy[at(v)] - smooth.mesh.position(v)).norm();
        along += lift * (b[at(v)] - a[at(v)]).dot(turned[at(v)]);
        lifted += lift * lift;
    }
    CHECK(along / lifted == doctest::Approx(1.0).epsilon(0.15));
}

TEST_CASE("levels: what needs the whole surface gets it, with a warning") {
    const Scene scene = dense_bar(16);
    std::vector<std::string> warnings;
    ContextOptions services;
    services.log = [&](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning) warnings.emplace_back(text);
    };
    const Context context(services);
    HandleOptions soft;
    soft.weight = 10.0;
    const auto solved = [&](const DeformOptions& options) {
        Edit edit = make_edit(scene, options, soft);
        edit.deformer.set_transform(edit.high, bend_of(scene, edit));
        const std::vector<Vec3> x = edit.deformer.solve(FrameQuality::full, context);
        CHECK(stats_of(edit.deformer).level_vertices == 0);
        return x;
    };
    const std::vector<Vec3> direct = solved({});
    CHECK(warnings.empty());
    CHECK(solved(on_levels(600)) == direct);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("soft handles") != std::string::npos);
}

TEST_CASE("levels: regions that are small, or four times too small, are solved whole") {
    const Scene scene = dense_bar(8);
    const auto solved = [&](const DeformOptions& options) {
        Edit edit = make_edit(scene, options);
        edit.deformer.set_transform(edit.high, bend_of(scene, edit));
        return edit.deformer.solve();
    };
    CHECK(solved(on_levels(scene.mesh.vertex_count() / 3)) == solved({}));
    DeformOptions tiny;
    tiny.level_vertices = 10;
    CHECK(error_of([&] { make_edit(scene, tiny); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("levels: a part of a mesh of quads moves, and nothing beyond it") {
    Mesh mesh = make_sphere({.radius = 1.0, .segments = 96});
    std::vector<Index> upper, top;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).y() > -0.2) upper.push_back(v);
        if (mesh.position(v).y() > 0.9) top.push_back(v);
    }
    const Region region(mesh.shared_topology(), upper);
    Deformer deformer(mesh, region, on_levels(400));
    const HandleId handle = deformer.add_handle(Region(mesh.shared_topology(), top));
    deformer.translate(handle, Vec3(0.0, 0.4, 0.1));
    deformer.solve();
    CHECK(stats_of(deformer).level_vertices > 0);
    Mesh moved = mesh;
    deformer.apply_to(moved);
    std::vector<char> inside(at(mesh.vertex_count()), 0);
    for (const Index v : upper) inside[at(v)] = 1;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK((inside[at(v)] || moved.position(v) == mesh.position(v)));
    }
    CHECK(bounds(moved).max.y() == doctest::Approx(1.4));
    // Without a step at the outline of the region.
    CHECK(mean_turn_of_normals(mesh, moved) < 15.0 * kDegree);
}

TEST_CASE("levels: earlier states come back, and a handle more is another preparation") {
    const Scene scene = dense_bar(16);
    Edit edit = make_edit(scene, on_levels(600));
    edit.deformer.set_transform(edit.high, bend_of(scene, edit));
    const std::vector<Vec3> first = edit.deformer.solve();
    const DeformSnapshot before = edit.deformer.snapshot();
    const HandleId more = edit.deformer.add_handle(scene.region({scene.between(100)}));
    edit.deformer.translate(more, Vec3(0.5, 0.0, 0.0));
    CHECK(edit.deformer.solve() != first);
    edit.deformer.restore(before);
    CHECK(edit.deformer.positions() == first);
    CHECK(edit.deformer.solve() == first);
    CHECK(gradients_of(edit.deformer).size() == first.size());
}

TEST_CASE("levels: the volume is kept as on the whole surface") {
    const Scene scene = dense_bar();
    const auto volume_of = [&](double share) {
        DeformOptions options = on_levels();
        options.volume = share;
        Edit edit = make_edit(scene, options);
        edit.deformer.rotate(edit.high, Vec3::UnitY(), 150.0 * kDegree);
        return volume(with_positions(scene.mesh, edit.deformer.solve())) / volume(scene.mesh);
    };
    CHECK(volume_of(0.0) < 0.95);
    CHECK(volume_of(1.0) > 0.96);
}

TEST_CASE("levels: a cancel ends the preparation, which can be made again") {
    const Scene scene = dense_bar(16);
    Edit edit = make_edit(scene, on_levels(600));
    edit.deformer.set_transform(edit.high, bend_of(scene, edit));
    Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { edit.deformer.solve(FrameQuality::full, cancelled); }).code() ==
          ErrorCode::cancelled);
    CHECK(edit.deformer.solve().size() == at(scene.mesh.vertex_count()));
}

TEST_CASE("levels: their memory is charged for as long as the deformer lives") {
    const Scene scene = dense_bar(32);
    ContextOptions services;
    services.memory_limit = 1 << 30;
    const Context context(services);
    const std::size_t before = context.memory()->used();
    {
        Deformer deformer(scene.mesh, on_levels(300), context);
        deformer.add_handle(scene.region(scene.low));
        const std::size_t rest = context.memory()->used();
        deformer.prepare(context);
        REQUIRE(stats_of(deformer).level_vertices > 0);
        CHECK(context.memory()->used() - rest > 200 * at(scene.mesh.vertex_count()));
    }
    CHECK(context.memory()->used() == before);
}
