#include "kernel/mesh/cut/cut.h"

#include <array>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/cut/cut_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

double worst_distance(const Mesh& mesh, const Path& path, const CutPlane& plane) {
    double worst = 0.0;
    for (const Vec3& p : path.points(mesh)) {
        worst = std::max(worst, std::abs((p - plane.point).dot(plane.normal.normalized())));
    }
    return worst;
}

std::vector<Mesh> shapes() {
    std::vector<Mesh> meshes{
        make_sphere({.segments = 8}), make_sphere({.segments = 12, .kind = SphereKind::triangles}),
        make_bar({.across = 4, .along = 20}), make_cactus({.vertices = 3000}), make_torus()};
    return meshes;
}

ErrorCode code_of(const Mesh& mesh, const CutPlane& plane, const CutOptions& options = {}) {
    return test::error_of([&] { (void)cut(mesh, plane, options); }).code();
}

}  // namespace

TEST_CASE("a plane cuts a sphere in two along a circle") {
    for (const SphereKind kind : {SphereKind::quads, SphereKind::triangles}) {
        const Mesh mesh = make_sphere({.segments = 16, .kind = kind});
        const CutPlane plane{{0.1, 0.23, 0}, {0.2, 1, 0.3}};
        const Cut parts = cut(mesh, plane);
        test::check_cut(mesh, parts);
        REQUIRE(parts.lines.size() == 1);
        CHECK(parts.lines[0].kept.closed());
        CHECK(worst_distance(parts.kept.mesh, parts.lines[0].kept, plane) < 1e-12);
        CHECK(parts.report.warnings.empty());
        CHECK(parts.report.lines_left == 0);
        CHECK(area(parts.kept.mesh) < area(parts.rest.mesh));
    }
}

TEST_CASE("random planes through any shape leave two manifold parts that fit to the bit") {
    test::Random random(11);
    int cuts = 0, tries = 0;
    for (const Mesh& mesh : shapes()) {
        for (int i = 0; i < 12; ++i) {
            const CutPlane plane{random.in_box(bounds(mesh)), random.direction()};
            for (const CutLoops loops : {CutLoops::nearest, CutLoops::all}) {
                ++tries;
                try {
                    test::check_cut(mesh, cut(mesh, plane, {.loops = loops}));
                    ++cuts;
                } catch (const Error& e) {
                    const bool crosses = e.code() == ErrorCode::boundary_conflict;
                    CHECK((crosses || e.code() == ErrorCode::invalid_argument));
                    CHECK((loops == CutLoops::nearest || !crosses));
                }
            }
        }
    }
    CHECK(4 * cuts >= 3 * tries);
}

TEST_CASE("rough and folded surfaces on a lattice are cut as well as smooth ones") {
    // Rounding the coordinates makes planes meet many vertices exactly and some faces without area.
    const Mesh meshes[] = {make_sphere({.segments = 6}), make_box({.segments = {3, 3, 3}}),
                           make_torus({.segments = 14, .tube_segments = 8})};
    test::Random random(23);
    int cuts = 0, tries = 0;
    for (int i = 0; i < 240; ++i) {
        CAPTURE(i);
        Mesh mesh = meshes[i % 3];
        const double noise = (i % 2 ? 0.1 : 0.4) * mean_edge_length(mesh);
        for (Vec3& p : mesh.edit_positions()) {
            p += noise * random.direction();
            if (i % 5 == 0) p = (8.0 * p.array()).round() / 8.0;
        }
        if (i % 4 < 2) triangulate(mesh);
        const CutPlane plane{mesh.position(random.index(mesh.vertex_count())), random.direction()};
        for (const double slide : {0.0, 0.25, 0.45}) {
            ++tries;
            try {
                const Cut parts = cut(mesh, plane, {CutLoops::all, slide});
                test::check_lines(parts);
                test::check_faces(mesh, parts);
                ++cuts;
            } catch (const Error& e) {
                CHECK(e.code() == ErrorCode::invalid_argument);
            }
        }
    }
    CHECK(4 * cuts >= 3 * tries);
}

TEST_CASE("planes through vertices, along edges and along faces cut cleanly") {
    // Every layer of vertices of a bar, a box and a sphere, and the same turned.
    for (const Mesh& mesh : {make_bar({.across = 4, .along = 10}), make_sphere({.segments = 8}),
                             make_box({.segments = {2, 2, 2}})}) {
        for (const Vec3& normal : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
            const CutPlane plane{Vec3::Zero(), normal};
            const Cut parts = cut(mesh, plane);
            test::check_cut(mesh, parts);
            CHECK(area(parts.kept.mesh) == Approx(area(parts.rest.mesh)).epsilon(0.02));
            CHECK(worst_distance(parts.kept.mesh, parts.lines[0].kept, plane) < 1e-12);
        }
    }
}

