#include "viewer/render/draw/shading_normals.h"

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"

using namespace lissom;

namespace {

constexpr double kCrease = 50.0 * kPi / 180.0;

}  // namespace

TEST_CASE("a box keeps its edges: every corner has the normal of its face") {
    const Mesh box = make_box({.segments = {3, 3, 3}});
    const auto of_faces = face_normals(box.topology(), box.positions());
    const auto of_corners = corner_normals(box.topology(), box.positions(), kCrease);
    for (Index f = 0; f < box.face_count(); ++f) {
        for (Index k = 0; k < 4; ++k) {
            CHECK((of_corners[box.topology().first_corner(f) + k] - of_faces[f]).norm() < 1e-12);
        }
    }
}

TEST_CASE("with a crease of 180 degrees a box is smooth: one normal a vertex, towards its corner") {
    const Mesh box = make_box();
    const auto normals = corner_normals(box.topology(), box.positions(), kPi);
    for (Index c = 0; c < box.topology().corner_count(); ++c) {
        const Vec3 corner = box.position(box.topology().faces().vertices[c]).normalized();
        CHECK((normals[c] - corner).norm() < 1e-12);
    }
}

TEST_CASE("normals of a sphere point away from its center") {
    const Mesh sphere = make_sphere({.segments = 24});
    const auto normals = corner_normals(sphere.topology(), sphere.positions(), kCrease);
    for (Index c = 0; c < sphere.topology().corner_count(); ++c) {
        const Vec3& p = sphere.position(sphere.topology().faces().vertices[c]);
        CHECK((normals[c] - p).norm() < 0.01);
    }
}

TEST_CASE("weights by angle make normals independent of the triangulation") {
    const Mesh quads = make_box();
    FaceList split;
    for (Index f = 0; f < quads.face_count(); ++f) {
        const auto face = quads.topology().face(f);
        split.add({face[0], face[1], face[2]});
        split.add({face[0], face[2], face[3]});
    }
    const Mesh triangles({quads.positions().begin(), quads.positions().end()}, std::move(split));
    const auto normals = corner_normals(triangles.topology(), triangles.positions(), kPi);
    for (Index c = 0; c < triangles.topology().corner_count(); ++c) {
        const Vec3 corner =
            triangles.position(triangles.topology().faces().vertices[c]).normalized();
        CHECK((normals[c] - corner).norm() < 1e-12);
    }
}

TEST_CASE("a face without area takes part in its neighbours' normal and has none of its own") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({0, 2, 3});
    const std::vector<Vec3> positions{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0.5, 0)};
    const Mesh mesh(positions, std::move(faces));
    const auto of_faces = face_normals(mesh.topology(), mesh.positions());
    const auto normals = corner_normals(mesh.topology(), mesh.positions(), kCrease);
    CHECK(of_faces[1].isZero());
    CHECK(normals[0].isApprox(Vec3::UnitZ()));
    CHECK(normals[3].isApprox(Vec3::UnitZ()));  // at vertex 0, in the face without area
    CHECK(normals[5].isZero());                 // at vertex 3, where it is alone
}

TEST_CASE("the number of threads changes nothing") {
    const Mesh torus = make_torus({.segments = 120, .tube_segments = 60});
    ContextOptions threaded;
    threaded.threads = 4;
    CHECK(corner_normals(torus.topology(), torus.positions(), kCrease) ==
          corner_normals(torus.topology(), torus.positions(), kCrease, Context(threaded)));
}
