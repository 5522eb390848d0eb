// What is flat stays flat as long as it is moved within its plane.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/deform/thesis_options.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

/// A strip of 4 by .4 in a plane through the origin with normal n, made of quads or of triangles.
struct Sheet {
    Scene scene;
    Vec3 normal;
    Affine placed;
};

Sheet sheet_of(bool triangles, const Vec3& tilt) {
    Mesh grid = make_grid({{4.0, 0.4}, {40, 4}});
    if (triangles) triangulate(grid);
    const Affine placed = rotation(Vec3(1.0, 2.0, 3.0).normalized(), tilt.norm(), Vec3::Zero());
    Vec3 normal = Vec3::UnitY();
    for (int d = 0; d < 3; ++d) {
        const auto flat = [&](const Vec3& p) { return std::abs(p[d]) < 1e-12; };
        const auto x = grid.positions();
        if (std::all_of(x.begin(), x.end(), flat)) normal = Vec3::Unit(d);
    }
    Scene scene = make_scene(grid, 0.06);
    scene.mesh = moved(grid, placed);
    return {std::move(scene), placed.linear * normal, placed};
}

double off_plane(const Sheet& sheet, const std::vector<Vec3>& x) {
    double most = 0.0;
    for (const Vec3& p : x) most = std::max(most, std::abs(sheet.normal.dot(p)));
    return most / sheet.scene.size;
}

enum class Solve { full, draft, preview };

std::vector<Vec3> bent(const Sheet& sheet, double degrees, const DeformOptions& options,
                       const HandleOptions& handle = {}, Solve solve = Solve::full) {
    Edit edit = make_edit(sheet.scene, options, handle);
    Deformer& d = edit.deformer;
    const Vec3 about = 0.5 * (d.handle(edit.low).center + d.handle(edit.high).center);
    d.set_transform(edit.high, rotation(sheet.normal, degrees * kPi / 180.0, about));
    if (solve == Solve::preview) return d.solve(FrameQuality::preview);
    return solve == Solve::draft ? d.solve(FrameQuality::draft) : d.solve();
}

// A draft has about five digits.
constexpr double kFlat = 1e-9, kDraftFlat = 1e-6;

}  // namespace

TEST_CASE("flat: a sheet bent in its own plane stays in it") {
    for (const bool triangles : {false, true}) {
        for (const Vec3& tilt : {Vec3(0.0, 0.0, 0.0), Vec3(0.7, 0.0, 0.0)}) {
            const Sheet sheet = sheet_of(triangles, tilt);
            for (const int refine : {0, 1, 2}) {
                for (const double degrees : {10.0, 45.0, 90.0, 120.0, 200.0}) {
                    CAPTURE(triangles);
                    CAPTURE(refine);
                    CAPTURE(degrees);
                    DeformOptions options;
                    options.refine = refine;
                    CHECK(off_plane(sheet, bent(sheet, degrees, options)) < kFlat);
                    CHECK(off_plane(sheet, bent(sheet, degrees, options, {}, Solve::draft)) <
                          kDraftFlat);
                    CHECK(off_plane(sheet, bent(sheet, degrees, options, {}, Solve::preview)) <
                          kFlat);
                }
            }
        }
    }
}

