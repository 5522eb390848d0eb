// Features beside a cleared place stay: bumps on generated shapes, one beside the other.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A surface with two bumps, of which a part covers one.
struct TwoBumps {
    std::string name;
    Mesh mesh;
    Vec3 covered = Vec3::Zero(), neighbour = Vec3::Zero();
    // Of either bump, its foot included.
    double radius = 0.0;
    // Height of the covered bump.
    double height = 0.0;
    // Of the part, so that its boundary runs around the covered bump alone.
    double scale = 0.0;
};

// Rises along the normal, smoothly to nothing at `radius`.
void raise(Mesh& mesh, const Vec3& middle, double radius, double height) {
    const std::vector<Vec3> normals = vertex_normals(mesh);
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const double r = (positions[v] - middle).norm() / radius;
        if (r < 1.0) positions[v] += height * std::pow(1.0 - r * r, 2) * normals[v];
    }
    mesh.set_positions(std::move(positions));
}

TwoBumps with_bumps(std::string name, Mesh mesh, const Vec3& covered, const Vec3& neighbour,
                    double radius, double height) {
    const SpatialTree surface(mesh);
    TwoBumps made{std::move(name),
                  mesh,
                  surface.nearest(covered).position,
                  surface.nearest(neighbour).position,
                  radius,
                  height,
                  1.25 * radius / 0.72};
    raise(made.mesh, made.covered, radius, height);
    raise(made.mesh, made.neighbour, radius, height);
    return made;
}

std::vector<TwoBumps> faces_with_bumps() {
    std::vector<TwoBumps> all;
    const Mesh ball = make_sphere({1.0, 32, SphereKind::triangles});
    all.push_back(with_bumps("ball", ball, {0, 0, 1}, {0, -0.65, 0.76}, 0.22, 0.2));
    const Mesh sheet = make_grid({.size = {3, 3}, .segments = {48, 48}});
    all.push_back(with_bumps("sheet", sheet, {0, 0, 0}, {0.72, 0, 0.1}, 0.25, 0.25));
    const Mesh column = make_cylinder({.radius = 1.0, .height = 4.0, .segments = 60, .rings = 40});
    all.push_back(with_bumps("column", column, {1, 0, 0}, {1, 0.78, 0.1}, 0.27, 0.22));
    return all;
}

struct Cleared {
    Paste paste;
    PasteResult result;
    Vec3 middle = Vec3::Zero();
    // Mean distance of the loop from its middle.
    double radius = 0.0;
};

Cleared cleared_under(const TwoBumps& target, const Vec3& at) {
    static const Mesh horn = horned_ball(16);
    PasteOptions options;
    options.clear = true;
    Paste paste(horn, target.mesh, around_horn(horn), std::nullopt, std::nullopt,
                {.at = at, .scale = target.scale}, options);
    paste.optimize();
    PasteResult result = paste.merge();
    Cleared made{std::move(paste), std::move(result), Vec3::Zero(), 0.0};
    const std::vector<Vec3> loop = made.paste.image().points();
    for (const Vec3& p : loop) made.middle += p / static_cast<double>(loop.size());
    for (const Vec3& p : loop) {
        made.radius += (p - made.middle).norm() / static_cast<double>(loop.size());
    }
    return made;
}

// Target vertices that the result has no more.
std::vector<Index> missing_vertices(const Mesh& target, const MergeResult& merged) {
    std::vector<char> kept(at(target.vertex_count()), 0);
    for (Index v = 0; v < merged.mesh.vertex_count(); ++v) {
        for (const ElementMap::Source& source : merged.provenance.vertices[v]) {
            if (source.element < target.vertex_count()) kept[at(source.element)] = 1;
        }
    }
    std::vector<Index> missing;
    for (Index v = 0; v < target.vertex_count(); ++v) {
        if (!kept[at(v)]) missing.push_back(v);
    }
    return missing;
}

// How far any of the vertices lies from a point, at most.
double reach_of(const Mesh& mesh, std::span<const Index> vertices, const Vec3& from) {
    double reach = 0.0;
    for (const Index v : vertices) reach = std::max(reach, (mesh.position(v) - from).norm());
    return reach;
}

// How far the neighbour's vertices have come off the surface of a result, at most.
double neighbour_off(const TwoBumps& target, const Mesh& result) {
    const SpatialTree surface(result);
    double off = 0.0;
    for (const Vec3& p : target.mesh.positions()) {
        if ((p - target.neighbour).norm() > target.radius) continue;
        off = std::max(off, surface.nearest(p).distance);
    }
    return off;
}

double area_of_faces(const Mesh& mesh, const Region& region) {
    double area = 0.0;
    for (const Index f : region.faces()) area += 0.5 * area_vector(mesh, f).norm();
    return area;
}

}  // namespace

