// The properties of deformation on scanned, modelled and CAD surfaces.

#include <string>

#include "kernel/io/mesh_file.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr const char* kModels[] = {"armadillo_43k.obj", "lion.off",     "cactus_cinolib.off",
                                   "dinosaur.obj",      "pegasus.obj",  "fertility.off",
                                   "bar_botsch.off",    "cad_block.off"};

// Calls check(scene, name) for every model that is there.
template <typename Check>
void for_each_model(const Check& check) {
    for (const std::string name : kModels) {
        const auto path = data_file("models/" + name);
        if (!path) continue;
        CAPTURE(name);
        check(make_scene(load_mesh(*path)));
    }
}

double tolerance(const Deformer& deformer) {
    return deformer.stats().displaced_vertices > 0 ? 1e-6 : 1e-9;
}

}  // namespace

TEST_CASE(
    "real meshes: hard handles, basis as the direct solve, finite, and back to rest to the bit") {
    for_each_model([](const Scene& scene) {
        Edit edit = make_edit(scene);
        Deformer& d = edit.deformer;
        const Affine move = bend(scene, d.handle_center(edit.high));
        d.set_transform(edit.high, move);
        CHECK(greatest_distance(d.preview(), d.solve_first_directly()) < 1e-11 * scene.size);
        d.solve();
        for (const Index v : scene.high) CHECK(d.positions()[v] == move(scene.mesh.position(v)));
        for (const Index v : scene.low) CHECK(d.positions()[v] == scene.mesh.position(v));
        bool finite = true;
        for (const Vec3& p : d.positions()) finite = finite && p.allFinite();
        CHECK(finite);
        CHECK(greatest_distance(d.positions(), d.rest_positions()) < 10.0 * scene.size);
        d.set_transform(edit.high, conjugated({}, move));
        CHECK(d.solve() == d.rest_positions());
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
        CHECK(
            greatest_distance(edit.deformer.solve(), mapped(edit.deformer.rest_positions(), map)) <
            tolerance(edit.deformer) * scene.size);
    });
}

TEST_CASE("real meshes: turned, moved and scaled copies deform alike") {
    for_each_model([](const Scene& scene) {
        Affine map = rotation({0.3, -0.5, 0.9}, 2.1, scene.size * Vec3(1.0, 2.0, 3.0));
        map.linear *= 40.0;
        Scene other = scene;
        other.mesh = mapped(scene.mesh, map);
        Edit a = make_edit(scene), b = make_edit(other);
        const Affine move = bend(scene, a.deformer.handle_center(a.high));
        a.deformer.set_transform(a.high, move);
        b.deformer.set_transform(b.high, conjugated(move, map));
        const double error =
            greatest_distance(mapped(a.deformer.solve(), map), b.deformer.solve()) /
            (40.0 * scene.size);
        CHECK(error < tolerance(a.deformer));
    });
}

TEST_CASE("real meshes: every formulation gives a finite shape near the default one") {
    for_each_model([](const Scene& scene) {
        if (scene.mesh.vertex_count() > 12000) return;
        Edit reference = make_edit(scene);
        const Affine move = bend(scene, reference.deformer.handle_center(reference.high), 0.4);
        reference.deformer.set_transform(reference.high, move);
        std::vector<DeformOptions> list(4);
        list[0].second = SecondSystem::laplacian;
        list[1].second = SecondSystem::poisson;
        list[2].coherence = 2;
        list[3] = DeformOptions::thesis();
        for (const DeformOptions& options : list) {
            Edit edit = make_edit(scene, options);
            edit.deformer.set_transform(edit.high, move);
            CHECK(greatest_distance(edit.deformer.solve(), reference.deformer.solve()) <
                  0.35 * scene.size);
        }
    });
}
