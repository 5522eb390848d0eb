#include "viewer/render/draw/surface_arrays.h"

#include <Eigen/Geometry>
#include <limits>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/draw/image/colormap.h"
#include "viewer/render/draw/quick_vertices.h"

using namespace lissom;

namespace {

// A corner with all that is drawn of it.
struct Corner : SurfaceVertex, SurfaceColor {};

std::vector<Corner> build(const Mesh& mesh, const MeshStyle& style = {},
                          const Affine& transform = {}) {
    const std::vector<Vec3> positions = picture_positions(mesh, transform);
    const SurfaceTriangles triangles = surface_triangles(mesh, positions, transform, nullptr);
    const auto vertices = surface_vertices(mesh, style, positions, triangles);
    const auto colors = surface_colors(mesh, style, {0.0, 1.0}, triangles);
    REQUIRE(vertices.size() == colors.size());
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < vertices.size(); ++i) corners.push_back({vertices[i], colors[i]});
    return corners;
}

std::array<std::uint8_t, 4> color_of(const Corner& vertex) {
    return vertex.color;
}

int sides(std::uint32_t flags) {
    return (flags & 1) + ((flags >> 1) & 1) + ((flags >> 2) & 1);
}

Vec3 to_vec(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

// The normal of a QuickVertex.
Vec3 unpacked(std::uint32_t normal) {
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        const int part = int(normal >> (10 * axis) & 0x3ff);
        result[axis] = (part >= 512 ? part - 1024 : part) / 511.0;
    }
    return result;
}

// Normal of triangle `t` by its winding.
Vec3 winding(const std::vector<Corner>& vertices, std::size_t t) {
    const Vec3 a = to_vec(vertices[3 * t].position), b = to_vec(vertices[3 * t + 1].position);
    return (b - a).cross(to_vec(vertices[3 * t + 2].position) - a).normalized();
}

}  // namespace

TEST_CASE("normals of a surface that moves are those of the kernel") {
    Mesh bar = make_bar({});
    triangulate(bar);
    for (Vec3& p : bar.edit_positions())
        p = Vec3(p.x() * p.x() * p.x(), 2.0 * p.y(), p.z() + 0.3 * p.y() * p.x());
    MeshStyle style;
    style.crease = kPi;
    const std::vector<Vec3> positions = picture_positions(bar, {});
    const SurfaceTriangles triangles = surface_triangles(bar, positions, {}, nullptr);
    const auto vertices = surface_vertices(bar, style, positions, triangles);
    std::vector<QuickVertex> quick;
    quick_surface_vertices(bar, {}, triangles, normal_groups(triangles, vertices, Shading::smooth),
                           quick);
    const std::vector<Vec3> expected = vertex_normals(bar);
    double worst = 0.0, still = 0.0;
    for (std::size_t e = 0; e < quick.size(); ++e) {
        const Vec3& normal = expected[at(triangles.faces->triangles[e / 3][e % 3])];
        worst = std::max(worst, (unpacked(quick[e].normal) - normal).norm());
        still = std::max(still, (to_vec(vertices[e].normal) - normal).norm());
    }
    // Ten bits a part.
    CHECK(worst < 0.005);
    CHECK(still < 1e-6);
}

TEST_CASE("the diagonal of a quad is no edge, all sides of a triangle are") {
    const auto quad = build(test::make_square());
    REQUIRE(quad.size() == 6);
    CHECK(sides(quad[0].flags) == 2);
    CHECK(sides(quad[3].flags) == 2);
    const auto triangles = build(make_sphere({.segments = 2, .kind = SphereKind::triangles}));
    for (const Corner& vertex : triangles) CHECK(sides(vertex.flags) == 3);
}

TEST_CASE("a polygon of n sides has n edges") {
    FaceList faces;
    std::vector<Vec3> positions;
    for (int i = 0; i < 7; ++i) positions.push_back({std::cos(i * 0.9), std::sin(i * 0.9), 0.0});
    faces.add({0, 1, 2, 3, 4, 5, 6});
    const auto vertices = build(Mesh(positions, std::move(faces)));
    int edges = 0;
    for (std::size_t i = 0; i < vertices.size(); i += 3) edges += sides(vertices[i].flags);
    CHECK(edges == 7);
}

TEST_CASE("flagged sides lie opposite to their corner") {
    const Mesh square = test::make_square();
    for (const Affine& transform : {Affine{}, scaling(Vec3(-1, 1, 1), Vec3::Zero())}) {
        const auto vertices = build(square, {}, transform);
        for (std::size_t t = 0; t < 2; ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 a = to_vec(vertices[3 * t + (i + 1) % 3].position);
                const Vec3 b = to_vec(vertices[3 * t + (i + 2) % 3].position);
                const bool is_side = (a - b).norm() < 2.5;
                CHECK(((vertices[3 * t].flags >> i) & 1) == (is_side ? 1u : 0u));
            }
        }
    }
}