TEST_CASE("a plane on edges divides nothing") {
    const Mesh mesh = make_bar({.across = 2, .along = 4});
    const Cut parts = cut(mesh, {Vec3::Zero(), {0, 1, 0}});
    CHECK(parts.kept.mesh.face_count() == mesh.face_count() / 2);
    CHECK(parts.kept.mesh.vertex_count() == parts.rest.mesh.vertex_count());
    CHECK(parts.lines[0].kept.size() == 8);

    CHECK(parts.rest.mesh.topology().corner_count() == 4 * parts.rest.mesh.face_count());
    CHECK(parts.report.divided_faces == 0);
}

TEST_CASE("a plane that touches does not cut, one that misses says so") {
    const Mesh box = make_box({.segments = {3, 3, 3}});
    CHECK(code_of(box, {{0, 0.5, 0}, {0, 1, 0}}) == ErrorCode::invalid_argument);
    CHECK(code_of(box, {{0, -0.5, 0}, {0, 1, 0}}) == ErrorCode::invalid_argument);
    CHECK(code_of(box, {{0, 2, 0}, {0, 1, 0}}) == ErrorCode::invalid_argument);
    CHECK(code_of(box, {Vec3::Constant(0.5), {1, 1, 1}}) == ErrorCode::invalid_argument);
}

TEST_CASE("only the line nearest to the point is cut; the seed chooses the part that is kept") {
    const Mesh cactus = make_cactus({.vertices = 6000});
    // Both arms and the trunk cross this height.
    const double height = 1.4;
    const Region& arm = *cactus.find_region("left_arm");
    Vec3 point = center(cactus, arm);
    point.y() = height;
    const Cut tip = cut(cactus, {point, {0, 1, 0}});
    test::check_cut(cactus, tip);
    CHECK(tip.report.lines_left == 2);
    CHECK(tip.lines.size() == 1);
    CHECK(bounds(tip.rest.mesh).max.y() == bounds(cactus).max.y());
    CHECK(bounds(tip.kept.mesh).max.x() < 0.0);
    const Cut trunk = cut(cactus, {point, {0, 1, 0}, Vec3(0, 0, 0)});
    CHECK(trunk.kept.mesh.vertex_count() == tip.rest.mesh.vertex_count());
    const Cut whole = cut(cactus, {point, {0, 1, 0}}, {.loops = CutLoops::all});
    CHECK(whole.lines.size() == 3);
    CHECK(whole.kept.mesh.topology().component_count() == 3);
    CHECK(bounds(whole.kept.mesh).min.y() == Approx(height));
}

TEST_CASE("a torus needs both lines of a plane") {
    const Mesh torus = make_torus();
    const CutPlane plane{{1, 0, 0.01}, {0, 0, 1}};
    const Error error = test::error_of([&] { (void)cut(torus, plane); });
    CHECK(error.code() == ErrorCode::boundary_conflict);
    CHECK(error.elements().kind == ElementKind::edge);
    CHECK(error.elements().count > 10);
    const Cut halves = cut(torus, plane, {.loops = CutLoops::all});
    test::check_cut(torus, halves);
    CHECK(halves.lines.size() == 2);
    CHECK(genus(halves.kept.mesh.topology()) == 0);
    // A plane that slices off a piece of the tube needs one only.
    const Cut slice = cut(torus, {{1.2, 0, 0}, {1, 0, 0}});
    test::check_cut(torus, slice);
    CHECK(genus(slice.rest.mesh.topology()) == 1);
}

TEST_CASE("a cut that ends at open boundaries is reported, or refused where it does not separate") {
    const Mesh grid = make_grid();
    const Cut halves = cut(grid, {{0.03, 0, 0}, {1, 0, 0.2}});
    test::check_cut(grid, halves);
    CHECK(!halves.lines[0].kept.closed());
    CHECK(halves.report.touched_boundaries == std::vector<Index>{0});
    REQUIRE(halves.report.warnings.size() == 1);
    CHECK(halves.report.warnings[0].concern == CutConcern::touches_boundary);
    const Mesh tube = make_cylinder({.caps = false});
    CHECK(code_of(tube, {{0.5, 0, 0}, {0, 0, 1}}) == ErrorCode::boundary_conflict);
    const Cut lengthwise = cut(tube, {{0.5, 0, 0.01}, {0, 0, 1}}, {.loops = CutLoops::all});
    test::check_cut(tube, lengthwise);
    CHECK(lengthwise.report.touched_boundaries == std::vector<Index>{0, 1});
}

