// The fast path against a slow one that is written straight from the equations. The program
// test_deform_portable runs the same tests on code for any processor.

#include "tests/unit/deform/reference.h"

#include "kernel/core/lanes.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/models.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/deform/thesis_options.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Errors of the fast path, in sizes: of the first system, of the second, and of a drag's frame.
// The first is that of a well-shaped mesh; nearly degenerate vertices cost the digits that their
// condition number has.
constexpr double kFirst = 1e-11, kSecond = 1e-9, kDraft = 1e-4;
constexpr double kNearlyDegenerate = 100.0;

std::vector<std::pair<std::string, DeformOptions>> reference_formulations() {
    std::vector<std::pair<std::string, DeformOptions>> list;
    const auto add = [&](const std::string& name, auto change) {
        DeformOptions options;
        change(options);
        list.emplace_back(name, options);
    };
    add("blend", [](DeformOptions&) {});
    add("laplacian", [](DeformOptions& o) { o.second = SecondSystem::laplacian; });
    add("poisson", [](DeformOptions& o) { o.second = SecondSystem::poisson; });
    add("scale", [](DeformOptions& o) { o.local_size = LocalSize::scale; });
    add("two rings", [](DeformOptions& o) { o.coherence = 2; });
    add("uniform", [](DeformOptions& o) { o.weights = LaplacianWeights::uniform; });
    add("coherence", [](DeformOptions& o) { o.coherence_weight = 7.0; });
    add("thesis", [](DeformOptions& o) { o = test::thesis_or_default(); });
    add("thesis, blend", [](DeformOptions& o) {
        o = test::thesis_or_default();
        o.second = SecondSystem::blend;
    });
    return list;
}

Scene reference_torus() {
    Mesh torus = make_torus({1.0, 0.4, 18, 9});
    for (Vec3& p : torus.edit_positions()) p += 0.1 * Vec3(p.y() * p.z(), p.x() * p.x(), p.y());
    triangulate(torus);
    return make_scene(torus);
}

// Rest positions with degenerate vertices displaced, as a deformer of the scene displaces them.
std::vector<Vec3> displaced_rest(const Scene& scene, const Vec3& start,
                                 const DeformOptions& options) {
    DeformOptions displaced = options;
    displaced.flat = FlatVertices::displaced;
    const WorkingPatch work(build_patch(scene.mesh, scene.all(), 1), displaced);
    const auto n = static_cast<std::size_t>(scene.mesh.vertex_count());
    KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 1)};
    for (const auto* handle : {&scene.low, &scene.high}) {
        for (const Index v : *handle) {
            known.position[v] = known.gradient[v] = 1;
            known.gradient_wanted[v] = 0;
        }
    }
    const GradientStencils g = make_gradients(work.patch, work.rings, work.geometry, known,
                                              start - work.patch.origin, options);
    return mapped(g.displaced_rest, translation(work.patch.origin));
}

void compare(const Scene& scene, const DeformOptions& options, double loss = 1.0) {
    Edit edit = make_edit(scene, options);
    Deformer& d = edit.deformer;
    const Affine high = bend(scene, d.handle(edit.high).center, 1.2);
    const Affine low = scaling({1.2, 0.9, 1.1}, d.handle(edit.low).center);
    d.set_transform(edit.high, high);
    d.set_transform(edit.low, low);
    std::map<Index, Affine> held;
    for (const Index v : scene.high) held[v] = high;
    for (const Index v : scene.low) held[v] = low;
    const Reference reference(scene.mesh, displaced_rest(scene, d.handle(edit.low).center, options),
                              held, options);
    const std::vector<Vec3> displaced = reference.first();
    const std::vector<Vec3> first = reference.pulled_back(displaced);
    CHECK(max_distance(d.solve(FrameQuality::preview), first) < loss * kFirst * scene.size);
    CHECK(max_distance(solve_first_directly(d), first) < loss * kFirst * scene.size);
    const std::vector<Vec3> second = reference.second(displaced);
    CHECK(max_distance(d.solve(), second) < kSecond * scene.size);
    CHECK(max_distance(d.solve(FrameQuality::draft), second) < kDraft * scene.size);
    const std::vector<Mat3> expected = reference.gradients(displaced), got = gradients_of(d);
    double worst = 0.0;
    for (std::size_t v = 0; v < got.size(); ++v) {
        worst = std::max(worst, (got[v] - expected[v]).norm());
    }
    CHECK(worst < 1e-9);
}

}  // namespace