TEST_CASE("a mirroring transform keeps the outside outside") {
    const Mesh sphere = make_sphere({.segments = 3});
    const auto vertices = build(sphere, {}, scaling(Vec3(1, -2, 1), Vec3::Zero()));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3 outward = to_vec(vertices[i].position);
        CHECK(to_vec(vertices[i].normal).dot(outward) > 0.0);
        CHECK(winding(vertices, i / 3).dot(outward) > 0.0);
    }
}

TEST_CASE("flat shading gives each polygon one normal") {
    const auto vertices = build(make_sphere({.segments = 4}), {.shading = Shading::flat});
    for (std::size_t i = 0; i < vertices.size(); i += 6) {
        for (std::size_t k = 1; k < 6; ++k) CHECK(vertices[i + k].normal == vertices[i].normal);
    }
}

TEST_CASE(
    "faces inside the region and the handle have their colours, those across the border not") {
    const Mesh bar = make_bar({.across = 1, .along = 4});
    std::vector<Index> upper, top;
    for (Index v = 0; v < bar.vertex_count(); ++v) {
        if (bar.position(v).y() > -0.1) upper.push_back(v);
        if (bar.position(v).y() > 2.4) top.push_back(v);
    }
    MeshStyle style;
    style.region = Region(bar.shared_topology(), upper);
    style.handles = {Region(bar.shared_topology(), top)};
    int regions = 0, handles = 0;
    for (const Corner& vertex : build(bar, style)) {
        regions += color_of(vertex) == to_bytes(kRegionColor);
        handles += color_of(vertex) == to_bytes(kHandleColor);
    }
    CHECK(regions == 2 * 4 * 6);  // two rows of four quads
    CHECK(handles == 6);          // the end square
}

TEST_CASE(
    "values come before the region, handles before values, and NaN has no place on the scale") {
    const Mesh box = make_box({.segments = {2, 2, 2}});
    MeshStyle style;
    style.region = Region::all(box.shared_topology());
    style.values.assign(static_cast<std::size_t>(box.vertex_count()), 0.5);
    style.values[0] = std::numeric_limits<double>::quiet_NaN();
    style.handles = {*box.find_region("top")};
    int on_scale = 0, without = 0, handle = 0;
    for (const Corner& vertex : build(box, style)) {
        if (vertex.flags & kValueFlag) {
            ++on_scale;
            CHECK(vertex.value == 0.5f);
            continue;
        }
        handle += color_of(vertex) == to_bytes(kHandleColor);
        without += color_of(vertex) == to_bytes(kNoValueColor);
    }
    CHECK(handle == 4 * 6);
    CHECK(without == 3 * 6);
    CHECK(on_scale == 17 * 6);
}

TEST_CASE(
    "colours of vertices, corners and faces are drawn, and their own colour where they have none") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> red_first{1, 0, 0, nan, nan, nan, 0, 1, 0, 0, 0, 1};
    for (const Domain domain : {Domain::vertex, Domain::corner}) {
        Mesh square = test::make_square();
        square.attributes().add({"color", domain, 3, ScalarType::float32, red_first});
        bool red = false, own = false;
        for (const Corner& vertex : build(square)) {
            red = red || color_of(vertex) == to_bytes({1, 0, 0});
            own = own || color_of(vertex) == to_bytes(kClayColor);
        }
        CHECK(red);
        CHECK(own);
        for (const Corner& vertex : build(square, {.vertex_colors = false})) {
            CHECK(color_of(vertex) == to_bytes(kClayColor));
        }
    }
    Mesh square = test::make_square();
    square.attributes().add({"color", Domain::face, 4, ScalarType::float32, {0, 1, 0, 1}});
    for (const Corner& vertex : build(square)) {
        CHECK(color_of(vertex) == to_bytes({0, 1, 0}));
    }
}

TEST_CASE("regions of another mesh and values of another count are refused") {
    const Mesh box = make_box(), other = make_box();
    const auto code = [&](const MeshStyle& style) {
        return test::error_of([&] { build(box, style); }).code();
    };
    CHECK(code({.region = Region::all(other.shared_topology())}) == ErrorCode::topology_mismatch);
    CHECK(code({.handles = {Region::all(other.shared_topology())}}) ==
          ErrorCode::topology_mismatch);
    CHECK(code({.values = {1.0, 2.0}}) == ErrorCode::invalid_argument);
}

