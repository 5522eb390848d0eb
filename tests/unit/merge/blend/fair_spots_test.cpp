// Places beside a seam at which a side crumpled are faired, and no others.
#include "kernel/merge/blend/fair_spots.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/merge/loop/crumpled_edges.h"
#include "kernel/mesh/query/distances.h"
#include "tests/unit/merge/seam_column.h"
#include "tests/unit/mesh/morph_support.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A column whose upper half was sewn to the lower one, and both at rest.
struct SewnColumn : SeamColumn {
    SewnColumn() : SeamColumn(48, 60) {}

    Sewn sewn(Mesh made) const {
        Sewn result;
        result.mesh = std::move(made);
        result.seams = {seam};
        result.side_of_face.assign(at(mesh.face_count()), SeamSide::target);
        for (const Index f : above) result.side_of_face[at(f)] = SeamSide::source;
        return result;
    }
    double crumpled(const Mesh& made) const {
        const std::vector<double> distance = edge_distances(made, seam, 1.0, {});
        return crumpled_length({made, above, seam, distance, 1.0}, mesh.positions()) +
               crumpled_length({made, below, seam, distance, 1.0}, mesh.positions());
    }
    SpotFairing at_rest() const { return {mesh.positions(), mesh.positions()}; }
    // Dimples all around, .2 above the seam or below it.
    Mesh dimpled(double height, double depth) const {
        return moved([&](Vec3& p) {
            const double around = std::cos(6.0 * std::atan2(p.x(), p.z()));
            const double up = std::exp(-std::pow((p.y() - height) / 0.06, 2.0));
            const double out = 1.0 - depth * std::max(0.0, around - 0.9) * 10.0 * up;
            p = Vec3(out * p.x(), p.y(), out * p.z());
        });
    }
};

// The greatest distance from the cylinder.
double depth_of(const Mesh& mesh) {
    double greatest = 0.0;
    for (const Vec3& p : mesh.positions()) {
        if (std::abs(p.y()) > 1.0) continue;
        greatest = std::max(greatest, std::abs(std::hypot(p.x(), p.z()) - 1.0));
    }
    return greatest;
}

}  // namespace

TEST_CASE("pits of either side are faired, and the surface goes on as around them") {
    const SewnColumn column;
    for (const double height : {0.2, -0.2}) {
        const Mesh pitted = column.dimpled(height, 0.08);
        REQUIRE(column.crumpled(pitted) > 0.5);
        Sewn sewn = column.sewn(pitted);
        REQUIRE(fair_spots(sewn, column.at_rest(), {}));
        CHECK(column.crumpled(sewn.mesh) == 0.0);
        CHECK(depth_of(sewn.mesh) < 0.25 * depth_of(pitted));
        // Away from them every vertex stays to the bit.
        for (Index v = 0; v < pitted.vertex_count(); ++v) {
            if (std::abs(pitted.position(v).y() - height) < 0.6) continue;
            CHECK(sewn.mesh.position(v) == pitted.position(v));
        }
    }
}

TEST_CASE("relief that was there at rest stays, and so do parts that fit and firm vertices") {
    const SewnColumn column;
    const Mesh pitted = column.dimpled(0.2, 0.08);
    const auto stays = [&](Sewn sewn, const SpotFairing& how) {
        const bool changed = fair_spots(sewn, how, {});
        return !changed && std::ranges::equal(sewn.mesh.positions(), pitted.positions());
    };
    CHECK(stays(column.sewn(pitted), {pitted.positions(), pitted.positions()}));
    Sewn fitting = column.sewn(pitted);
    fitting.kept = {1};
    CHECK(stays(std::move(fitting), column.at_rest()));
    SpotFairing firm = column.at_rest();
    for (Index v = 0; v < pitted.vertex_count(); ++v) firm.firm.push_back(v);
    CHECK(stays(column.sewn(pitted), firm));
    // Vertices of unknown origin are on neither side.
    const std::vector<Vec3> unknown(at(pitted.vertex_count()), Vec3::Constant(NAN));
    CHECK(stays(column.sewn(pitted), {unknown, unknown}));
}

TEST_CASE("fairing is the same wherever the mesh lies, and morph targets follow it") {
    const SewnColumn column;
    Mesh pitted = column.dimpled(0.2, 0.08);
    add_telling_targets(pitted);
    Sewn plain = column.sewn(pitted);
    REQUIRE(fair_spots(plain, column.at_rest(), {}));
    CHECK(departure(plain.mesh) < 1e-9);
    const auto placed = [](const Vec3& p) {
        return Vec3(100.0 * p.z() + 3e3, 100.0 * p.x(), 100.0 * p.y());
    };
    Mesh far = pitted;
    for (Vec3& p : far.edit_positions()) p = placed(p);
    Sewn moved = column.sewn(far);
    REQUIRE(fair_spots(moved, column.at_rest(), {}));
    for (Index v = 0; v < far.vertex_count(); ++v) {
        CHECK((moved.mesh.position(v) - placed(plain.mesh.position(v))).norm() < 1e-6);
    }
}