TEST_CASE("a cut does not depend on size or place") {
    const Mesh mesh = make_cactus({.vertices = 3000});
    const CutPlane plane{{0, 0.7, 0}, {0.3, 1, 0.1}};
    const Cut reference = cut(mesh, plane);
    for (const double scale : {1e-6, 1e6}) {
        for (const double offset : {0.0, 1e4}) {
            const Affine map = translation(Vec3::Constant(scale * offset)) *
                               scaling(Vec3::Constant(scale), Vec3::Zero());
            const Mesh other = test::moved(mesh, map);
            const Cut parts = cut(other, {map(plane.point), plane.normal});
            test::check_cut(other, parts);
            CHECK(parts.kept.mesh.vertex_count() == reference.kept.mesh.vertex_count());
            CHECK(parts.lines[0].kept.size() == reference.lines[0].kept.size());
        }
    }
}

TEST_CASE("turning the normal swaps the parts") {
    const Mesh mesh = make_cactus({.vertices = 3000});
    const CutPlane plane{{0, 0.61, 0}, {0.3, 1, 0.1}}, turned{plane.point, -plane.normal};
    const Cut a = cut(mesh, plane), b = cut(mesh, turned);
    CHECK(a.kept.mesh.vertex_count() == b.rest.mesh.vertex_count());
    CHECK(a.rest.mesh.face_count() == b.kept.mesh.face_count());
}

TEST_CASE("a cut carries attributes, labels, regions and libraries") {
    Mesh mesh = make_bar({.across = 3, .along = 12});
    Attribute normals{"normal", Domain::corner, 3, ScalarType::float32, {}};
    const std::vector<Vec3> of_vertex = vertex_normals(mesh);
    for (const Index v : mesh.topology().faces().vertices) {
        normals.values.insert(normals.values.end(), of_vertex[v].data(), of_vertex[v].data() + 3);
    }
    mesh.attributes().add(normals);
    Attribute place{"color", Domain::corner, 3, ScalarType::float64, {}};
    for (const Index v : mesh.topology().faces().vertices) {
        const Vec3& p = mesh.position(v);
        place.values.insert(place.values.end(), p.data(), p.data() + 3);
    }
    mesh.attributes().add(place);
    mesh.material_libraries() = {"stone.mtl"};
    for (const double slide : {0.0, 0.2, 0.45}) {
        const Cut parts = cut(mesh, {{0, 0.3, 0}, {0.4, 1, 0.2}}, {.slide = slide});
        test::check_cut(mesh, parts);
        for (const Mesh* part : {&parts.kept.mesh, &parts.rest.mesh}) {
            CHECK(part->material_libraries() == mesh.material_libraries());
            const Attribute& there = *part->attributes().find("color");
            const Attribute& normal = *part->attributes().find("normal");
            double error = 0.0, length = 0.0;
            for (Index c = 0; c < part->topology().corner_count(); ++c) {
                const Vec3& p = part->position(part->topology().faces().vertices[c]);
                error = std::max(error, (Vec3(there.at(c).data()) - p).norm());
                length = std::max(length, std::abs(Vec3(normal.at(c).data()).norm() - 1.0));
            }
            CHECK(error < 1e-12);
            CHECK(length < 1e-12);
        }
        CHECK(parts.kept.mesh.find_region("top")->size() == mesh.find_region("top")->size());
        CHECK(parts.rest.mesh.find_region("top")->empty());
    }
}

