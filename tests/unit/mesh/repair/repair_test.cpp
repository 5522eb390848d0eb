#include "kernel/mesh/repair/repair.h"

#include <algorithm>
#include <random>
#include <set>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {
namespace {

Soup soup_of(const Mesh& mesh) {
    Soup soup;
    soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
    soup.faces = mesh.topology().faces();
    soup.attributes = mesh.attributes();
    for (const auto& [name, region] : mesh.regions()) soup.regions[name] = region.vertices();
    return soup;
}

// Every face on vertices of its own, as files with a normal for each face have it.
Soup torn(const Mesh& mesh) {
    Soup soup;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index v : mesh.topology().face(f)) {
            face.push_back(static_cast<Index>(soup.positions.size()));
            soup.positions.push_back(mesh.position(v));
        }
        soup.faces.add(face);
    }
    return soup;
}

Soup soup(std::vector<Vec3> positions, std::vector<std::vector<Index>> faces) {
    Soup result;
    result.positions = std::move(positions);
    for (const auto& face : faces) result.faces.add(face);
    return result;
}

std::size_t count(const Mesh& mesh, FindingKind kind) {
    const Finding* finding = mesh.report().find(kind);
    return finding ? finding->count : 0;
}

std::vector<Index> ids(const Mesh& mesh, FindingKind kind) {
    const Finding* finding = mesh.report().find(kind);
    return finding ? finding->ids : std::vector<Index>{};
}

// The strict check accepts the faces of the result.
void check_manifold(const Mesh& mesh) {
    CHECK_NOTHROW(Topology::create(mesh.vertex_count(), mesh.topology().faces()));
}

bool is_mended(const Mesh& mesh) {
    const auto& findings = mesh.report().findings();
    return std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
        return f.kind <= FindingKind::vertices_nonmanifold;
    });
}

ErrorCode strict_error(Soup bad, Weld weld = Weld::seams) {
    return error_of([&] { repair(std::move(bad), {weld, false}); }).code();
}

Mesh box() {
    return make_box({});
}

}  // namespace

TEST_CASE("a sound mesh comes through to the bit, with no findings") {
    for (const Mesh& mesh : {box(), make_torus({}), make_grid({}), patch()}) {
        const Mesh same = repair(soup_of(mesh));
        CHECK(hash(same) == hash(mesh));
        CHECK(same.report().empty());
        CHECK(hash(repair(soup_of(mesh), {Weld::all, false})) == hash(mesh));
    }
}

TEST_CASE(
    "a closed shape in pieces is welded along its seams, whatever the number of faces at a "
    "corner") {
    for (const Mesh& mesh : {box(), make_torus({}), make_sphere({})}) {
        for (const Weld weld : {Weld::seams, Weld::all}) {
            const Mesh welded = repair(torn(mesh), {weld, true});
            CHECK(welded.vertex_count() == mesh.vertex_count());
            CHECK(welded.face_count() == mesh.face_count());
            CHECK(welded.topology().is_closed());
            CHECK(volume(welded) == doctest::Approx(volume(mesh)));
            CHECK(count(welded, FindingKind::vertices_welded) ==
                  static_cast<std::size_t>(mesh.topology().corner_count() - mesh.vertex_count()));
            check_manifold(welded);
        }
        const Mesh apart = repair(torn(mesh), {Weld::none, true});
        CHECK(apart.topology().component_count() == mesh.face_count());
    }
}

TEST_CASE("surfaces that only touch stay apart with seams and are joined with all") {
    Mesh two = box();
    Mesh other = box();
    const double width = bounds(two).max.x() - bounds(two).min.x();
    transform(other, {Mat3::Identity(), Vec3(width, 0, 0)});
    append(two, other);
    const Mesh apart = repair(soup_of(two));
    CHECK(apart.topology().component_count() == 2);
    CHECK(apart.report().empty());

    const Mesh joined = repair(soup_of(two), {Weld::all, true});
    check_manifold(joined);
    CHECK(count(joined, FindingKind::edges_nonmanifold) > 0);
    CHECK(joined.topology().is_closed());
    CHECK(volume(joined) == doctest::Approx(volume(two)));
    CHECK(joined.topology().component_count() == 2);
}

