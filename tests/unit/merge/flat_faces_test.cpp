// Flat faces of a target beside seams that are bent smooth.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/merge/creases.h"
#include "kernel/merge/merge_once.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A box whose top lies at y = 0, with a square hole in the middle of it, from -1 to 1.
Mesh box_with_hole(double height, Index segments, bool triangles) {
    Mesh box = make_box({{4.0, height, 4.0}, {segments, 2, segments}});
    for (Vec3& p : box.edit_positions()) p.y() -= 0.5 * height;
    std::vector<Index> kept;
    for (Index f = 0; f < box.face_count(); ++f) {
        Vec3 middle = Vec3::Zero();
        for (const Index v : box.topology().face(f)) middle += 0.25 * box.position(v);
        const double out = std::max(std::abs(middle.x()), std::abs(middle.z()));
        if (middle.y() < -1e-9 || out > 1.0) kept.push_back(f);
    }
    Mesh opened = extract_faces(box, kept).mesh;
    if (triangles) triangulate(opened);
    return opened;
}

// A tube with lobes that stands on the hole and grows narrower or wider upward.
Mesh lobed_tube(Index count, double flare) {
    return tube(count, 12, [&](double angle, double height) {
        const double radius = (1.1 + 0.12 * std::cos(3.0 * angle)) * (1.0 + flare * height);
        return Vec3(radius * std::cos(angle), 0.05 + 2.0 * height, -radius * std::sin(angle));
    });
}

// The greatest distance from the plane of the top of vertices of faces that were in it.
double off_top(const MergeResult& result) {
    double off = 0.0;
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
        if (result.side_of_face[f] != SeamSide::target) continue;
        const auto face = result.mesh.topology().face(f);
        const bool of_top = std::all_of(
            face.begin(), face.end(), [&](Index v) { return result.mesh.position(v).y() > -0.15; });
        if (!of_top) continue;
        for (const Index v : face) off = std::max(off, std::abs(result.mesh.position(v).y()));
    }
    return off;
}

}  // namespace

TEST_CASE(
    "fair seams and transitions of suitable widths leave flat faces of boxes and slabs flat") {
    for (const double height : {0.5, 4.0}) {
        for (const Index segments : {4, 8, 16}) {
            for (const bool triangles : {false, true}) {
                for (const bool fair : {false, true}) {
                    CAPTURE(height);
                    CAPTURE(segments);
                    CAPTURE(triangles);
                    CAPTURE(fair);
                    MergeOptions options;
                    options.smooth = 0;
                    options.trim = false;
                    options.auto_transition = !fair;
                    if (fair) options.seam = SeamKind::fair;
                    const Mesh target = box_with_hole(height, segments, triangles);
                    const MergeResult made =
                        merge(lobed_tube(40, segments == 8 ? 0.4 : -0.2), target, {}, options);
                    CHECK(off_top(made) < 1e-9);
                }
            }
        }
    }
}

TEST_CASE(
    "vertices in flat faces are found at any density, turn and size, on round ones there are "
    "none") {
    CHECK(flat_vertices(make_sphere({1.0, 60, SphereKind::triangles})).empty());
    const Mesh box = make_box({{1.0, 2.0, 3.0}, {4, 4, 4}});
    // Three by three inside each of the six sides.
    for (const double size : {1e-3, 1.0, 1e4}) {
        const Affine map = scaling(Vec3::Constant(size), Vec3(1.0, 2.0, 3.0)) *
                           rotation({0.3, -0.5, 0.8}, 1.1, Vec3::Zero());
        CHECK(flat_vertices(moved(box, map)).size() == 54);
    }
    // All but the four corners of an open sheet, too: its outline bounds a flat face.
    const Mesh sheet = make_grid({.size = {1, 1}, .segments = {3, 3}});
    CHECK(flat_vertices(sheet).size() == 16);
}
