// Custom normals, tangents and morph targets follow the surface, whatever was asked in between.

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kToDegrees = 180.0 / kPi;

double angle_between(const Vec3& a, const Vec3& b) {
    return kToDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 stored(const Attribute& normals, Index element) {
    return Vec3(normals.at(element).data());
}

// Gives every vertex, or corner, a normal that is the surface's turned by `degrees`, each about
// another axis.
void add_normals(Mesh& mesh, Domain domain, double degrees) {
    const std::vector<Vec3> surface = vertex_normals(mesh);
    Attribute normals{"normal", domain, 3, ScalarType::float32, {}};
    for (Index i = 0; i < element_count(mesh.topology(), domain); ++i) {
        const Index v = domain == Domain::vertex ? i : mesh.topology().faces().vertices[i];
        const Vec3 axis = surface[v].cross(Vec3(std::sin(v), std::cos(2 * v), 1.0)).normalized();
        const Vec3 n = Eigen::AngleAxisd(degrees / kToDegrees, axis) * surface[v];
        normals.values.insert(normals.values.end(), n.data(), n.data() + 3);
    }
    mesh.attributes().add(std::move(normals));
}

// How far the angle between stored normals and the surface's own differs from the rest, ascending,
// in degrees.
std::vector<double> angle_errors(const Mesh& mesh, const Mesh& rest) {
    const std::vector<Vec3> now = vertex_normals(mesh), before = vertex_normals(rest);
    const Attribute &a = *mesh.attributes().find("normal"), &b = *rest.attributes().find("normal");
    std::vector<double> errors;
    for (Index i = 0; i < a.size(); ++i) {
        const Index v = a.domain == Domain::vertex ? i : mesh.topology().faces().vertices[i];
        errors.push_back(
            std::abs(angle_between(stored(a, i), now[v]) - angle_between(stored(b, i), before[v])));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

double percentile_99(const std::vector<double>& ascending) {
    return ascending[ascending.size() * 99 / 100];
}

// Bends the scene by 90 degrees in every way that gives a result, and calls check(mesh) each time.
template <typename Check>
void for_each_bend(const Scene& scene, const Check& check) {
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    Mesh mesh = scene.mesh;
    d.set_transform(edit.high, bend(scene, d.handle(edit.high).center, 0.5 * kPi));
    d.solve();
    d.apply_to(mesh);
    check(mesh);
    d.solve(FrameQuality::preview);
    d.apply_to(mesh);
    check(mesh);
    d.rebase();
    d.set_transform(edit.high, bend(scene, d.handle(edit.high).center, -0.3));
    d.solve();
    d.apply_to(mesh);
    check(mesh);
}

Scene cylinder_scene() {
    return make_scene(make_cylinder({.radius = 0.5, .height = 4.0, .segments = 24, .rings = 40}));
}

}  // namespace

TEST_CASE("normals: the angle to the surface's own normal is that of the rest shape") {
    std::vector<Scene> scenes{cylinder_scene(), make_scene(make_bar({1.0, 5.0, 5, 25}))};
    if (const auto path = data_file("models/hand_plain.obj")) {
        scenes.push_back(make_scene(load_mesh(*path), 0.25));
    }
    for (Scene& scene : scenes) {
        for (const Domain domain : {Domain::vertex, Domain::corner}) {
            for (const double degrees : {0.0, 20.0}) {
                CAPTURE(scene.mesh.vertex_count());
                CAPTURE(degrees);
                add_normals(scene.mesh, domain, degrees);
                for_each_bend(scene, [&](const Mesh& mesh) {
                    const std::vector<double> errors = angle_errors(mesh, scene.mesh);
                    CHECK(percentile_99(errors) < 0.01);
                    CHECK(errors.back() < 1.0);
                });
            }
        }
    }
}

TEST_CASE("normals: those around the region follow too, as their faces move") {
    Scene scene = cylinder_scene();
    add_normals(scene.mesh, Domain::vertex, 0.0);
    const Region upper = select_plane(scene.mesh, Vec3(0, -0.5, 0), Vec3::UnitY());
    Deformer d(scene.mesh, upper);
    const HandleId high = d.add_handle(scene.region(scene.high));
    d.set_transform(high, bend(scene, d.handle(high).center, 1.2));
    d.solve();
    Mesh mesh = scene.mesh;
    d.apply_to(mesh);
    CHECK(angle_errors(mesh, scene.mesh).back() < 0.01);
    d.reset();
    d.apply_to(mesh);
    CHECK(hash(mesh) == hash(scene.mesh));
}

TEST_CASE("normals: at a hard edge each side has its own") {
    Scene scene = make_scene(make_bar({1.0, 5.0, 5, 25}));
    const std::vector<Vec3> flat = face_normals(scene.mesh);
    Attribute normals{"normal", Domain::corner, 3, ScalarType::float32, {}};
    for (Index f = 0; f < scene.mesh.face_count(); ++f) {
        for (std::size_t k = 0; k < scene.mesh.topology().face(f).size(); ++k) {
            normals.values.insert(normals.values.end(), flat[f].data(), flat[f].data() + 3);
        }
    }
    scene.mesh.attributes().add(normals);
    for_each_bend(scene, [&](const Mesh& mesh) {
        const std::vector<Vec3> now = face_normals(mesh);
        const Topology& topology = mesh.topology();
        const Attribute& carried = *mesh.attributes().find("normal");
        double worst = 0.0;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const std::span<const Index> face = topology.face(f);
            for (std::size_t k = 0; k < face.size(); ++k) {
                // The faces of the same side around the vertex.
                Vec3 sum = Vec3::Zero();
                for (const Index g : topology.faces_around(face[k])) {
                    if ((flat[g] - flat[f]).norm() > 1e-9) continue;
                    const auto around = topology.face(g);
                    const auto at = static_cast<std::size_t>(
                        std::find(around.begin(), around.end(), face[k]) - around.begin());
                    const std::size_t n = around.size();
                    sum += corner_angle(mesh.position(around[(at + n - 1) % n]),
                                        mesh.position(around[at]),
                                        mesh.position(around[(at + 1) % n]), now[g]) *
                           now[g];
                }
                const Index corner = topology.first_corner(f) + static_cast<Index>(k);
                worst = std::max(worst, angle_between(stored(carried, corner), sum));
            }
        }
        CHECK(worst < 1e-4);
    });
}

TEST_CASE("normals: what is asked between a result and its use does not change them") {
    Scene scene = cylinder_scene();
    add_normals(scene.mesh, Domain::vertex, 20.0);
    const Affine move = bend(scene, Vec3(0, 2, 0), 0.5 * kPi);
    const auto bent = [&] {
        Edit edit = make_edit(scene);
        edit.deformer.set_transform(edit.high, move);
        edit.deformer.solve();
        return edit;
    };
    Mesh wanted = scene.mesh;
    bent().deformer.apply_to(wanted);
    const Region middle = select_sphere(scene.mesh, Vec3::Zero(), 0.55);
    using Between = void (*)(Edit&, const Region&);
    const Between between[] = {
        [](Edit& e, const Region& r) { e.deformer.add_handle(r); },
        [](Edit& e, const Region& r) {
            e.deformer.add_handle(r);
            e.deformer.prepare();
        },
        [](Edit& e, const Region&) { basis_of(e.deformer); },
        [](Edit& e, const Region&) { gradients_of(e.deformer); },
        [](Edit& e, const Region& r) { set_stiffness(e.deformer, r, 5.0); },
        [](Edit& e, const Region& r) {
            e.deformer.constrain(VertexConstraint{r.vertices().front(), Vec3(9, 9, 9), {}, {}});
        },
        [](Edit& e, const Region&) {
            e.deformer.set_transform(e.high, translation({1, 2, 3}));
        },
        [](Edit& e, const Region&) { e.deformer.remove_handle(e.low); }};
    for (const Between& ask : between) {
        Edit edit = bent();
        ask(edit, middle);
        Mesh mesh = scene.mesh;
        edit.deformer.apply_to(mesh);
        CHECK(hash(mesh) == hash(wanted));
        const Mesh refined = subdivided_mesh(edit.deformer, scene.mesh);
        const Attribute& normals = *refined.attributes().find("normal");
        double worst = 0.0;
        for (Index v = 0; v < wanted.vertex_count(); ++v) {
            worst = std::max(worst, angle_between(stored(normals, v),
                                                  stored(*wanted.attributes().find("normal"), v)));
        }
        CHECK(worst < 1e-6);
        edit.deformer.rebase();
        edit.deformer.apply_to(mesh);
        CHECK(hash(mesh) == hash(wanted));
    }
}

TEST_CASE("a result is shown again, to the bit, after others") {
    Scene scene = cylinder_scene();
    add_normals(scene.mesh, Domain::vertex, 20.0);
    Edit edit = make_edit(scene), same = make_edit(scene);
    for (Edit* e : {&edit, &same}) {
        e->deformer.set_transform(e->high, bend(scene, Vec3(0, 2, 0), 1.0));
        e->deformer.solve();
    }
    Deformer& d = edit.deformer;
    const DeformSnapshot before = d.snapshot();
    d.set_transform(edit.high, translation({1, 1, 0}));
    d.solve(FrameQuality::preview);
    d.add_handle(select_sphere(scene.mesh, Vec3::Zero(), 0.55));
    d.solve();
    d.restore(before);
    Mesh shown = scene.mesh, wanted = scene.mesh;
    d.apply_to(shown);
    same.deformer.apply_to(wanted);
    CHECK(hash(shown) == hash(wanted));
    CHECK(gradients_of(d) == gradients_of(same.deformer));
    CHECK(hash(subdivided_mesh(d, scene.mesh)) == hash(subdivided_mesh(same.deformer, scene.mesh)));
    d.rebase();
    CHECK(rest_positions_of(d) == same.deformer.positions());
}

TEST_CASE("normals: vertices without faces turn with their handle") {
    Mesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, [] {
        FaceList faces;
        faces.add({0, 1, 2});
        return faces;
    }());
    mesh.attributes().add(
        {"normal", Domain::vertex, 3, ScalarType::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0}});
    const Region all = Region::all(mesh.shared_topology());
    Deformer d(mesh, all);
    const HandleId handle = d.add_handle(all);
    const Affine turn = rotation(Vec3::UnitZ(), 0.5 * kPi, Vec3::Zero());
    for (int twice = 1; twice <= 2; ++twice) {
        d.set_transform(handle, turn);
        d.solve();
        d.apply_to(mesh);
        const double sign = twice == 1 ? 1.0 : -1.0;
        const Vec3 wanted = twice == 1 ? Vec3::UnitY() : Vec3(sign * Vec3::UnitX());
        CHECK((stored(*mesh.attributes().find("normal"), 3) - wanted).norm() < 1e-12);
        CHECK((stored(*mesh.attributes().find("normal"), 0) - Vec3::UnitZ()).norm() < 1e-12);
        d.rebase();
    }
}

TEST_CASE("normals of the surface that is shown are those of the mesh that it is written to") {
    Mesh mesh = make_sphere({.segments = 24});
    const Region part =
        Region::all(mesh.shared_topology()).minus(select_sphere(mesh, Vec3(-1, 0, 0), 0.6));
    Deformer deformer(mesh, part);
    const HandleId tip = deformer.add_handle(select_sphere(mesh, Vec3(1, 0, 0), 0.3));
    for (const double angle : {0.0, 0.4, 0.8}) {
        deformer.set_transform(tip, rotation(Vec3::UnitZ(), angle, Vec3(0.5, 0, 0)));
        angle == 0.4 ? deformer.solve(FrameQuality::preview) : deformer.solve(FrameQuality::draft);
        const std::vector<Vec3> normals = normals_of(deformer);
        deformer.apply_to(mesh);
        const std::vector<Vec3> expected = vertex_normals(mesh);
        for (Index row = 0; row < part.size(); ++row) {
            CHECK((normals[at(row)] - expected[at(part.vertices()[at(row)])]).norm() < 1e-13);
        }
    }
}
