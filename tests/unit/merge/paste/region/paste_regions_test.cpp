// The regions of a paste: cleaned, or refused with what to change.
#include "kernel/merge/paste/region/paste_regions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/merge/piece/face_set.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

PasteRegions regions_of(const Mesh& mesh, const Region& region,
                        const std::optional<Region>& feature = std::nullopt) {
    return paste_regions(mesh, {region, feature, 0.5, true}, {});
}

void check_annulus(const Mesh& mesh, const PasteRegions& regions) {
    const FaceSet ring(mesh.topology(), regions.ring);
    CHECK(ring.euler_characteristic() == 0);
    CHECK(ring.loops().size() == 2);
    CHECK(regions.ring.size() + regions.feature.size() == regions.region.size());
}

}  // namespace

TEST_CASE("paste regions: a feature is found, and the ring around it is an annulus") {
    const Mesh mesh = horned_ball();
    check_annulus(mesh, regions_of(mesh, around_horn(mesh)));
    check_annulus(mesh, regions_of(mesh, around_horn(mesh), around_horn(mesh, 0.6)));
}

TEST_CASE(
    "paste regions: the outlines around both feet of an arch become one, with what they hold") {
    const Mesh torus = make_torus();
    const Region arch = select_plane(torus, {0, 0, 0}, {1, 0, 0});
    for (const std::optional<Region>& feature :
         {std::optional<Region>(), std::optional(select_plane(torus, {0.5, 0, 0}, {1, 0, 0}))}) {
        const PasteRegions joined = regions_of(torus, arch, feature);
        check_annulus(torus, joined);
        CHECK(joined.joined);
        const FaceSet region(torus.topology(), joined.region),
            inner(torus.topology(), joined.feature);
        for (const Index f : arch.faces()) CHECK(region.contains(f));
        // A handle on a disk, and surface left around it.
        for (const FaceSet* set : {&region, &inner}) {
            CHECK(set->loops().size() == 1);
            CHECK(set->euler_characteristic() == -1);
        }
        CHECK(region.size() < 3 * torus.face_count() / 4);
        if (!feature) continue;
        for (const Index f : feature->faces()) CHECK(inner.contains(f));
    }
    const Mesh plate = arched_plate();
    const PasteRegions between = regions_of(plate, around_arch(plate));
    check_annulus(plate, between);
    CHECK(between.joined);
    // The plate far beside the feet stays out of it.
    for (const Index f : between.region) {
        CHECK(std::abs(plate.position(plate.topology().face(f)[0]).y()) < 0.8);
    }
    const Mesh horn = horned_ball();
    CHECK_FALSE(regions_of(horn, around_horn(horn)).joined);
}

TEST_CASE("paste regions: wherever a piece of a handle is marked, a feature and a ring are found") {
    const Mesh torus = make_torus();
    for (int k = 0; k < 12; ++k) {
        const double angle = k * kPi / 6.0;
        for (const double radius : {1.1, 1.3}) {
            CAPTURE(k);
            CAPTURE(radius);
            const Vec3 middle(std::cos(angle), 0.017 * k, std::sin(angle));
            check_annulus(torus, regions_of(torus, select_sphere(torus, middle, radius)));
        }
    }
}

TEST_CASE("paste regions: specks go, islands are filled, parts of a feature are joined") {
    const Mesh mesh = horned_ball();
    const Region region = around_horn(mesh);
    const Region speck = select_sphere(mesh, {0, -1, 0}, 0.2);
    const Region hole = select_sphere(mesh, {0, 1.9, 0}, 0.15);
    const PasteRegions plain = regions_of(mesh, region, around_horn(mesh, 0.6));
    const PasteRegions holed =
        regions_of(mesh, region.united(speck).minus(hole), around_horn(mesh, 0.6));
    CHECK(holed.region == plain.region);
    const Region sides = select_sphere(mesh, {0.35, 0.95, 0}, 0.15)
                             .united(select_sphere(mesh, {-0.35, 0.95, 0}, 0.15));
    check_annulus(mesh, regions_of(mesh, region, sides));
}