TEST_CASE("seams of texture coordinates are not displaced") {
    // Two charts side by side: u jumps by 10 at x = 0.
    Mesh mesh = make_grid({.segments = {10, 10}});
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
    for (Index f = 0; f < mesh.face_count(); ++f) {
        double middle = 0.0;
        for (const Index v : mesh.topology().face(f)) middle += mesh.position(v).x();
        for (const Index v : mesh.topology().face(f)) {
            const Vec3& p = mesh.position(v);
            uv.values.insert(uv.values.end(), {p.x() + (middle > 0.0 ? 10.0 : 0.0), p.z()});
        }
    }
    mesh.attributes().add(uv);
    test::Random random(3);
    for (int i = 0; i < 40; ++i) {
        const CutPlane plane{{random.uniform(-0.3, 0.3), 0, random.uniform(-0.3, 0.3)},
                             {random.uniform(-1, 1), 0, random.uniform(-1, 1)}};
        const Cut parts = cut(mesh, plane);
        for (const Mesh* part : {&parts.kept.mesh, &parts.rest.mesh}) {
            double error = 0.0;
            const Attribute& there = *part->attributes().find("uv");
            for (Index c = 0; c < part->topology().corner_count(); ++c) {
                const Vec3& p = part->position(part->topology().faces().vertices[c]);
                const double u = there.at(c)[0] > 5.0 ? there.at(c)[0] - 10.0 : there.at(c)[0];
                error = std::max({error, std::abs(u - p.x()), std::abs(there.at(c)[1] - p.z())});
            }
            // A seam's vertex may slide off it by 0.03 of an edge.
            CHECK(error < 0.03 * 0.15);
        }
    }
}

TEST_CASE("sliding vertices leaves no slivers") {
    test::Random random(5);
    const Mesh mesh = make_sphere({.segments = 24, .kind = SphereKind::triangles});
    std::vector<double> without, with;
    for (int i = 0; i < 20; ++i) {
        const CutPlane plane{0.5 * random.direction(), random.direction()};
        for (auto* angles : {&without, &with}) {
            const Cut parts = cut(mesh, plane, {.slide = angles == &with ? 0.2 : 0.0});
            const auto& line = parts.lines[0].kept.vertices();
            const auto found = test::angles_at(parts.kept.mesh, {line.begin(), line.end()});
            angles->insert(angles->end(), found.begin(), found.end());
        }
    }
    std::sort(without.begin(), without.end());
    std::sort(with.begin(), with.end());
    CHECK(without[without.size() / 20] < 6.0);
    CHECK(with[with.size() / 20] > 10.0);
}

TEST_CASE("components that are not cut go to their side of the plane") {
    Mesh mesh = make_sphere({.segments = 8});
    append(mesh, test::moved(make_sphere({.segments = 3}), translation({0, 3, 0})));
    append(mesh, test::moved(make_sphere({.segments = 3}), translation({3, -0.5, 0})));
    const Cut parts = cut(mesh, {{0, 0, 0}, {0, 1, 0}});
    CHECK(parts.report.whole_components == 2);
    CHECK(parts.report.lines_left == 1);
    CHECK(parts.kept.mesh.topology().component_count() == 2);
    CHECK(parts.rest.mesh.topology().component_count() == 2);
    CHECK(bounds(parts.rest.mesh).max.x() > 3.0);
}

TEST_CASE("a line over fins is reported") {
    // A body with a flat fin on each side, in one piece: a cross-shaped section.
    Mesh mesh = make_cylinder({.segments = 240});
    for (Vec3& p : mesh.edit_positions()) {
        const double angle = std::atan2(p.z(), p.x());
        const double r = 1.0 + 3.0 * std::pow(std::cos(angle), 600);
        p.x() *= r;
        p.z() *= r;
    }
    const Cut parts = cut(mesh, {{0.2, 0.03, 0}, {0, 1, 0}});
    REQUIRE(parts.report.warnings.size() == 1);
    CHECK(parts.report.warnings[0].concern == CutConcern::folded_line);
    CHECK(parts.report.warnings[0].elements.count > 10);
    const Cut plain = cut(make_cactus({.vertices = 4000}), {{0, 0.5, 0}, {0, 1, 0}});
    for (const CutWarning& warning : plain.report.warnings) {
        CHECK(warning.concern == CutConcern::keeps_most);
    }
}

TEST_CASE("what cannot be cut is refused") {
    const Mesh mesh = make_sphere();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(code_of(mesh, {Vec3::Zero(), Vec3::Zero()}) == ErrorCode::invalid_argument);
    CHECK(code_of(mesh, {{nan, 0, 0}, {0, 1, 0}}) == ErrorCode::not_finite);
    CHECK(code_of(mesh, {Vec3::Zero(), {0, nan, 0}}) == ErrorCode::not_finite);
    CHECK(code_of(mesh, {Vec3::Zero(), {0, 1, 0}, Vec3(nan, 0, 0)}) == ErrorCode::not_finite);
    CHECK(code_of(mesh, {}, {.slide = 0.6}) == ErrorCode::invalid_argument);
    CHECK(code_of(mesh, {}, {.slide = nan}) == ErrorCode::invalid_argument);
    CHECK(code_of(Mesh(), {}) == ErrorCode::mesh_empty);
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { (void)cut(mesh, CutPlane{}, {}, context); }).code() ==
          ErrorCode::cancelled);
}

