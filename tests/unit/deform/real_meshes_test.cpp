// The properties of deformation, each on the same fourteen scanned, modelled and CAD surfaces.

#include <random>
#include <string>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/stats.h"
#include "tests/unit/deform/models.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/deform/thesis_options.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

double tolerance(const Deformer& deformer) {
    return stats_of(deformer).displaced_vertices > 0 ? 1e-6 : 1e-9;
}

// What may differ between frames, in sizes.
double frame_tolerance(const Scene& scene, const Deformer& deformer) {
    return has_needles(scene) ? 0.15 : tolerance(deformer);
}

// The mesh with vertices numbered as `to` says and faces in reverse order, mirrored at x = 0 where
// asked for.
Scene rearranged(const Scene& scene, const std::vector<Index>& to, bool mirrored) {
    const Index n = scene.mesh.vertex_count();
    std::vector<Vec3> positions(static_cast<std::size_t>(n));
    for (Index v = 0; v < n; ++v) {
        positions[to[v]] = scene.mesh.position(v);
        if (mirrored) positions[to[v]].x() *= -1.0;
    }
    FaceList faces;
    for (Index f = scene.mesh.face_count(); f-- > 0;) {
        std::vector<Index> face;
        for (const Index v : scene.mesh.topology().face(f)) face.push_back(to[v]);
        if (mirrored) std::reverse(face.begin(), face.end());
        faces.add(face);
    }
    Scene other = scene;
    other.mesh = Mesh(positions, faces);
    for (std::vector<Index>* handle : {&other.low, &other.high}) {
        for (Index& v : *handle) v = to[v];
    }
    return other;
}

std::vector<Index> shuffled(Index n) {
    std::vector<Index> to(static_cast<std::size_t>(n));
    for (Index v = 0; v < n; ++v) to[v] = v;
    std::shuffle(to.begin(), to.end(), std::mt19937(5));
    return to;
}

}  // namespace

TEST_CASE("real meshes: identity, hard handles, basis as the direct solve, and back to rest") {
    for_each_model([](const Scene& scene) {
        Edit edit = make_edit(scene);
        Deformer& d = edit.deformer;
        CHECK(d.solve() == rest_positions_of(d));
        CHECK(d.solve(FrameQuality::preview) == rest_positions_of(d));
        const Affine move = bend(scene, d.handle(edit.high).center);
        d.set_transform(edit.high, move);
        CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
              1e-11 * scene.size);
        d.solve();
        bool held = true, finite = true;
        for (const Index v : scene.high) {
            held = held && d.positions()[v] == move(scene.mesh.position(v));
        }
        for (const Index v : scene.low) held = held && d.positions()[v] == scene.mesh.position(v);
        for (const Vec3& p : d.positions()) finite = finite && p.allFinite();
        CHECK(held);
        CHECK(finite);
        CHECK(max_distance(d.positions(), rest_positions_of(d)) < 10.0 * scene.size);
        const Vec3 center = d.handle(edit.high).center;
        d.set_transform(edit.high,
                        rotation({1, 2, 3}, 0.7, center) * rotation({1, 2, 3}, -0.7, center));
        CHECK(d.solve() == rest_positions_of(d));
        d.set_transform(edit.high, move);
        d.solve();
        d.reset();
        CHECK(d.positions() == rest_positions_of(d));
    });
}

TEST_CASE("real meshes: outside the region nothing moves, to the bit") {
    for_each_model([](const Scene& scene) {
        // The upper half; what lies below holds it.
        std::vector<Index> upper;
        const Box box = bounds(scene.mesh);
        Index axis = 0;
        (box.max - box.min).maxCoeff(&axis);
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            if (scene.mesh.position(v)[axis] > box.center()[axis]) upper.push_back(v);
        }
        Mesh mesh = scene.mesh;
        const Region region = scene.region(upper);
        Deformer d(mesh, region);
        const HandleId high = d.add_handle(scene.region(scene.high));
        d.set_transform(high, bend(scene, d.handle(high).center));
        d.solve();
        d.apply_to(mesh);
        Index moved = 0;
        bool still = true;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (mesh.position(v) == scene.mesh.position(v)) continue;
            still = still && region.contains(v);
            ++moved;
        }
        CHECK(still);
        CHECK(moved > region.size() / 2);
    });
}

TEST_CASE("real meshes: a similarity of all handles is reproduced") {
    for_each_model([](const Scene& scene) {
        DeformOptions options;
        options.local_size = LocalSize::scale;
        Edit edit = make_edit(scene, options);
        Affine map = rotation({1, 2, 3}, 2.0, {5, 0, 0});
        map.linear *= 1.7;
        edit.deformer.set_transform(edit.low, map);
        edit.deformer.set_transform(edit.high, map);
        CHECK(max_distance(edit.deformer.solve(), mapped(rest_positions_of(edit.deformer), map)) <
              tolerance(edit.deformer) * scene.size);
    });
}