TEST_CASE("paste regions: other parts of a mesh count as nothing, however large they are") {
    Mesh beside = make_sphere({1.0, 60, SphereKind::triangles});
    transform(beside, translation({10, 0, 0}));
    Mesh source = horned_ball(), target = egg();
    const std::vector<Index> disk =
        disk_around(target, SpatialTree(target).nearest({0, 2, 0}), 0.8, {});
    const PasteRegions alone = regions_of(source, around_horn(source));
    append(source, beside);
    append(target, beside);
    CHECK(disk_around(target, SpatialTree(target).nearest({0, 2, 0}), 0.8, {}) == disk);
    const PasteRegions both = regions_of(source, around_horn(source));
    CHECK(both.region == alone.region);
    CHECK(both.feature == alone.feature);
}

TEST_CASE("paste regions: bad ones are refused, with ids") {
    const Mesh mesh = horned_ball(), other = egg();
    const Region region = around_horn(mesh);
    const Error touching = error_of([&] { regions_of(mesh, region, region); });
    CHECK(touching.code() == ErrorCode::boundary_conflict);
    CHECK(!touching.elements().ids.empty());
    CHECK(error_of([&] { regions_of(other, region); }).code() == ErrorCode::topology_mismatch);
    CHECK(error_of([&] { regions_of(mesh, Region::none(mesh.shared_topology())); }).code() ==
          ErrorCode::region_empty);
    CHECK(error_of([&] { regions_of(mesh, Region::all(mesh.shared_topology())); }).code() ==
          ErrorCode::region_empty);
    CHECK(error_of([&] {
              regions_of(mesh, region, select_sphere(mesh, {0, -1, 0}, 0.3));
          }).code() == ErrorCode::region_empty);
}

TEST_CASE("paste regions: a ring with a hole or a handle is refused, and its loops are told") {
    // Without the faces in its middle, away from the ring's outlines, a ring has three boundaries.
    const Mesh grid = make_grid({.size = {2, 2}, .segments = {40, 40}});
    const Region region = select_sphere(grid, {0, 0, 0}, 0.9);
    const Region feature = select_sphere(grid, {0, 0, 0}, 0.3);
    std::vector<Index> kept;
    const Region hole = select_sphere(grid, {0.6, 0, 0}, 0.12);
    const std::vector<Index> gone = hole.faces();
    for (Index f = 0; f < grid.face_count(); ++f) {
        if (!std::binary_search(gone.begin(), gone.end(), f)) kept.push_back(f);
    }
    const MeshPart open = extract_faces(grid, kept, {});
    const Error holed = error_of([&] {
        regions_of(open.mesh, select_sphere(open.mesh, {0, 0, 0}, 0.9),
                   select_sphere(open.mesh, {0, 0, 0}, 0.3));
    });
    CHECK(holed.code() == ErrorCode::not_a_disk);
    CHECK(holed.message().find("has 3 boundaries") != std::string::npos);
    CHECK(!holed.elements().ids.empty());
    // The closed grid's ring is an annulus.
    CHECK(!regions_of(grid, region, feature).ring.empty());
    // Between two disks of a torus lie two boundaries and a handle.
    const Mesh torus = make_torus();
    const Error handle = error_of([&] {
        regions_of(torus, select_sphere(torus, {-1.35, 0, 0}, 0.3).inverted(),
                   select_sphere(torus, {1.35, 0, 0}, 0.3));
    });
    CHECK(handle.code() == ErrorCode::not_a_disk);
    CHECK(handle.message().find("has a handle") != std::string::npos);
    CHECK(!handle.elements().ids.empty());
}

TEST_CASE("paste regions: a target region with a hole or a handle is refused") {
    const Mesh torus = make_torus();
    // Half a torus is a band.
    const Error band = error_of([&] {
        target_faces(torus, select_plane(torus, {0, 0, 0}, {1, 0, 0}), {});
    });
    const Error handle = error_of([&] {
        target_faces(torus, select_sphere(torus, {-1.35, 0, 0}, 0.3).inverted(), {});
    });
    const Error closed =
        error_of([&] { target_faces(torus, Region::all(torus.shared_topology()), {}); });
    for (const Error& error : {band, handle, closed}) {
        CHECK(error.code() == ErrorCode::not_a_disk);
        CHECK(error.message().find("must be a disk") != std::string::npos);
        CHECK(!error.elements().ids.empty());
    }
}