TEST_CASE("a plane that keeps more than four fifths of the mesh is told, unless a seed says it") {
    const Mesh ball = make_sphere({.segments = 16});
    const CutPlane cap{{0, 0.8, 0}, {0, 1, 0}}, rest{{0, 0.8, 0}, {0, -1, 0}};
    const CutReport small = cut(ball, cap).report, large = cut(ball, rest).report;
    // A cap of height h has h / 2 of the area.
    CHECK(small.kept_fraction == Approx(0.1).epsilon(0.05));
    CHECK(large.kept_fraction == Approx(0.9).epsilon(0.01));
    CHECK(small.warnings.empty());
    REQUIRE(large.warnings.size() == 1);
    CHECK(large.warnings[0].concern == CutConcern::keeps_most);
    CHECK(large.warnings[0].message.find("the cut keeps ") == 0);
    const CutPlane meant{rest.point, rest.normal, Vec3(0, -1, 0)};
    CHECK(cut(ball, meant).report.warnings.empty());
    // The fraction is that of the parts, up to what faces that are not plane leave open.
    test::Random random(4);
    for (const Mesh& mesh : {make_box({.size = {3, 1, 2}}), make_bar({.across = 2, .along = 3}),
                             make_sphere({.segments = 2})}) {
        for (int i = 0; i < 8; ++i) {
            const CutPlane plane{0.6 * random.in_box(bounds(mesh)), random.direction()};
            const Cut parts = cut(mesh, plane, {.loops = CutLoops::all, .slide = 0.0});
            const double kept = area(parts.kept.mesh), all = kept + area(parts.rest.mesh);
            CHECK(parts.report.kept_fraction == Approx(kept / all).epsilon(0.005));
        }
    }
}

TEST_CASE("a preview shows the lines of a cut and changes nothing") {
    const Mesh cactus = make_cactus({.vertices = 3000});
    const std::uint64_t before = hash(cactus);
    const CutPlane plane{{0, 1.4, 0}, {0, -1, 0}};
    const CutPreview preview = preview_cut(cactus, plane);
    const Cut done = cut(cactus, plane, {.slide = 0.0});
    CHECK(hash(cactus) == before);
    REQUIRE(preview.lines.size() == 1);
    CHECK(preview.others.size() == static_cast<std::size_t>(done.report.lines_left));
    CHECK(!preview.others.empty());
    CHECK(preview.lines[0].closed());
    CHECK(preview.lines[0].length() == Approx(done.lines[0].kept.length(done.kept.mesh)));
    CHECK(preview.report.kept_fraction == done.report.kept_fraction);
    CHECK(preview.report.warnings.size() == done.report.warnings.size());
    const auto direction = [](const std::vector<Vec3>& points) {
        Vec3 area = Vec3::Zero();
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            area += (points[i] - points[0]).cross(points[i + 1] - points[0]);
        }
        return Vec3(area.normalized());
    };
    CHECK(direction(preview.lines[0].points())
              .dot(direction(done.lines[0].kept.points(done.kept.mesh))) > 0.99);
    // With the seed on the other side the lines run the other way.
    CutPlane other = plane;
    other.seed = Vec3(0, 2, 0);
    CHECK(direction(preview_cut(cactus, other).lines[0].points())
              .dot(direction(preview.lines[0].points())) < -0.99);
    // All lines, of which none is left.
    CHECK(preview_cut(cactus, plane, {.loops = CutLoops::all}).lines.size() ==
          preview.others.size() + 1);
    // Where the cut would fail, the line and the reason are shown.
    const CutPlane through{{1, 0, 0}, {0, 0, 1}};
    const CutPreview torus = preview_cut(make_torus(), through);
    CHECK(torus.lines.size() == 1);
    REQUIRE(!torus.report.warnings.empty());
    CHECK(torus.report.warnings.back().concern == CutConcern::not_separating);
    CHECK(code_of(make_torus(), through) == ErrorCode::boundary_conflict);
    CHECK(test::error_of([&] {
              (void)preview_cut(cactus, CutPlane{{0, 99, 0}, {0, 1, 0}});
          }).code() == ErrorCode::invalid_argument);
}