TEST_CASE("flat: whatever holds the sheet, and however it is solved") {
    const Sheet sheet = sheet_of(true, Vec3(0.3, 0.0, 0.0));
    const HandleOptions soft{true, true, 3.0, 0.0}, fading{true, true, {}, 0.5};
    for (const HandleOptions& handle : {HandleOptions{}, soft, fading}) {
        for (const SecondSystem second :
             {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
            for (const LaplacianWeights weights :
                 {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
                DeformOptions options;
                options.second = second;
                options.weights = weights;
                CHECK(off_plane(sheet, bent(sheet, 45.0, options, handle)) < kFlat);
                options.coherence = 2;
                options.local_size = LocalSize::scale;
                CHECK(off_plane(sheet, bent(sheet, 45.0, options, handle)) < kFlat);
            }
        }
    }
}

TEST_CASE("flat: only a part of the sheet moves, and vertices come and go") {
    const Sheet sheet = sheet_of(false, Vec3::Zero());
    const auto topology = sheet.scene.mesh.shared_topology();
    std::vector<Index> part, tip;
    for (Index v = 0; v < sheet.scene.mesh.vertex_count(); ++v) {
        const double x = sheet.scene.mesh.position(v).cwiseAbs().maxCoeff();
        if (sheet.scene.mesh.position(v).x() > -1.0) part.push_back(v);
        if (sheet.scene.mesh.position(v).x() > 1.7) tip.push_back(v);
        REQUIRE(x <= 2.0 + 1e-9);
    }
    Deformer d(sheet.scene.mesh, Region(topology, part));
    const HandleId handle = d.add_handle(Region(topology, tip));
    d.set_transform(handle, rotation(sheet.normal, 0.8, Vec3::Zero()));
    CHECK(off_plane(sheet, d.solve()) < kFlat);
    const std::vector<Vec3> before = d.solve();
    const Index middle = part[part.size() / 2];
    d.constrain(VertexConstraint{middle, rest_positions_of(d)[part.size() / 2], {}, {}});
    CHECK(off_plane(sheet, d.solve()) < kFlat);
    d.constrain(VertexConstraint{middle, {}, {}, {}});
    CHECK(max_distance(d.solve(), before) == 0.0);
    d.remove_handle(handle);
    const HandleId again = d.add_handle(Region(topology, tip));
    d.set_transform(again, rotation(sheet.normal, 0.8, Vec3::Zero()));
    CHECK(max_distance(d.solve(), before) == 0.0);
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * sheet.scene.size);
}

TEST_CASE("flat: the basis of handles is the preview") {
    const Sheet sheet = sheet_of(true, Vec3(0.3, 0.0, 0.0));
    Edit edit = make_edit(sheet.scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, rotation(sheet.normal, 0.5, d.handle(edit.low).center));
    const HandleBasis basis = basis_of(d);
    const std::vector<Vec3> x = d.solve(FrameQuality::preview);
    for (std::size_t row = 0; row < x.size(); ++row) {
        Vec3 sum = basis.fixed[row];
        for (std::size_t h = 0; h < basis.handles.size(); ++h) {
            const Affine& map = d.pose(basis.handles[h]).transform;
            const Vec4& w = basis.weights[h][row];
            sum += map.linear * w.head<3>() + map.translation * w[3];
        }
        CHECK((sum - x[row]).norm() < 1e-11 * sheet.scene.size);
    }
}

TEST_CASE("flat: similarities of the whole are exact, and the rest shape to the bit") {
    const Sheet sheet = sheet_of(false, Vec3(0.3, 0.0, 0.0));
    DeformOptions options;
    options.local_size = LocalSize::scale;
    Edit edit = make_edit(sheet.scene, options);
    Deformer& d = edit.deformer;
    CHECK(max_distance(d.solve(), rest_positions_of(d)) == 0.0);
    const Affine map = translation(Vec3(1.0, 2.0, 3.0)) *
                       rotation(Vec3::UnitX(), 1.0, Vec3::Zero()) *
                       scaling(Vec3::Constant(1.5), Vec3::Zero());
    for (const HandleId handle : d.handles()) d.set_transform(handle, map);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), map)) < 1e-9);
    CHECK(max_distance(d.solve(FrameQuality::preview), mapped(rest_positions_of(d), map)) < 1e-9);
    CHECK(stats_of(d).displaced_vertices == 0);
    CHECK(stats_of(d).extended_vertices > 0);
}

TEST_CASE("flat: the thesis displaces, and then the sheet leaves its plane") {
    const Sheet sheet = sheet_of(true, Vec3::Zero());
    DeformOptions displaced;
    displaced.flat = FlatVertices::displaced;
    CHECK(off_plane(sheet, bent(sheet, 90.0, displaced)) > 1e-3);
    if (!test::kHasThesis) return;
    CHECK(test::thesis_or_default().flat == FlatVertices::displaced);
    Edit edit = make_edit(sheet.scene, test::thesis_or_default());
    edit.deformer.prepare();
    CHECK(stats_of(edit.deformer).displaced_vertices > 0);
    CHECK(stats_of(edit.deformer).extended_vertices == 0);
}

TEST_CASE(
    "flat: its preparation has at most a third more entries than that of displaced vertices") {
    Mesh box = make_box({Vec3(2.0, 4.0, 2.0), {12, 24, 12}});
    for (const bool tilted : {false, true}) {
        CAPTURE(tilted);
        const Affine turn = rotation(Vec3(1.0, 2.0, 3.0).normalized(), 0.7, Vec3::Zero());
        for (const Mesh& mesh : {make_grid({{2.0, 2.0}, {40, 40}}), box}) {
            std::vector<std::size_t> entries;
            for (const FlatVertices flat : {FlatVertices::displaced, FlatVertices::extended}) {
                DeformOptions options;
                options.flat = flat;
                Scene scene = make_scene(mesh);
                if (tilted) scene.mesh = moved(mesh, turn);
                Edit edit = make_edit(scene, options);
                edit.deformer.prepare();
                entries.push_back(stats_of(edit.deformer).first_nonzeros);
            }
            CHECK(static_cast<double>(entries[1]) < 1.34 * static_cast<double>(entries[0]));
        }
    }
}
