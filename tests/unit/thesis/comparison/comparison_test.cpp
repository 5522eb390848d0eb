// The methods that the thesis compares its own with.

#include <Eigen/Geometry>
#include <numeric>
#include <random>
#include <string>

#include "kernel/core/error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/thesis/comparison/fields.h"
#include "kernel/thesis/comparison/methods.h"
#include "kernel/thesis/fidelity.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr DeformMethod kMethods[] = {DeformMethod::naive,      DeformMethod::rotation_estimate,
                                     DeformMethod::similarity, DeformMethod::geodesic,
                                     DeformMethod::harmonic,   DeformMethod::frames};
constexpr DeformMethod kExplicit[] = {DeformMethod::geodesic, DeformMethod::harmonic,
                                      DeformMethod::frames};
constexpr const char* kModels[] = {"lion.off", "fertility.off", "cad_block.off"};

DeformOptions options_of(DeformMethod method) {
    return compared_by(method);
}

Scene compared_bar() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

// Calls check(scene) for the bar and for every model that is there.
template <typename Check>
void for_each_scene(const Check& check) {
    check(compared_bar());
    for (const std::string name : kModels) {
        const auto path = data_file("models/" + name);
        if (!path) continue;
        CAPTURE(name);
        check(make_scene(load_mesh(*path)));
    }
}

// The same for each of the methods, prepared.
template <typename Methods, typename Check>
void for_each_edit(const Methods& methods, const Check& check) {
    for_each_scene([&](const Scene& scene) {
        for (const DeformMethod method : methods) {
            const std::string name(method_name(method));
            CAPTURE(name);
            Edit edit = make_edit(scene, options_of(method));
            check(scene, edit);
        }
    });
}

double max_turn(const std::vector<Mat3>& gradients) {
    double greatest = 0.0;
    for (const Mat3& m : gradients) {
        greatest = std::max(greatest, Eigen::AngleAxisd(nearest_rotation(m)).angle());
    }
    return greatest;
}

// Distance between the shape that all handles moved by `map` give, and the moved rest shape.
double miss(const Scene& scene, Edit& edit, const Affine& map) {
    edit.deformer.set_transform(edit.low, map);
    edit.deformer.set_transform(edit.high, map);
    return max_distance(edit.deformer.solve(), mapped(rest_positions_of(edit.deformer), map)) /
           scene.size;
}

}  // namespace

TEST_CASE("comparison: held vertices to the bit, finite, back to rest to the bit, one factoring") {
    for_each_edit(kMethods, [](const Scene& scene, Edit& edit) {
        Deformer& d = edit.deformer;
        CHECK(d.solve() == rest_positions_of(d));
        CHECK(stats_of(d).factorizations == 1);
        for (const double angle : {0.3, 0.9}) {
            const Affine move = bend(scene, d.handle(edit.high).center, angle);
            d.set_transform(edit.high, move);
            d.solve();
            bool held = true, finite = true;
            for (const Index v : scene.high) {
                held = held && d.positions()[v] == move(scene.mesh.position(v));
            }
            for (const Index v : scene.low) {
                held = held && d.positions()[v] == scene.mesh.position(v);
            }
            for (const Vec3& p : d.positions()) finite = finite && p.allFinite();
            CHECK(held);
            CHECK(finite);
            CHECK(max_distance(d.positions(), rest_positions_of(d)) < 5.0 * scene.size);
        }
        d.set_transform(edit.high, {});
        CHECK(d.solve() == rest_positions_of(d));
        CHECK(stats_of(d).factorizations == 1);
    });
}

TEST_CASE("comparison: a translation of all handles is exact") {
    for_each_edit(kMethods, [](const Scene& scene, Edit& edit) {
        CHECK(miss(scene, edit, translation(scene.size * Vec3(2.0, -3.0, 1.0))) < 1e-12);
    });
}

TEST_CASE("comparison: explicit methods are exact for a rotation of all handles, naive is not") {
    for_each_edit(kExplicit, [](const Scene& scene, Edit& edit) {
        CHECK(miss(scene, edit, rotation({1, 2, 3}, 2.5, scene.size * Vec3(5, 0, 0))) < 1e-9);
    });
    const Scene scene = compared_bar();
    Edit naive = make_edit(scene, options_of(DeformMethod::naive));
    CHECK(miss(scene, naive, rotation({1, 2, 3}, 1.0, Vec3::Zero())) > 0.05);
}

