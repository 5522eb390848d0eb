#include "kernel/mesh/measure/measures.h"

#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

TEST_CASE("a box measures what it says") {
    const Mesh box = make_box({.size = {2, 3, 4}, .segments = {3, 2, 5}});
    CHECK(area(box) == Approx(52.0));
    CHECK(volume(box) == Approx(24.0));
    CHECK(bounds(box).min == Vec3(-1, -1.5, -2));
    CHECK(bounds(box).max == Vec3(1, 1.5, 2));
    CHECK(surface_centroid(box).norm() < 1e-14);
    CHECK(euler_characteristic(box.topology()) == 2);
    CHECK(genus(box.topology()) == 0);
}

TEST_CASE("the surface radius is the exact integral over triangles") {
    // A square of side 2: the mean of x^2 + z^2 over it is 2/3.
    CHECK(surface_radius(make_grid({.size = {2, 2}, .segments = {1, 1}})) ==
          Approx(std::sqrt(2.0 / 3.0)));
    CHECK(surface_radius(make_sphere({.radius = 3.0, .segments = 64})) ==
          Approx(3.0).epsilon(1e-3));
}

TEST_CASE("the surface radius does not depend on how the surface is divided or placed") {
    const Mesh coarse = make_box({.size = {1, 2, 3}});
    const double radius = surface_radius(coarse);
    CHECK(surface_radius(subdivide(coarse, {.levels = 2})) == Approx(radius).epsilon(1e-13));
    test::Random random(1);
    for (const double scale : {1e-6, 1.0, 1e6}) {
        const Mesh turned = test::moved(coarse, test::similarity(random, scale));
        CHECK(surface_radius(turned) == Approx(scale * radius).epsilon(1e-9));
    }
    const Mesh far = test::moved(coarse, translation(Vec3(1e6, -1e6, 1e6)));
    CHECK(surface_radius(far) == Approx(radius).epsilon(1e-8));
}

TEST_CASE("measures without area or vertices are defined") {
    CHECK(surface_radius(Mesh()) == 0.0);
    CHECK(volume(Mesh()) == 0.0);
    CHECK(mean_edge_length(Mesh()) == 0.0);
    CHECK(bounds(Mesh()).empty());
    const Mesh points({{0, 0, 0}, {2, 0, 0}}, FaceList{});
    CHECK(surface_radius(points) == Approx(1.0));
    CHECK(surface_centroid(points) == Vec3(1, 0, 0));
}

TEST_CASE("area and volume of a sphere converge with the square of the spacing") {
    const double exact_area = 4.0 * kPi, exact_volume = 4.0 / 3.0 * kPi;
    for (const SphereKind kind : {SphereKind::quads, SphereKind::triangles}) {
        const Mesh coarse = make_sphere({.segments = 8, .kind = kind});
        const Mesh fine = make_sphere({.segments = 16, .kind = kind});
        CHECK((exact_area - area(coarse)) / (exact_area - area(fine)) == Approx(4.0).epsilon(0.05));
        CHECK((exact_volume - volume(coarse)) / (exact_volume - volume(fine)) ==
              Approx(4.0).epsilon(0.05));
    }
}

TEST_CASE("the volume of an open mesh closes its boundaries by cones") {
    const Mesh open = make_cylinder({.segments = 64, .rings = 3, .caps = false});
    const Mesh closed = make_cylinder({.segments = 64, .rings = 3, .caps = true});
    CHECK(volume(open) == Approx(volume(closed)));
    test::Random random(2);
    CHECK(volume(test::moved(open, test::similarity(random, 2.0))) == Approx(8 * volume(open)));
}

TEST_CASE("genus counts handles over components, with boundaries closed") {
    CHECK(genus(make_torus().topology()) == 1);
    CHECK(euler_characteristic(make_torus().topology()) == 0);
    CHECK(genus(make_cylinder({.caps = false}).topology()) == 0);
    CHECK(euler_characteristic(make_cylinder({.caps = false}).topology()) == 0);
    CHECK(genus(test::patch().topology()) == 0);
    CHECK(genus(*Topology::create(4, {})) == 0);
    if (const auto mesh = test::load_off("fertility.off")) CHECK(genus(mesh->topology()) == 4);
}