TEST_CASE("instruction set: the portable program runs no other code") {
#ifdef LISSOM_PORTABLE
    CHECK(!has_avx2());
#else
    MESSAGE("AVX2 used: " << has_avx2());
#endif
}

TEST_CASE("reference: every formulation is what the equations say") {
    const Scene scene = reference_torus();
    for (const auto& formulation : reference_formulations()) {
        CAPTURE(formulation.first);
        compare(scene, formulation.second);
    }
}

TEST_CASE("reference: with degenerate vertices, displaced and pulled back") {
    Mesh bar = make_bar({1.0, 3.0, 3, 9});
    triangulate(bar);
    const Scene scene = make_scene(bar);
    REQUIRE(max_distance(displaced_rest(scene, Vec3::Zero(), {}),
                         {bar.positions().begin(), bar.positions().end()}) > 0.01);
    for (auto formulation : reference_formulations()) {
        CAPTURE(formulation.first);
        formulation.second.flat = FlatVertices::displaced;
        compare(scene, formulation.second, kNearlyDegenerate);
    }
}

TEST_CASE("reference: real meshes") {
    for (const std::string name :
         {"decimated-knight.off", "torus_vcg.off", "kitten_lowres.obj", "arap_bar2.off"}) {
        CAPTURE(name);
        DeformOptions options;
        options.flat = FlatVertices::displaced;
        if (const Scene* scene = model_scene(name)) compare(*scene, options, kNearlyDegenerate);
    }
}

TEST_CASE("reference: the thesis's own result up to a right angle, and near it up to 120 degrees") {
    Mesh bar = make_bar({1.0, 5.0, 4, 18});
    triangulate(bar);
    Mesh egg = make_sphere({1.0, 5, SphereKind::triangles});
    for (Vec3& p : egg.edit_positions()) p.y() *= 2.5;
    for (const Scene& scene : {make_scene(bar), make_scene(egg)}) {
        DeformOptions options;
        options.flat = FlatVertices::displaced;
        Edit edit = make_edit(scene, options);
        Deformer& d = edit.deformer;
        const Vec3 low = d.handle(edit.low).center, high = d.handle(edit.high).center;
        const std::vector<Vec3> displaced_at_rest = displaced_rest(scene, low, {});
        for (const Vec3& axis : {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitX()), Vec3(1.0, 2.0, 0.5)}) {
            for (const double degrees : {45.0, 89.9, 105.0, 120.0}) {
                CAPTURE(axis);
                CAPTURE(degrees);
                const Affine move = rotation(axis, degrees * kPi / 180.0, 0.9 * high);
                std::map<Index, Affine> held;
                for (const Index v : scene.high) held[v] = move;
                for (const Index v : scene.low) held[v] = {};
                d.set_transform(edit.high, move);
                const Reference reference(scene.mesh, displaced_at_rest, held, {});
                const std::vector<Vec3> expected = reference.second(reference.first());
                // Beyond the right angle in shares of the length; a bend on the spot shears most.
                const bool bent = axis == Vec3(Vec3::UnitX());
                const double share = bent && degrees > 110.0 ? 0.025 : 0.01;
                const double error = max_distance(d.solve(), expected);
                CHECK(error < (degrees < 90.0 ? kNearlyDegenerate * kSecond * scene.size
                                              : share * (high - low).norm()));
            }
        }
    }
}

TEST_CASE("refinement: each step lowers the energy that it is about") {
    for_each_model([](const Scene& given) {
        Mesh mesh = given.mesh;
        triangulate(mesh);
        const Scene scene = make_scene(mesh);
        if (mesh.vertex_count() > 2200) return;
        for (const SecondSystem second :
             {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
            DeformOptions options;
            options.second = second;
            double before = 0.0;
            for (options.refine = 0; options.refine <= 2; ++options.refine) {
                Edit edit = make_edit(scene, options);
                const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
                edit.deformer.set_transform(edit.high, move);
                std::map<Index, Affine> held;
                for (const Index v : scene.high) held[v] = move;
                for (const Index v : scene.low) held[v] = {};
                const Reference reference(mesh, {mesh.positions().begin(), mesh.positions().end()},
                                          held, options);
                // Drafts are not taken back where they run through themselves.
                const double energy =
                    reference.refined_energy(edit.deformer.solve(FrameQuality::draft));
                if (options.refine > 0) CHECK(energy <= before * (1.0 + 1e-6));
                before = energy;
            }
        }
    });
}