TEST_CASE("comparison: propagated scales and shears are exact, as are similarity's scales") {
    const Scene scene = compared_bar();
    const Affine shear{(Mat3() << 1.0, 0.3, 0.0, 0.0, 1.2, 0.1, 0.0, 0.0, 0.7).finished(),
                       {1, 2, 3}};
    for (const DeformMethod method : {DeformMethod::geodesic, DeformMethod::harmonic}) {
        Edit edit = make_edit(scene, options_of(method));
        CHECK(miss(scene, edit, shear) < 1e-9);
    }
    Edit similarity = make_edit(scene, options_of(DeformMethod::similarity));
    CHECK(miss(scene, similarity, scaling(Vec3::Constant(1.8), {1, 1, 0})) < 1e-9);
}

TEST_CASE("comparison: similarity errs in the second order of the angle") {
    for_each_scene([](const Scene& scene) {
        Edit edit = make_edit(scene, options_of(DeformMethod::similarity));
        const double large = miss(scene, edit, rotation({1, 2, 3}, 0.1, Vec3::Zero()));
        const double small = miss(scene, edit, rotation({1, 2, 3}, 0.01, Vec3::Zero()));
        CHECK(large > 1e-8);
        CHECK(small < 0.015 * large);
    });
}

TEST_CASE(
    "comparison: translated handles turn nothing in explicit methods, but do in implicit ones") {
    for_each_scene([](const Scene& scene) {
        const auto turn = [&](DeformMethod method) {
            Edit edit = make_edit(scene, options_of(method));
            edit.deformer.set_transform(edit.high, translation(1.5 * scene.size * scene.across));
            edit.deformer.solve();
            return max_turn(gradients_of(edit.deformer));
        };
        CHECK(turn(DeformMethod::naive) == 0.0);
        for (const DeformMethod method : kExplicit) CHECK(turn(method) < 1e-12);
        for (const DeformMethod method :
             {DeformMethod::implicit, DeformMethod::rotation_estimate, DeformMethod::similarity}) {
            CHECK(turn(method) > 0.1);
        }
    });
}

TEST_CASE("comparison: preview gives what solve gives") {
    const Scene scene = compared_bar();
    for (const DeformMethod method : kMethods) {
        Edit edit = make_edit(scene, options_of(method));
        edit.deformer.set_transform(edit.high, bend(scene, edit.deformer.handle(edit.high).center));
        const std::vector<Vec3> preview = edit.deformer.solve(FrameQuality::preview);
        CHECK(edit.deformer.solve() == preview);
    }
}

TEST_CASE("comparison: a turned copy deforms alike where no rotation is linearised") {
    const Scene scene = compared_bar();
    const Affine map = rotation({0.3, -0.5, 0.9}, 2.1, {1.0, 2.0, 3.0});
    Scene other = scene;
    other.mesh = moved(scene.mesh, map);
    for (const DeformMethod method : kMethods) {
        Edit a = make_edit(scene, options_of(method)), b = make_edit(other, options_of(method));
        const Affine move = bend(scene, a.deformer.handle(a.high).center);
        a.deformer.set_transform(a.high, move);
        b.deformer.set_transform(b.high, conjugated(move, map));
        CHECK(max_distance(mapped(a.deformer.solve(), map), b.deformer.solve()) <
              1e-8 * scene.size);
    }
}

TEST_CASE("comparison: small and large copies deform alike") {
    const Scene scene = compared_bar();
    for (const double scale : {1e-7, 1e-3, 1e7}) {
        const Affine map{scale * Mat3::Identity(), Vec3::Zero()};
        Scene other = scene;
        other.mesh = moved(scene.mesh, map);
        for (const DeformMethod method : kMethods) {
            CAPTURE(scale);
            CAPTURE(method_name(method));
            Edit a = make_edit(scene, options_of(method)), b = make_edit(other, options_of(method));
            const Affine move = bend(scene, a.deformer.handle(a.high).center);
            a.deformer.set_transform(a.high, move);
            b.deformer.set_transform(b.high, conjugated(move, map));
            CHECK(max_distance(mapped(a.deformer.solve(), map), b.deformer.solve()) <
                  1e-7 * scale * scene.size);
        }
    }
}

TEST_CASE("comparison: handles that were removed, or hold no positions, hold nothing") {
    const Scene scene = compared_bar();
    for (const DeformMethod method : kMethods) {
        CAPTURE(method_name(method));
        Edit plain = make_edit(scene, options_of(method));
        Deformer d(scene.mesh, scene.all(), options_of(method));
        const HandleId gone = d.add_handle(scene.region({scene.between(0)}));
        d.add_handle(scene.region(scene.low));
        const HandleId high = d.add_handle(scene.region(scene.high));
        d.remove_handle(gone);
        const Affine move = bend(scene, d.handle(high).center);
        d.set_transform(high, move);
        plain.deformer.set_transform(plain.high, move);
        CHECK(d.solve() == plain.deformer.solve());
    }
    // Nothing but points has a position.
    for (const DeformMethod method : kExplicit) {
        CAPTURE(method_name(method));
        Deformer d(scene.mesh, scene.all(), options_of(method));
        const HandleId all = d.add_handle(scene.region(scene.low), {false, true});
        const Index v = scene.low[0];
        d.set_transform(all, rotation({1, 2, 3}, 0.7, Vec3::Zero()));
        d.constrain(VertexConstraint{scene.high[0], scene.mesh.position(scene.high[0]), {}});
        d.solve();
        CHECK(d.positions()[scene.high[0]] == scene.mesh.position(scene.high[0]));
        CHECK((gradients_of(d)[v] - rotation({1, 2, 3}, 0.7, Vec3::Zero()).linear).norm() < 1e-9);
    }
}