TEST_CASE("paste: clearing takes the bump under the part, and its neighbour stays as it was") {
    for (const TwoBumps& target : faces_with_bumps()) {
        CAPTURE(target.name);
        const Cleared made = cleared_under(target, target.covered);
        REQUIRE(made.result.report.clearing);
        CHECK(neighbour_off(target, made.result.merged.mesh) < 1e-9);
        const std::vector<Index> missing = missing_vertices(target.mesh, made.result.merged);
        REQUIRE(!missing.empty());
        const double reach = reach_of(target.mesh, missing, made.middle);
        CHECK(reach < 1.3 * made.radius);
        CHECK(reach > 0.7 * made.radius);
        REQUIRE(made.paste.cleared());
        CHECK(reach_of(target.mesh, made.paste.cleared()->vertices(), made.middle) <
              1.3 * made.radius);
    }
}

TEST_CASE("paste: the report of a clearing has its faces, their area and their greatest height") {
    for (const TwoBumps& target : faces_with_bumps()) {
        CAPTURE(target.name);
        const Cleared made = cleared_under(target, target.covered);
        REQUIRE(made.result.report.clearing);
        const PasteClearing& told = *made.result.report.clearing;
        const Region gone = *made.paste.cleared();
        CHECK(told.faces == count_of(gone.faces()));
        CHECK(told.area == doctest::Approx(area_of_faces(target.mesh, gone)).epsilon(1e-9));
        CHECK(told.height == doctest::Approx(target.height).epsilon(0.25));
    }
}

TEST_CASE("paste: a shift of the part by .003 of the size clears the same bump alone") {
    for (const TwoBumps& target : faces_with_bumps()) {
        CAPTURE(target.name);
        const Cleared still = cleared_under(target, target.covered);
        REQUIRE(still.result.report.clearing);
        const PasteClearing& told = *still.result.report.clearing;
        const double shift = 0.003 * bounds(target.mesh).diagonal();
        for (const Vec3& way : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0),
                                Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
            CAPTURE(way.transpose());
            const Cleared moved = cleared_under(target, target.covered + shift * way);
            REQUIRE(moved.result.report.clearing);
            const PasteClearing& other = *moved.result.report.clearing;
            CHECK(other.area == doctest::Approx(told.area).epsilon(0.15));
            CHECK(other.height == doctest::Approx(told.height).epsilon(0.2));
            CHECK(neighbour_off(target, moved.result.merged.mesh) < 1e-9);
        }
    }
}

namespace {

// Vertices that an erasure took.
std::vector<Index> erased_vertices(const Mesh& mesh, const ErasedFeature& erased) {
    std::vector<char> kept(at(mesh.vertex_count()), 0);
    for (Index v = 0; v < erased.mesh.vertex_count(); ++v) {
        const Index from = erased.map.vertices.main_source(v);
        if (from != kNoIndex) kept[at(from)] = 1;
    }
    std::vector<Index> gone;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!kept[at(v)]) gone.push_back(v);
    }
    return gone;
}

// Radius of a region's longest outline, as EraseOptions::ring counts.
double outline_radius(const Mesh& mesh, const Region& region) {
    double longest = 0.0;
    for (const std::vector<Index>& loop : region.boundaries()) {
        double length = 0.0;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            length += (mesh.position(loop[k]) - mesh.position(loop[(k + 1) % loop.size()])).norm();
        }
        longest = std::max(longest, length);
    }
    return longest / (2.0 * kPi);
}

}  // namespace

TEST_CASE("erase: nothing goes beyond the region and its ring") {
    for (const TwoBumps& target : faces_with_bumps()) {
        const Region marked = select_sphere(target.mesh, target.covered, target.radius);
        const std::vector<double> away = edge_distances(target.mesh, marked.vertices());
        for (const double ring : {0.0, 0.25, 0.5, 1.0}) {
            CAPTURE(target.name);
            CAPTURE(ring);
            EraseOptions options;
            options.ring = ring;
            const ErasedFeature erased = erase_feature(target.mesh, marked, options);
            const double width = ring * outline_radius(target.mesh, marked);
            double farthest = 0.0;
            for (const Index v : erased_vertices(target.mesh, erased)) {
                farthest = std::max(farthest, away[at(v)]);
            }
            CHECK(farthest <= width);
        }
    }
}

TEST_CASE("erase: a ring ends at the edge of a block, whose sides stay") {
    // The region of the bump goes up to the edge: its ring would run down the side.
    Mesh block = make_box({{2, 1, 2}, {40, 20, 40}});
    const Vec3 middle(0.65, 0.5, 0.0);
    std::vector<Vec3> positions(block.positions().begin(), block.positions().end());
    for (Vec3& p : positions) {
        const double r = (p - middle).norm() / 0.3;
        if (r < 1.0 && p.y() > 0.49) p.y() += 0.25 * std::pow(1.0 - r * r, 2);
    }
    block.set_positions(std::move(positions));
    const Region top = select_plane(block, {0.0, 0.5 - 1e-9, 0.0}, Vec3::UnitY());
    const Region bump = select_sphere(block, middle, 0.4).intersected(top);
    for (const double ring : {0.25, 0.5, 1.0, 2.0}) {
        CAPTURE(ring);
        EraseOptions options;
        options.ring = ring;
        const ErasedFeature erased = erase_feature(block, bump, options);
        CHECK(erased.report.removed_faces > 50);
        for (const Index v : erased_vertices(block, erased)) {
            CHECK(block.position(v).y() > 0.5 - 1e-9);
        }
        CHECK(erased.mesh.topology().is_closed());
    }
}
