// Cuts of scanned, modelled and CAD surfaces.

#include <set>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/query/region_select.h"
#include "tests/unit/mesh/cut/cut_support.h"

using namespace lissom;

namespace {

// A part of a model that is easily named: the plane that cuts it, and where the rest is.
struct NamedCut {
    std::string file;
    /// Loop subdivisions before.
    Index levels;
    CutPlane plane;
};

const NamedCut kNamedCuts[] = {
    {"fish_oded.obj", 1, {{0, .1, -.17}, {0, .72, -.7}, Vec3(0, 0, -1.8)}},
    {"venus_torso_711.off", 2, {{0, -.95, 0}, {0, 1, 0}, Vec3(0, 1, 0)}},
    {"venus_torso_711.off", 2, {{0, 2.36, -.1}, {0, -1, 0}, Vec3(0, 0, 0)}},
    {"mannequin_nyugp.off", 0, {{40, .5, -14.4}, {0, .05, 1}, Vec3(40, .7, -12)}},
    {"camel_isoblend.obj", 0, {{0, .52, -.6}, {0, -.76, .65}, Vec3(0, .2, .5)}},
    {"camelhead.off", 0, {{0, -.28, .2}, {0, 1, 0}, Vec3(0, 0, -.3)}},
    {"cow_3k.off", 1, {{.27, .1, 0}, {-1, -.55, 0}, Vec3(-.2, 0, 0)}},
    {"dinosaur.obj", 0, {{2, 3, 0}, {-.5, 1, 0}, Vec3(-30, 40, 0)}},
    {"feline_small.obj", 1, {{-.2, 1.42, -.1}, {-1, 0, 0}, Vec3(-.6, 1.4, -.1)}},
    {"spot.obj", 1, {{0, .17, -.21}, {0, -.62, .79}, Vec3(0, 0, .8)}},
};

const char* const kModels[] = {"lion.off",          "bunny_3k.off",  "pelvis.obj",
                               "fertility.off",     "cad_block.off", "fandisk_quads.off",
                               "horse_quad.obj",    "stairs.off",    "decimated-knight.off",
                               "mannequin_lwu.obj", "spot.obj",      "cad_conrod.stl"};

// Calls check(mesh) for each model that is there.
template <typename Check>
void for_each_model(const Check& check) {
    for (const std::string name : kModels) {
        CAPTURE(name);
        if (const auto path = test::data_file("models/" + name)) check(load_mesh(*path));
    }
}

double fifth_percentile(const Mesh& mesh, const std::vector<Index>& vertices) {
    const auto angles = test::angles_at(mesh, {vertices.begin(), vertices.end()});
    return angles[angles.size() / 20];
}

}  // namespace

TEST_CASE("real meshes: planes through necks and waists leave one clean loop") {
    for (const NamedCut& named : kNamedCuts) {
        CAPTURE(named.file);
        const auto path = test::data_file("models/" + named.file);
        if (!path) continue;
        const Mesh mesh = subdivide(load_mesh(*path), {named.levels, SubdivisionScheme::loop});
        const Cut parts = cut(mesh, named.plane);
        test::check_cut(mesh, parts);
        REQUIRE(parts.lines.size() == 1);
        CHECK(parts.lines[0].kept.closed());
        CHECK(parts.report.touched_boundaries.empty());
        CHECK(mean_turn(parts.kept.mesh, parts.lines[0].kept) < 16 * kDegree);
        // As good as the triangles that were there, or good enough to work with.
        std::set<Index> around(parts.report.slid_vertices.begin(),
                               parts.report.slid_vertices.end());
        const double before = fifth_percentile(mesh, {around.begin(), around.end()});
        const auto& line = parts.lines[0].kept.vertices();
        CHECK(fifth_percentile(parts.kept.mesh, line) > std::min(10.0, 0.5 * before));
    }
}

TEST_CASE("real meshes: random planes, nearest line and all lines") {
    test::Random random(17);
    for_each_model([&](const Mesh& mesh) {
        Index cuts = 0;
        for (int i = 0; i < 8; ++i) {
            const Vec3 point = mesh.position(random.index(mesh.vertex_count()));
            const CutPlane plane{point, random.direction()};
            for (const CutLoops loops : {CutLoops::nearest, CutLoops::all}) {
                try {
                    test::check_cut(mesh, cut(mesh, plane, {.loops = loops}));
                    ++cuts;
                } catch (const Error& error) {
                    CAPTURE(error.message());
                    // A plane through an outermost vertex only touches.
                    const bool misses = error.code() == ErrorCode::invalid_argument;
                    CHECK((misses || error.code() == ErrorCode::boundary_conflict));
                    CHECK((misses || loops == CutLoops::nearest));
                }
            }
        }
        CHECK(cuts >= 6);
    });
}

TEST_CASE("real meshes: jagged boundaries become smooth") {
    for (const std::string name : {"lion.off", "bunny_3k.off", "spot.obj", "camelhead.off"}) {
        CAPTURE(name);
        const auto path = test::data_file("models/" + name);
        if (!path) continue;
        const Mesh whole = load_mesh(*path);
        const Region part = select_plane(whole, bounds(whole).center(), {0.3, 1, 0.2});
        const Mesh jagged = extract(whole, part).mesh;
        // The longest loop is the one across the body.
        const auto loops = boundaries(jagged);
        const auto longest =
            std::max_element(loops.begin(), loops.end(),
                             [](const Path& a, const Path& b) { return a.size() < b.size(); });
        const Trim trimmed = trim(jagged, *longest);
        CHECK(test::is_boundary_of(trimmed.mesh, trimmed.boundary));
        CHECK(euler_characteristic(trimmed.mesh.topology()) ==
              euler_characteristic(jagged.topology()));
        CHECK(trimmed.turn_before > 25 * kDegree);
        CHECK(trimmed.turn_after < 16 * kDegree);
    }
}
