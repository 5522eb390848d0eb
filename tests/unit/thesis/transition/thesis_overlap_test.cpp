#include "kernel/thesis/transition/thesis_overlap.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

struct OverlapTube {
    Mesh mesh = test::make_tube(32, -2.0, 2.0, 1.0, 16);

    std::vector<Index> top() const {
        return mesh.topology().boundary_loops()[test::boundary_towards(mesh, 1.0)];
    }
    OpenedForOverlap opened(double width) const {
        return open_for_overlap(mesh, std::vector<std::vector<Index>>{top()}, width, {});
    }
    // The vertex of the middle row nearest to the x axis, drawn out.
    Index spike(double length) {
        Index best = 0;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const Vec3 at(1.0, -0.5, 0.0);
            if ((mesh.position(v) - at).norm() < (mesh.position(best) - at).norm()) best = v;
        }
        mesh.set_position(best, mesh.position(best) + Vec3(length, 0.0, 0.0));
        return best;
    }
};

}  // namespace

TEST_CASE("a target without its region ends at the region's far end") {
    const OverlapTube tube;
    const OpenedForOverlap opened = tube.opened(0.99);
    CHECK(opened.mesh.face_count() == 9 * 32);
    REQUIRE(opened.loops.size() == 1);
    CHECK(opened.loops[0].size() == 32);
    for (std::size_t k = 0; k < 32; ++k) {
        const Index v = opened.loops[0][k];
        CHECK(opened.mesh.position(v).y() == doctest::Approx(-0.875));
        CHECK(opened.whole.vertex_of[v] == opened.whole.ends[0][k]);
        CHECK(opened.map.vertices.main_source(v) == opened.whole.ends[0][k]);
    }
    for (Index f = 0; f < opened.mesh.face_count(); ++f) {
        const Index from = opened.map.faces.main_source(f);
        const std::span<const Index> face = opened.mesh.topology().face(f);
        const std::span<const Index> old = tube.mesh.topology().face(from);
        const Index corner = opened.mesh.topology().first_corner(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            CHECK(opened.whole.vertex_of[face[k]] == old[k]);
            CHECK(opened.map.corners.main_source(corner + static_cast<Index>(k)) ==
                  tube.mesh.topology().first_corner(from) + static_cast<Index>(k));
        }
    }
}

TEST_CASE("what a region encloses goes with it") {
    OverlapTube tube;
    const Index tip = tube.spike(3.0);
    const OpenedForOverlap opened = tube.opened(0.99);
    // The way around the spike is longer: in its column the region ends a row earlier.
    CHECK(opened.mesh.face_count() == 9 * 32 + 2);
    CHECK(opened.mesh.topology().component_count() == 1);
    const std::vector<Index>& left = opened.whole.vertex_of;
    CHECK(std::find(left.begin(), left.end(), tip) == left.end());
}

TEST_CASE("regions that are no bands, or meet, are refused") {
    const OverlapTube tube;
    CHECK(test::error_of([&] { tube.opened(0.01); }).code() == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { tube.opened(9.0); }).code() == ErrorCode::invalid_argument);
    const auto& loops = tube.mesh.topology().boundary_loops();
    CHECK(test::error_of([&] { open_for_overlap(tube.mesh, loops, 1.2, {}); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(open_for_overlap(tube.mesh, loops, 0.9, {}).loops.size() == 2);
}