TEST_CASE("seams weld neither the back of a sheet to its front nor one object to another") {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Vec3> twice = corners;
    twice.insert(twice.end(), corners.begin(), corners.end());
    CHECK(repair(soup(twice, {{0, 1, 2, 3}, {7, 6, 5, 4}})).topology().component_count() == 2);

    Soup halves = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                       {{0, 1, 2}, {3, 4, 5}});
    CHECK(repair(halves).topology().component_count() == 1);
    halves.attributes.labels()["object"] = {{"left", "right"}, {0, 1}};
    CHECK(repair(halves).topology().component_count() == 2);
    CHECK(repair(halves, {Weld::all, true}).topology().component_count() == 1);
}

TEST_CASE("values that differ along a seam become values of corners, others stay with vertices") {
    Soup halves = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                       {{0, 1, 2}, {3, 4, 5}});
    halves.attributes.add(
        {"uv", Domain::vertex, 2, ScalarType::float32, {0, 0, 1, 0, 0, 1, .2, .2, .3, .3, .4, .4}});
    halves.attributes.add({"heat", Domain::vertex, 1, ScalarType::float32, {0, 1, 2, 1, 4, 2}});
    halves.attributes.add({"weights", Domain::vertex, 1, ScalarType::float32, {0, 1, 2, 3, 4, 5}});
    halves.regions["edge"] = {3, 5};
    const Mesh mesh = repair(halves);
    REQUIRE(mesh.vertex_count() == 4);
    const Attribute* uv = mesh.attributes().find("uv");
    CHECK(uv->domain == Domain::corner);
    CHECK(uv->values == halves.attributes.find("uv")->values);
    CHECK(mesh.attributes().find("heat")->values == std::vector<double>{0, 1, 2, 4});
    CHECK(mesh.attributes().find("weights")->values == std::vector<double>{0, 1, 2, 4});
    CHECK(mesh.find_region("edge")->vertices() == std::vector<Index>{1, 2});
    CHECK(ids(mesh, FindingKind::vertices_welded) == std::vector<Index>{3, 5});
}