TEST_CASE("comparison: a flat strip that is pulled is drawn out evenly, whatever its triangles") {
    const Mesh quads = make_grid({.size = {3.0, 1.0}, .segments = {18, 6}});
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vec3> positions(quads.positions().begin(), quads.positions().end());
    for (Index v = 0; v < quads.vertex_count(); ++v) {
        if (quads.topology().is_boundary(v)) continue;
        positions[v] += 0.035 * Vec3(unit(random), 0.0, unit(random));
    }
    FaceList faces;
    for (Index f = 0; f < quads.face_count(); ++f) {
        const auto q = quads.topology().face(f);
        const std::size_t turn = unit(random) < 0.0 ? 0 : 1;
        faces.add({q[turn], q[turn + 1], q[turn + 2]});
        faces.add({q[turn], q[turn + 2], q[(turn + 3) % 4]});
    }
    Scene scene{Mesh(positions, faces), {}, {}, 3.0, {}};
    for (Index v = 0; v < quads.vertex_count(); ++v) {
        if (positions[v].x() < -1.499) scene.low.push_back(v);
        if (positions[v].x() > 1.499) scene.high.push_back(v);
    }
    for (const DeformMethod method : {DeformMethod::geodesic, DeformMethod::harmonic}) {
        Edit edit = make_edit(scene, options_of(method));
        const Vec3 pull(0.6, 0.3, -0.2);
        edit.deformer.set_transform(edit.high, translation(pull));
        const std::vector<Vec3>& x = edit.deformer.solve();
        for (Index v = 0; v < quads.vertex_count(); ++v) {
            const Vec3 expected = positions[v] + (positions[v].x() + 1.5) / 3.0 * pull;
            CHECK((x[v] - expected).norm() < 1e-9);
        }
    }
}

TEST_CASE("comparison: only the region moves, and what surrounds it holds it") {
    const Scene scene = compared_bar();
    const Box box = bounds(scene.mesh);
    std::vector<Index> inner;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (scene.mesh.position(v).y() > 0.6 * box.min.y()) inner.push_back(v);
    }
    for (const DeformMethod method : kMethods) {
        Mesh mesh = scene.mesh;
        Deformer d(mesh, scene.region(inner), options_of(method));
        const HandleId high = d.add_handle(scene.region(scene.high));
        d.set_transform(high, bend(scene, d.handle(high).center));
        d.solve();
        d.apply_to(mesh);
        bool still = true;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const bool inside = std::binary_search(inner.begin(), inner.end(), v);
            still = still && (inside || mesh.position(v) == scene.mesh.position(v));
        }
        CHECK(still);
    }
}

TEST_CASE("comparison: gradients of handles are propagated without their positions") {
    const Scene scene = compared_bar();
    for (const DeformMethod method : kExplicit) {
        Deformer d(scene.mesh, scene.all(), options_of(method));
        d.add_handle(scene.region(scene.low));
        const HandleId high = d.add_handle(scene.region(scene.high), {false, true});
        const Affine turn = rotation(scene.across, 0.8, d.handle(high).center);
        d.set_transform(high, turn);
        d.solve();
        // The far end is free, and turned as asked.
        const Vec3 edge = scene.mesh.position(scene.high[0]) - scene.mesh.position(scene.high[1]);
        const Vec3 now = d.positions()[scene.high[0]] - d.positions()[scene.high[1]];
        CHECK((now - turn.linear * edge).norm() < 0.05 * edge.norm());
    }
}

TEST_CASE("comparison: a part without a gradient is named where gradients are propagated") {
    const Scene scene = compared_bar();
    for (const DeformMethod method : kMethods) {
        Edit edit = make_edit(scene, options_of(method), {true, false});
        edit.deformer.set_transform(edit.high, translation(0.1 * scene.across));
        const bool propagates =
            std::find(std::begin(kExplicit), std::end(kExplicit), method) != std::end(kExplicit);
        if (propagates) {
            CHECK(error_of([&] { edit.deformer.solve(); }).code() == ErrorCode::unconstrained);
        } else {
            CHECK_NOTHROW(edit.deformer.solve());
        }
    }
}