TEST_CASE("boundary loops become lines of different colours, lone handle vertices points") {
    const Mesh tube = make_cylinder({.segments = 8, .rings = 2, .caps = false});
    MeshStyle style;
    style.boundaries = true;
    style.handles = {Region(tube.shared_topology(), {3})};
    const Affine moved = translation(Vec3(1, 2, 3));
    const Overlay marks = build_marks({test::shared(tube), style, moved});
    REQUIRE(marks.lines.size() == 2);
    CHECK(marks.lines[0].points.size() == 8);
    CHECK(marks.lines[0].closed);
    CHECK_FALSE(marks.lines[0].color == marks.lines[1].color);
    REQUIRE(marks.points.size() == 1);
    CHECK(marks.points[0].position == moved(tube.position(3)));

    // A face, a vertex beside it, and one elsewhere.
    const auto face = tube.topology().face(0);
    std::vector<Index> held(face.begin(), face.end());
    for (const Index v : tube.topology().neighbors(face[0])) held.push_back(v);
    held.push_back(tube.vertex_count() - 4);
    style.handles = {Region(tube.shared_topology(), held)};
    const Overlay rim = build_marks({test::shared(tube), style, moved});
    REQUIRE(rim.points.size() == 1);
    CHECK(rim.points[0].position == moved(tube.position(tube.vertex_count() - 4)));
}

TEST_CASE(
    "parts have their colours, the last over the others, and points where they hold no face") {
    const Mesh sphere = make_sphere();
    const Region all = Region::all(sphere.shared_topology());
    const Region face(sphere.shared_topology(),
                      {sphere.topology().face(7).begin(), sphere.topology().face(7).end()});
    const Color red{1.0, 0.0, 0.0}, blue{0.0, 0.0, 1.0}, green{0.0, 1.0, 0.0};
    MeshStyle style{.parts = {{all, red}, {face, blue}}};
    std::size_t blues = 0;
    for (const Corner& corner : build(sphere, style)) {
        const bool is_blue = color_of(corner) == to_bytes(blue);
        blues += is_blue ? 1 : 0;
        CHECK((is_blue || color_of(corner) == to_bytes(red)));
    }
    CHECK(blues == 3 * (sphere.topology().face(7).size() - 2));
    CHECK(build_marks({test::shared(sphere), style}).points.empty());
    const DrawnMesh before{test::shared(sphere), style};
    style.parts.push_back({Region(sphere.shared_topology(), {3}), green});
    const DrawnMesh after{before.mesh, style};
    CHECK_FALSE(same_colors(before, after));
    CHECK_FALSE(same_marks(before, after));
    const Overlay marks = build_marks(after);
    REQUIRE(marks.points.size() == 1);
    CHECK(marks.points[0].color == green);
    // The region of interest lies over them.
    style.region = all;
    CHECK(color_of(build(sphere, style)[0]) == to_bytes(kRegionColor));
    style.parts = {{Region::all(make_sphere().shared_topology()), red}};
    CHECK(test::error_of([&] { build(sphere, style); }).code() == ErrorCode::topology_mismatch);
}

TEST_CASE("normals stand on vertices and faces, outward, also where the picture is a mirror") {
    const Mesh sphere = make_sphere();
    DrawnMesh drawn{test::shared(sphere)};
    drawn.style.vertex_normals = drawn.style.face_normals = true;
    CHECK_FALSE(same_marks({drawn.mesh}, drawn));
    for (const double side : {1.0, -1.0}) {
        drawn.transform = translation(Vec3(5, 0, 0));
        drawn.transform.linear = Vec3(2.0 * side, 2.0, 2.0).asDiagonal();
        const Overlay marks = build_marks(drawn);
        REQUIRE(marks.lines.size() == at(sphere.vertex_count() + sphere.face_count()));
        for (const DrawnLine& line : marks.lines) {
            const Vec3 from = line.points[0] - Vec3(5, 0, 0), to = line.points[1] - Vec3(5, 0, 0);
            CHECK(to.norm() > from.norm());
            CHECK(to.normalized().dot(from.normalized()) > 0.99);
        }
    }
    // Many are drawn by evenly chosen ones.
    const Mesh fine = make_sphere({.segments = 250});
    const DrawnMesh many{test::shared(fine), {.vertex_normals = true}};
    REQUIRE(fine.vertex_count() > 100000);
    CHECK(build_marks(many).lines.size() <= 30000);
    CHECK(build_marks(many).lines.size() > 10000);
}

TEST_CASE("the range of values leaves out NaN and is nothing without values") {
    const Mesh square = test::make_square();
    DrawnMesh drawn{test::shared(square)};
    CHECK_FALSE(range_of_values({drawn}));
    drawn.style.values = {3.0, std::numeric_limits<double>::quiet_NaN(), -1.0, 2.0};
    const auto range = range_of_values({drawn, drawn});
    REQUIRE(range);
    CHECK(range->low == -1.0);
    CHECK(range->high == 3.0);
}
