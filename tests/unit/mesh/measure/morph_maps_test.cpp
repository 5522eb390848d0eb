// Every operation on one mesh that moves or makes vertices, and what morph targets become by it.
#include "kernel/mesh/measure/morph_maps.h"

#include <functional>
#include <utility>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/mesh/morph_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

using Operation = std::pair<const char*, std::function<void(Mesh&)>>;

Mesh open_ball(Index segments = 14) {
    const Mesh ball = make_sphere({.segments = segments, .kind = SphereKind::quads});
    return remove(ball, select_plane(ball, Vec3(0, 0.5, 0), Vec3(0.2, 1, 0))).mesh;
}

void subdivide_by(Mesh& mesh, SubdivisionScheme scheme) {
    mesh.replace_by(subdivide(mesh, {.levels = 2, .scheme = scheme}));
}

void subdivide_part(Mesh& mesh, SubdivisionScheme scheme) {
    SubdivideOptions options{.levels = 2, .scheme = scheme};
    options.region = select_plane(mesh, Vec3(0.1, 0, 0), Vec3(1, 0, 0));
    mesh.replace_by(subdivide(mesh, options));
}

void smooth_half(Mesh& mesh, const SmoothOptions& options) {
    SmoothOptions own = options;
    own.region = select_plane(mesh, Vec3(0.1, 0, 0), Vec3(1, 0, 0));
    smooth(mesh, own);
}

// A box whose target raises its upper four corners by 1.
Mesh box_with_lid(double top) {
    FaceList faces;
    for (const auto& face :
         {std::array{0, 1, 2, 3}, std::array{0, 4, 5, 1}, std::array{1, 5, 6, 2},
          std::array{2, 6, 7, 3}, std::array{3, 7, 4, 0}, std::array{7, 6, 5, 4}}) {
        faces.add(face);
    }
    Mesh box({{0, 0, 0},
              {2, 0, 0},
              {2, 0, 2},
              {0, 0, 2},
              {0, top, 0},
              {2, top, 0},
              {2, top, 2},
              {0, top, 2}},
             std::move(faces));
    std::vector<Vec3> lid(8, Vec3::Zero());
    for (std::size_t v = 4; v < 8; ++v) lid[v] = Vec3::UnitY();
    test::add_target(box, 1, Domain::vertex, lid);
    return box;
}

}  // namespace

TEST_CASE("morph targets go through the linear map of every operation on a mesh") {
    const std::vector<Operation> operations = {
        {"midpoint", [](Mesh& m) { subdivide_by(m, SubdivisionScheme::midpoint); }},
        {"loop", [](Mesh& m) { subdivide_by(m, SubdivisionScheme::loop); }},
        {"catmull_clark", [](Mesh& m) { subdivide_by(m, SubdivisionScheme::catmull_clark); }},
        {"part by loop", [](Mesh& m) { subdivide_part(m, SubdivisionScheme::loop); }},
        {"part by catmull_clark",
         [](Mesh& m) { subdivide_part(m, SubdivisionScheme::catmull_clark); }},
        {"smooth", [](Mesh& m) { smooth(m, {.iterations = 5}); }},
        {"cotangents", [](Mesh& m) { smooth(m, {.weights = SmoothWeights::cotangent}); }},
        {"along", [](Mesh& m) { smooth(m, {.boundary = SmoothBoundary::along}); }},
        {"keep_volume", [](Mesh& m) { smooth(m, {.keep_volume = true}); }},
        {"part", [](Mesh& m) { smooth_half(m, {.iterations = 3}); }},
        {"path", [](Mesh& m) { smooth_path(m, boundaries(m)[0], 4, 0.5); }},
        {"fill", [](Mesh& m) { fill(m, boundaries(m)[0]); }},
        {"curvature",
         [](Mesh& m) { fill(m, boundaries(m)[0], {.continuity = FairContinuity::curvature}); }},
        {"coarse",
         [](Mesh& m) { fill(m, boundaries(m)[0], {.fair = false, .maximum_vertices = 9}); }},
        {"lid", [](Mesh& m) { fill(m, boundaries(m)[0], {.method = FillMethod::area}); }},
        {"dense", [](Mesh& m) { fill(m, boundaries(m)[0], {.density = 3.0}); }},
        {"cut",
         [](Mesh& m) {
             m.replace_by(cut(m, CutPlane{{0, -0.1, 0}, {0.1, 1, 0.2}}).kept.mesh);
         }},
        {"trim", [](Mesh& m) { m.replace_by(trim(m, boundaries(m)[0]).mesh); }},
        {"triangulate", [](Mesh& m) { triangulate(m); }},
    };
    for (const auto& operation : operations) {
        CAPTURE(operation.first);
        Mesh mesh = open_ball();
        test::add_telling_targets(mesh);
        operation.second(mesh);
        CHECK(test::departure(mesh) < 1e-9);
    }
}