TEST_CASE("comparison: constrained vertices count as sources of their own") {
    const Scene scene = compared_bar();
    Edit edit = make_edit(scene, options_of(DeformMethod::harmonic));
    const Index v = scene.mesh.vertex_count() / 2;
    const Mat3 turn = rotation(Vec3::UnitY(), 0.5, Vec3::Zero()).linear;
    edit.deformer.constrain(VertexConstraint{v, scene.mesh.position(v) + Vec3(0.1, 0, 0), turn});
    edit.deformer.solve();
    CHECK(edit.deformer.positions()[v] == scene.mesh.position(v) + Vec3(0.1, 0, 0));
    CHECK((gradients_of(edit.deformer)[v] - turn).norm() < 1e-12);
    edit.deformer.constrain(VertexConstraint{v, {}, {}});
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
}

TEST_CASE("comparison: options without a use and the handle basis are refused") {
    const Scene scene = compared_bar();
    const auto refused = [&](DeformOptions options) {
        return error_of([&] { Deformer d(scene.mesh, scene.all(), options); }).code();
    };
    for (const DeformMethod method : kMethods) {
        DeformOptions options = thesis_deform_options();
        options.method = method;
        options.comparison = make_comparison;
        CHECK(refused(options) == ErrorCode::invalid_argument);
        options = options_of(method);
        options.local_size = LocalSize::scale;
        CHECK(refused(options) == ErrorCode::invalid_argument);
        Edit edit = make_edit(scene, options_of(method));
        CHECK(error_of([&] { basis_of(edit.deformer); }).code() == ErrorCode::unsupported);
    }
}

TEST_CASE("comparison: distances by fast marching are exact for a flat front and right around") {
    GridOptions options;
    options.segments = {24, 24};
    const Mesh mesh = make_grid(options);
    const Region all = Region::all(mesh.shared_topology());
    const Patch patch = build_patch(mesh, all, 1);
    const Rings rings = build_rings(patch.real_count, patch.triangles);
    std::vector<Index> source(static_cast<std::size_t>(rings.size()), kNoIndex);
    for (Index v = 0; v < rings.size(); ++v) {
        if (mesh.position(v).x() < -0.499) source[v] = 0;
    }
    const std::vector<double> flat = patch_distances(patch, rings, source, 0);
    double worst = 0.0;
    for (Index v = 0; v < rings.size(); ++v) {
        worst = std::max(worst, std::abs(flat[v] - (mesh.position(v).x() + 0.5)));
    }
    CHECK(worst < 1e-12);
    std::fill(source.begin(), source.end(), kNoIndex);
    source[0] = 0;
    const std::vector<double> round = patch_distances(patch, rings, source, 0);
    worst = 0.0;
    for (Index v = 0; v < rings.size(); ++v) {
        worst = std::max(worst, std::abs(round[v] - (mesh.position(v) - mesh.position(0)).norm()));
    }
    CHECK(worst < 0.05);
}

TEST_CASE("comparison: soft handles and points in faces are refused") {
    const Scene scene = compared_bar();
    for (const DeformMethod method : kMethods) {
        Edit edit = make_edit(scene, options_of(method));
        PointConstraint point;
        const auto face = scene.mesh.topology().face(scene.mesh.face_count() / 2);
        point.point = {{face[0], face[1]}, {0.5, 0.5}};
        point.position = Vec3::Zero();
        edit.deformer.constrain(point);
        CHECK(error_of([&] { edit.deformer.solve(); }).code() == ErrorCode::unsupported);
    }
}

TEST_CASE("comparison: a rotation beyond pi is propagated as it was asked for") {
    const Scene scene = compared_bar();
    const double angle = 1.5 * kPi;
    for (const DeformMethod method : {DeformMethod::geodesic, DeformMethod::harmonic}) {
        Edit edit = make_edit(scene, options_of(method));
        edit.deformer.set_transform(edit.high, rotation(Vec3::UnitY(), angle, Vec3::Zero()),
                                    Vec3::Zero(), angle * Vec3::UnitY());
        edit.deformer.solve();
        // Half way up the bar has turned half way, not back by a quarter of pi.
        const Mat3 half = rotation(Vec3::UnitY(), 0.5 * angle, Vec3::Zero()).linear;
        double worst = 0.0;
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            const Vec3& p = scene.mesh.position(v);
            if (std::abs(p.y()) > 1e-6) continue;
            worst = std::max(worst, (gradients_of(edit.deformer)[v] - half).norm());
            worst = std::max(worst, (edit.deformer.positions()[v] - half * p).norm() / scene.size);
        }
        CHECK(worst < 0.2);
    }
}
