// The box around what is shown, also where a part of it was shown before.
#include "viewer/window/session/snapshot_bounds.h"

#include <doctest/doctest.h>

#include <limits>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;
using namespace lissom::window;

namespace {

bool same_box(const Box& a, const Box& b) {
    return a.min == b.min && a.max == b.max;
}

DrawnMesh sphere_at(double x, const std::shared_ptr<const Mesh>& mesh) {
    DrawnMesh drawn{mesh};
    drawn.transform = translation({x, 0.0, 0.0});
    return drawn;
}

}  // namespace

TEST_CASE("bounds of a snapshot: as if each were the first, whatever was shown before") {
    const auto one = std::make_shared<const Mesh>(make_sphere());
    Mesh moved = *one;
    for (Vec3& p : moved.edit_positions()) p *= 3.0;
    const auto other = std::make_shared<const Mesh>(moved);
    SnapshotBounds bounds;
    const auto check = [&](const std::vector<DrawnMesh>& meshes) {
        Snapshot snapshot;
        snapshot.meshes = meshes;
        const Box box = bounds.of(snapshot);
        CHECK(same_box(box, SnapshotBounds().of(snapshot)));
        return box;
    };
    CHECK(check({}).empty());
    const Box first = check({sphere_at(0.0, one)});
    CHECK(same_box(check({sphere_at(0.0, one)}), first));
    // Elsewhere, another shape, two of one, and what was there long ago.
    CHECK(check({sphere_at(2.0, one)}).min.x() == doctest::Approx(first.min.x() + 2.0));
    CHECK(check({sphere_at(0.0, other)}).max.y() == doctest::Approx(3.0 * first.max.y()));
    CHECK(check({sphere_at(0.0, one), sphere_at(5.0, one)}).max.x() ==
          doctest::Approx(first.max.x() + 5.0));
    CHECK(same_box(check({sphere_at(0.0, one)}), first));
}

TEST_CASE("bounds of a snapshot: lines and points count, what is not finite does not") {
    Overlay marks;
    marks.lines = {{{Vec3(0, 0, 0), Vec3(1, 2, 3)}}};
    marks.points = {{Vec3(-1, 0, 0)}, {Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)}};
    Snapshot snapshot;
    snapshot.overlays = {std::make_shared<const Overlay>(marks)};
    const Box box = SnapshotBounds().of(snapshot);
    CHECK(box.min == Vec3(-1, 0, 0));
    CHECK(box.max == Vec3(1, 2, 3));
}