TEST_CASE("vertices that the file says are one are one, whatever else is welded") {
    Soup halves = soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                       {{0, 1, 2}, {3, 4, 5}});
    halves.same_as = {0, 1, 2, 1, 4, 5};
    const Mesh mesh = repair(halves, {Weld::none, true});
    CHECK(ids(mesh, FindingKind::vertices_welded) == std::vector<Index>{3});
    CHECK(mesh.vertex_count() == 6);  // the faces share one vertex only, which is split
    halves.same_as = {0, 1, 2, 1, 4, 2};
    CHECK(repair(halves, {Weld::none, true}).vertex_count() == 4);
    halves.same_as = {0, 1, 2, 1, 4, 9};
    CHECK(error_of([&] { repair(halves); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("vertices without faces are dropped, but points without any face are kept") {
    Soup lonely = soup_of(tetrahedron());
    lonely.positions.insert(lonely.positions.begin() + 2, Vec3(9, 9, 9));
    for (Index& v : lonely.faces.vertices) v += v >= 2;
    CHECK(strict_error(lonely) == ErrorCode::unreferenced_vertex);
    const Mesh mesh = repair(lonely);
    CHECK(mesh.vertex_count() == 4);
    CHECK(ids(mesh, FindingKind::vertices_unreferenced) == std::vector<Index>{2});

    const Mesh points = repair(soup({{0, 0, 0}, {1, 0, 0}}, {}));
    CHECK(points.vertex_count() == 2);
    CHECK(count(points, FindingKind::points_only) == 2);
}

TEST_CASE("repeated corners go, pinched faces are split, collapsed ones dropped") {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0},
                                      {2, 1, 0}, {3, 0, 0}, {4, 0, 0}, {4, 1, 0}};
    // A repeat in a row, one across the end, a bow at vertex 1, a spike and a line.
    const Mesh mesh =
        repair(soup(positions, {{0, 1, 1, 2, 3, 0}, {6, 7, 8}, {6, 7}, {8, 8, 8}, {7, 6, 7}}));
    CHECK(mesh.face_count() == 2);
    CHECK(ids(mesh, FindingKind::corners_repeated) == std::vector<Index>{0});
    CHECK(ids(mesh, FindingKind::faces_collapsed) == std::vector<Index>{2, 3, 4});

    const Mesh bow = repair(soup(positions, {{0, 1, 4, 5, 1, 2}}));
    CHECK(bow.face_count() == 2);
    CHECK(ids(bow, FindingKind::faces_pinched) == std::vector<Index>{0});
    CHECK(count(bow, FindingKind::vertices_nonmanifold) == 1);
    check_manifold(bow);

    CHECK(strict_error(soup(positions, {{0, 1, 1, 2, 3}})) == ErrorCode::repeated_vertex);
    CHECK(strict_error(soup(positions, {{0, 1}})) == ErrorCode::face_too_small);
}

TEST_CASE("copies of faces are dropped, with their attributes") {
    Soup doubled = soup_of(tetrahedron());
    doubled.faces.add({1, 3, 0});
    doubled.attributes.labels()["group"] = {{"a", "copy"}, {0, 0, 0, 0, 1}};
    CHECK(strict_error(doubled) == ErrorCode::duplicate_face);
    const Mesh mesh = repair(doubled);
    CHECK(mesh.face_count() == 4);
    CHECK(ids(mesh, FindingKind::faces_duplicate) == std::vector<Index>{4});
    CHECK(mesh.attributes().labels().at("group").of_face == std::vector<Index>{0, 0, 0, 0});
    CHECK(mesh.topology().is_closed());
}

TEST_CASE("flaps and faces that are there once more in reverse go, the surface stays closed") {
    for (const bool reversed : {false, true}) {
        Soup flapped = soup_of(tetrahedron());
        flapped.positions.emplace_back(1, 1, 1);
        flapped.faces.add({0, 1, 4});
        reversed ? flapped.faces.add({4, 1, 0}) : flapped.faces.add({1, 4, 0});
        const Mesh mesh = repair(flapped);
        CHECK(mesh.topology().is_closed());
        CHECK(mesh.face_count() == 4);
        CHECK(ids(mesh, FindingKind::faces_duplicate) == std::vector<Index>{4, 5});
    }
    Soup doubled = soup_of(tetrahedron());
    doubled.faces.add({0, 1, 2});
    const Mesh mesh = repair(doubled);
    CHECK(mesh.topology().is_closed());
    CHECK(ids(mesh, FindingKind::faces_duplicate) == std::vector<Index>{4});
}

TEST_CASE("two torn copies of a solid at one place become two solids") {
    Soup twice = torn(box());
    const Soup second = torn(box());
    const auto offset = static_cast<Index>(twice.positions.size());
    twice.positions.insert(twice.positions.end(), second.positions.begin(), second.positions.end());
    for (Index f = 0; f < second.faces.size(); ++f) {
        std::vector<Index> face;
        for (const Index v : second.faces[f]) face.push_back(v + offset);
        twice.faces.add(face);
    }
    const Mesh mesh = repair(twice);
    CHECK(mesh.topology().is_closed());
    CHECK(mesh.topology().component_count() == 2);
    CHECK(mesh.vertex_count() == 16);
    // The first six faces are one of them.
    CHECK(mesh.topology().components()[mesh.topology().face(0)[0]] ==
          mesh.topology().components()[mesh.topology().face(5)[0]]);
}

TEST_CASE("faces turned at random are oriented outward again, their corner values with them") {
    const Mesh mesh = make_torus({});
    Soup mixed = soup_of(mesh);
    Attribute id{"id", Domain::corner, 1, ScalarType::float64, {}};
    for (const Index v : mixed.faces.vertices) id.values.push_back(v);
    std::mt19937 random(7);
    std::size_t turned = 0;
    for (Index f = 0; f < mixed.faces.size(); ++f) {
        if (random() % 3 != 0) continue;
        ++turned;
        const auto begin = mixed.faces.offsets[f], end = mixed.faces.offsets[f + 1];
        std::reverse(mixed.faces.vertices.begin() + begin, mixed.faces.vertices.begin() + end);
        std::reverse(id.values.begin() + begin, id.values.begin() + end);
    }
    mixed.attributes.add(std::move(id));
    CHECK(strict_error(mixed) == ErrorCode::inconsistent_orientation);
    const Mesh oriented = repair(mixed);
    CHECK(count(oriented, FindingKind::faces_flipped) == turned);
    CHECK(volume(oriented) == doctest::Approx(volume(mesh)));
    check_manifold(oriented);
    const Attribute& kept = *oriented.attributes().find("id");
    for (Index c = 0; c < oriented.topology().corner_count(); ++c)
        REQUIRE(kept.values[c] == oriented.topology().faces().vertices[c]);
}

TEST_CASE("a consistent mesh that is inside out is flagged and left") {
    Mesh inside_out = box();
    flip(inside_out);
    const Mesh mesh = repair(soup_of(inside_out));
    CHECK(hash(mesh) == hash(inside_out));
    CHECK(count(mesh, FindingKind::components_inverted) == 1);
    CHECK(mesh.report().find(FindingKind::components_inverted)->message.find("mesh:flip()") !=
          std::string::npos);

    // A part that is inside out does not make the whole so.
    Mesh mostly = make_sphere({});
    append(mostly, test::moved(inside_out, translation({9, 0, 0})));
    const Mesh mixed = repair(soup_of(mostly));
    REQUIRE(count(mixed, FindingKind::components_inverted) == 1);
    CHECK(mixed.report().find(FindingKind::components_inverted)->message.empty());

    Mesh hollow = make_sphere({});
    Mesh wall = make_sphere({});
    transform(wall, {0.5 * Mat3::Identity(), Vec3::Zero()});
    flip(wall);
    append(hollow, wall);
    CHECK(count(repair(soup_of(hollow)), FindingKind::components_inverted) == 0);
}

TEST_CASE("a collapsed face of a torn mesh goes, and the seam closes over it") {
    Soup pieces = torn(tetrahedron());
    const Index first = static_cast<Index>(pieces.positions.size());
    for (const Index v : {0, 0, 1}) pieces.positions.push_back(tetrahedron().position(v));
    pieces.faces.add({first, first + 1, first + 2});
    const Mesh mesh = repair(pieces);
    CHECK(ids(mesh, FindingKind::faces_collapsed) == std::vector<Index>{4});
    CHECK(mesh.topology().is_closed());
    CHECK(mesh.vertex_count() == 4);
}

TEST_CASE("a band with one side is cut open once") {
    constexpr Index kSegments = 12;
    Soup band;
    for (Index i = 0; i < kSegments; ++i) {
        const double turn = 2 * kPi * i / kSegments;
        const Vec3 out(std::cos(turn), std::sin(turn), 0);
        const Vec3 across = 0.3 * (std::cos(turn / 2) * out + std::sin(turn / 2) * Vec3::UnitZ());
        band.positions.push_back(out - across);
        band.positions.push_back(out + across);
    }
    for (Index i = 0; i < kSegments; ++i) {
        const bool last = i + 1 == kSegments;
        const Index a = 2 * i, b = a + 1, c = last ? 0 : a + 2, d = last ? 1 : a + 3;
        band.faces.add({a, b, last ? c : d, last ? d : c});
    }
    const Mesh mesh = repair(band);
    check_manifold(mesh);
    CHECK(count(mesh, FindingKind::edges_unorientable) == 1);
    CHECK(mesh.face_count() == kSegments);
    CHECK(mesh.topology().component_count() == 1);
    CHECK(mesh.topology().boundary_loops().size() == 1);
    CHECK(mesh.vertex_count() == 2 * kSegments + 2);
}

TEST_CASE("two solids that share an edge become two closed solids") {
    // Two tetrahedra along the edge 0-1, a quarter turn apart.
    const std::vector<Vec3> p{{0, 0, 0},  {0, 0, 1},   {1, 0, .5},
                              {1, 1, .5}, {-1, 0, .5}, {-1, -1, .5}};
    Soup joined = soup(
        p,
        {{1, 3, 0}, {2, 1, 0}, {3, 2, 0}, {2, 3, 1}, {1, 5, 0}, {4, 1, 0}, {5, 4, 0}, {4, 5, 1}});
    CHECK(strict_error(joined) == ErrorCode::nonmanifold_edge);
    const Mesh mesh = repair(joined);
    check_manifold(mesh);
    CHECK(mesh.topology().component_count() == 2);
    CHECK(mesh.topology().is_closed());
    CHECK(ids(mesh, FindingKind::edges_nonmanifold) == std::vector<Index>{0, 1});
    CHECK(count(mesh, FindingKind::vertices_nonmanifold) == 0);
    CHECK(count(mesh, FindingKind::components_inverted) == 0);
    // The first six keep their ids; the copies of the shared edge come last.
    CHECK(mesh.position(6) == p[0]);
    CHECK(mesh.position(7) == p[1]);
}

TEST_CASE("a sheet whose faces are there from both sides becomes two sheets") {
    const Mesh sheet = make_grid({});
    Soup both = soup_of(sheet);
    for (Index f = 0; f < sheet.face_count(); ++f) {
        const auto face = sheet.topology().face(f);
        both.faces.add(std::vector<Index>(face.rbegin(), face.rend()));
    }
    const Mesh mesh = repair(both);
    check_manifold(mesh);
    CHECK(mesh.face_count() == 2 * sheet.face_count());
    CHECK(area(mesh) == doctest::Approx(2 * area(sheet)));
}

TEST_CASE("fans that touch at one vertex are split, the first keeps it") {
    Soup touching =
        soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    CHECK(strict_error(touching) == ErrorCode::nonmanifold_vertex);
    const Mesh mesh = repair(touching);
    check_manifold(mesh);
    CHECK(mesh.vertex_count() == 6);
    CHECK(mesh.topology().face(0)[0] == 0);
    CHECK(mesh.topology().face(1)[0] == 5);
    CHECK(ids(mesh, FindingKind::vertices_nonmanifold) == std::vector<Index>{0});
}

TEST_CASE("poor but sound faces and specks are flagged") {
    Soup poor = soup({{0, 0, 0},
                      {1, 0, 0},
                      {.5, .001, 0},
                      {.5, -1, 0},
                      {2, 0, 0},
                      {1.5, 0, 0},
                      {9, 9, 9},
                      {9, 9.01, 9},
                      {9.01, 9, 9}},
                     {{0, 1, 2}, {1, 0, 3}, {1, 4, 5}, {6, 7, 8}});
    const Mesh flagged = repair(poor, {Weld::none, true});
    CHECK(ids(flagged, FindingKind::faces_sliver) == std::vector<Index>{0});
    CHECK(ids(flagged, FindingKind::faces_zero_area) == std::vector<Index>{2});
    CHECK(count(flagged, FindingKind::components_small) == 2);
    CHECK(strict_error(soup({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})) ==
          ErrorCode::zero_area);
}

TEST_CASE("what cannot be mended is refused, with the elements") {
    Soup bad = soup_of(tetrahedron());
    bad.positions[2].y() = kNaN;
    const Error nan = error_of([&] { repair(bad); });
    CHECK(nan.code() == ErrorCode::not_finite);
    CHECK(nan.elements().ids == std::vector<Index>{2});

    bad = soup_of(tetrahedron());
    bad.faces.vertices[4] = 4;
    const Error index = error_of([&] { repair(bad); });
    CHECK(index.code() == ErrorCode::face_index);
    CHECK(index.elements().ids == std::vector<Index>{1});

    bad = soup_of(tetrahedron());
    bad.attributes.add({"uv", Domain::vertex, 2, ScalarType::float32, {0, 1}});
    CHECK(error_of([&] { repair(bad); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("any soup of faces becomes a manifold that a second repair leaves alone") {
    int with_faces = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        const auto pick = [&](int n) {
            return static_cast<Index>(random() % static_cast<unsigned>(n));
        };
        const Index vertices = 3 + pick(12), places = 3 + pick(8);
        Soup soup;
        for (Index v = 0; v < vertices; ++v) {
            const Index at = pick(places);
            soup.positions.emplace_back(at % 3, (at * at) % 5, (at * 7) % 4);
        }
        Attribute origin{"origin", Domain::corner, 1, ScalarType::float64, {}};
        const Index faces = 1 + pick(25);
        for (Index f = 0; f < faces; ++f) {
            std::vector<Index> face;
            const Index size = 1 + pick(6);
            for (Index k = 0; k < size; ++k) face.push_back(pick(vertices));
            for (const Index v : face) origin.values.push_back(v);
            soup.faces.add(face);
        }
        soup.attributes.add(std::move(origin));
        const std::vector<Vec3> positions = soup.positions;
        for (const Weld weld : {Weld::none, Weld::seams, Weld::all}) {
            const Mesh mesh = repair(soup, {weld, true});
            check_manifold(mesh);
            const Attribute* kept = mesh.attributes().find("origin");
            for (Index c = 0; c < mesh.topology().corner_count(); ++c) {
                const auto from = static_cast<std::size_t>(kept->values[c]);
                REQUIRE(mesh.position(mesh.topology().faces().vertices[c]) == positions[from]);
            }
            if (weld != Weld::none) continue;
            const Mesh again = repair(soup_of(mesh), {weld, true});
            with_faces += mesh.face_count() > 0;
            if (mesh.face_count() > 0) CHECK(hash(again) == hash(mesh));
            CHECK(!is_mended(again));
        }
    }
    CHECK(with_faces > 300);
}

TEST_CASE("a repair can be cancelled") {
    const Context context;
    context.cancel();
    CHECK(error_of([&] { repair(soup_of(box()), {}, context); }).code() == ErrorCode::cancelled);
}

}  // namespace lissom::test