TEST_CASE("face normals are those of the vector area, also of polygons") {
    const std::vector<Vec3> normals = face_normals(test::patch());
    for (const Vec3& n : normals) CHECK((n - Vec3(0, 0, 1)).norm() < 1e-15);
    const Mesh sphere = make_sphere({.segments = 8});
    const std::vector<Vec3> outward = face_normals(sphere);
    for (Index f = 0; f < sphere.face_count(); ++f) {
        CHECK(outward[f].dot(sphere.position(sphere.topology().face(f)[0])) > 0.8);
    }
}

TEST_CASE("vertex normals do not depend on how flat faces are divided") {
    const Mesh box = make_box();
    for (Index v = 0; v < 8; ++v) {
        const Vec3 diagonal = box.position(v).normalized();
        CHECK((vertex_normals(box)[v] - diagonal).norm() < 1e-14);
        CHECK((vertex_normals(subdivide(box))[v] - diagonal).norm() < 1e-14);
    }
}

TEST_CASE("normals do not depend on the size of a mesh, as far as numbers reach") {
    for (const Mesh& shape : {make_sphere({.segments = 8}), make_box()}) {
        const std::vector<Vec3> expected = vertex_normals(shape), of_faces = face_normals(shape);
        for (const double size : {1e-300, 1e-160, 1e-70, 1e70, 1e100, 1e200, 1e308}) {
            CAPTURE(size);
            Mesh scaled = shape;
            for (Vec3& p : scaled.edit_positions()) p *= size;
            const std::vector<Vec3> normals = vertex_normals(scaled), faces = face_normals(scaled);
            for (std::size_t v = 0; v < normals.size(); ++v) {
                CHECK((normals[v] - expected[v]).norm() < 1e-12);
            }
            for (std::size_t f = 0; f < faces.size(); ++f) {
                CHECK((faces[f] - of_faces[f]).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("faces without area are found and have no normal") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({1, 3, 2});
    const Mesh mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, std::move(faces));
    CHECK(zero_area_faces(mesh) == std::vector<Index>{0});
    CHECK(face_normals(mesh)[0] == Vec3::Zero());
    CHECK(vertex_normals(mesh)[0] == Vec3::Zero());
    CHECK((vertex_normals(mesh)[1] - Vec3(0, 0, -1)).norm() < 1e-15);
}

TEST_CASE("region measures belong to the mesh") {
    const Mesh box = make_box();
    CHECK((center(box, *box.find_region("top")) - Vec3(0, 0.5, 0)).norm() < 1e-15);
    CHECK(bounds(box, *box.find_region("left")).max == Vec3(-0.5, 0.5, 0.5));
    CHECK(test::error_of([&] { (void)center(box, Region::none(box.shared_topology())); }).code() ==
          ErrorCode::region_empty);
    const Mesh other = make_box();
    CHECK(test::error_of([&] { (void)bounds(other, *box.find_region("top")); }).code() ==
          ErrorCode::topology_mismatch);
}

TEST_CASE("equal meshes have equal hashes and any change makes another") {
    const Mesh mesh = test::decorated(test::patch());
    CHECK(hash(mesh) == hash(test::decorated(test::patch())));
    const auto changed = [&](const auto& change) {
        Mesh copy = mesh;
        change(copy);
        return hash(copy) != hash(mesh);
    };
    CHECK(changed([](Mesh& m) { m.edit_positions()[3].y() += 1e-15; }));
    CHECK(changed([](Mesh& m) { m.attributes().find("uv")->values[1] += 1; }));
    CHECK(changed([](Mesh& m) { m.attributes().find("uv")->name = "vu"; }));
    CHECK(changed([](Mesh& m) { m.attributes().labels()["group"].of_face[0] = 1; }));
    CHECK(changed([](Mesh& m) { m.set_region("half", Region::all(m.shared_topology())); }));
    CHECK(changed([](Mesh& m) { m.material_libraries().push_back("wood.mtl"); }));
}

TEST_CASE("the hash is the same on every platform") {
    CHECK(hash(test::tetrahedron()) == 14971065722607511851ULL);
    Mesh mesh = test::tetrahedron();
    mesh.attributes().add({"a", Domain::face, 1, ScalarType::float32, {test::kNaN, 1, 2, 3}});
    Mesh other = test::tetrahedron();
    other.attributes().add({"a", Domain::face, 1, ScalarType::float32, {-test::kNaN, 1, 2, 3}});
    CHECK(hash(mesh) == hash(other));
}