TEST_CASE("subdivided, a mesh with a target is the subdivision of the mesh moved by it") {
    for (const SubdivisionScheme scheme :
         {SubdivisionScheme::midpoint, SubdivisionScheme::loop, SubdivisionScheme::catmull_clark}) {
        Mesh mesh = make_sphere({.segments = 8});
        // How polygons are split depends on the shape; triangles are split alike.
        triangulate(mesh);
        test::add_telling_targets(mesh);
        for (const int number : {1, 2, 3, 4}) {
            const Mesh fine = subdivide(mesh, {.levels = 2, .scheme = scheme});
            const Mesh moved =
                subdivide(test::moved_by_target(mesh, number), {.levels = 2, .scheme = scheme});
            const Mesh there = test::moved_by_target(fine, number);
            for (Index v = 0; v < fine.vertex_count(); ++v) {
                CHECK((there.position(v) - moved.position(v)).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("a box whose target raises its lid is smoothed as the higher box is") {
    const std::pair<SubdivisionScheme, double> expected[] = {
        {SubdivisionScheme::midpoint, 3.0},
        {SubdivisionScheme::loop, 2.2734375},
        {SubdivisionScheme::catmull_clark, 7.0 / 3.0}};
    for (const auto& [scheme, height] : expected) {
        const Mesh low = subdivide(box_with_lid(2.0), {.levels = 1, .scheme = scheme});
        const Mesh high = subdivide(box_with_lid(3.0), {.levels = 1, .scheme = scheme});
        CHECK(low.position(4).y() + test::target(low, 1)[4].y() == Approx(height).epsilon(1e-14));
        CHECK(high.position(4).y() == Approx(height).epsilon(1e-14));
    }
    Mesh low = box_with_lid(2.0), high = box_with_lid(3.0);
    smooth(low, {.iterations = 5});
    smooth(high, {.iterations = 5});
    CHECK(low.position(4).y() + test::target(low, 1)[4].y() ==
          Approx(high.position(4).y()).epsilon(1e-14));
}

TEST_CASE("a corner that a target tears from the others keeps its distance to them") {
    Mesh mesh = make_grid({.segments = {4, 4}});
    test::add_target(mesh, 1, Domain::corner, std::vector<Vec3>(25, Vec3::UnitY()));
    Attribute& morph = *mesh.attributes().find("morph.1.position");
    const Index v = 12, first = mesh.topology().first_corner(mesh.topology().faces_around(v)[0]);
    Index corner = first;
    while (mesh.topology().faces().vertices[at(corner)] != v) ++corner;
    morph.at(corner)[1] = 5.0;
    const std::vector<double> before = morph.values;
    smooth(mesh, {.iterations = 1});
    const std::vector<double>& after = mesh.attributes().find("morph.1.position")->values;
    for (Index c = 0; c < mesh.topology().corner_count(); ++c) {
        if (mesh.topology().faces().vertices[at(c)] != v || c == corner) continue;
        CHECK(after[at(3 * corner + 1)] - after[at(3 * c + 1)] == Approx(4.0));
    }
}

TEST_CASE("targets that a part does not have are still none there, and zero beside it") {
    Mesh mesh = make_grid({.segments = {8, 8}});
    std::vector<Vec3> half;
    for (const Vec3& p : mesh.positions()) {
        half.push_back(p.x() > 0.3 ? Vec3(0, 1, 0) : Vec3(Vec3::Constant(test::kNaN)));
    }
    test::add_target(mesh, 1, Domain::vertex, half);
    smooth(mesh, {.iterations = 1});
    const Attribute& morph = *mesh.attributes().find("morph.1.position");
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double y = morph.at(v)[1];
        if (mesh.position(v).x() < 0.0) CHECK(std::isnan(y));
        if (std::isfinite(half[at(v)].y())) CHECK(y > 0.0);
    }
}