TEST_CASE("real meshes: turned, moved and scaled copies deform alike") {
    for_each_model([](const Scene& scene) {
        Edit a = make_edit(scene);
        const Affine move = bend(scene, a.deformer.handle(a.high).center);
        a.deformer.set_transform(a.high, move);
        const std::vector<Vec3> expected = a.deformer.solve();
        for (const double scale : {1e-6, 1e6}) {
            CAPTURE(scale);
            Affine map = rotation({0.3, -0.5, 0.9}, 2.1, scene.size * Vec3(1.0, 2.0, 3.0));
            map.linear *= scale;
            map.translation *= scale;
            Scene other = scene;
            other.mesh = moved(scene.mesh, map);
            Edit b = make_edit(other);
            b.deformer.set_transform(b.high, conjugated(move, map));
            const double error =
                max_distance(mapped(expected, map), b.deformer.solve()) / (scale * scene.size);
            CHECK(error < frame_tolerance(scene, a.deformer));
        }
    });
}

TEST_CASE("real meshes: neither the order of vertices nor a mirror changes the shape") {
    for_each_model([](const Scene& scene) {
        if (scene.mesh.vertex_count() > 4000) return;
        const Index n = scene.mesh.vertex_count();
        Edit plain = make_edit(scene);
        const Affine move = bend(scene, plain.deformer.handle(plain.high).center);
        plain.deformer.set_transform(plain.high, move);
        const std::vector<Vec3> expected = plain.deformer.solve();
        const std::vector<Index> to = shuffled(n);
        for (const bool mirrored : {false, true}) {
            CAPTURE(mirrored);
            Affine mirror;
            if (mirrored) mirror.linear(0, 0) = -1.0;
            const Scene other = rearranged(scene, to, mirrored);
            Edit edit = make_edit(other);
            edit.deformer.set_transform(edit.high, conjugated(move, mirror));
            const std::vector<Vec3> x = mapped(edit.deformer.solve(), mirror);
            std::vector<Vec3> got;
            for (Index v = 0; v < n; ++v) got.push_back(x[to[v]]);
            CHECK(max_distance(got, expected) <
                  frame_tolerance(scene, plain.deformer) * scene.size);
        }
    });
}

TEST_CASE("real meshes: the same to the bit for 1, 2 and 4 threads") {
    for_each_model([](const Scene& scene) {
        DeformOptions refined;
        refined.refine = 1;
        std::vector<std::vector<Vec3>> previews, results, drafts;
        for (const int threads : {1, 2, 4}) {
            ContextOptions options;
            options.threads = threads;
            const Context context(options);
            Edit edit = make_edit(scene, refined);
            edit.deformer.set_transform(edit.high,
                                        bend(scene, edit.deformer.handle(edit.high).center));
            previews.push_back(edit.deformer.solve(FrameQuality::preview, context));
            drafts.push_back(edit.deformer.solve(FrameQuality::draft, context));
            results.push_back(edit.deformer.solve(FrameQuality::full, context));
        }
        for (const std::size_t other : {1U, 2U}) {
            CHECK(previews[0] == previews[other]);
            CHECK(drafts[0] == drafts[other]);
            CHECK(results[0] == results[other]);
        }
    });
}

TEST_CASE("real meshes: large ones, their handles hard, their basis as the direct solve") {
    for (const std::string name : {"armadillo_43k.obj", "pegasus.obj"}) {
        CAPTURE(name);
        const auto path = data_file("models/" + name);
        if (!path) continue;
        const Scene scene = make_scene(load_mesh(*path));
        ContextOptions options;
        options.threads = 2;
        const Context context(options);
        Edit edit = make_edit(scene);
        Deformer& d = edit.deformer;
        const Affine move = bend(scene, d.handle(edit.high).center);
        d.set_transform(edit.high, move);
        CHECK(max_distance(d.solve(FrameQuality::preview, context),
                           solve_first_directly(d, context)) < 1e-11 * scene.size);
        d.solve(FrameQuality::full, context);
        bool held = true, finite = true;
        for (const Index v : scene.high) {
            held = held && d.positions()[v] == move(scene.mesh.position(v));
        }
        for (const Vec3& p : d.positions()) finite = finite && p.allFinite();
        CHECK(held);
        CHECK(finite);
    }
}

TEST_CASE("real meshes: every formulation gives a finite shape near the default one") {
    for_each_model([](const Scene& scene) {
        if (scene.mesh.vertex_count() > 3000) return;
        Edit reference = make_edit(scene);
        const Affine move = bend(scene, reference.deformer.handle(reference.high).center, 0.4);
        reference.deformer.set_transform(reference.high, move);
        std::vector<DeformOptions> list(5);
        list[0].second = SecondSystem::laplacian;
        list[1].second = SecondSystem::poisson;
        list[2].coherence = 2;
        list[3].refine = 2;
        list[4] = test::thesis_or_default();
        for (const DeformOptions& options : list) {
            Edit edit = make_edit(scene, options);
            edit.deformer.set_transform(edit.high, move);
            CHECK(max_distance(edit.deformer.solve(), reference.deformer.solve()) <
                  0.35 * scene.size);
        }
    });
}
