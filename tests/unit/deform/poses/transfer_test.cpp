// Deformation transfer.
#include "kernel/deform/poses/transfer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Bends what stands along y, from -2 to 2, about z, by a total angle.
Mesh arched(const Mesh& mesh, double angle) {
    Mesh result = mesh;
    for (Vec3& p : result.edit_positions()) {
        if (p.y() <= -2.0) continue;
        const double radius = 4.0 / angle;
        const double turn = angle * (std::clamp(p.y(), -2.0, 2.0) + 2.0) / 4.0;
        const Vec3 out(std::cos(turn), std::sin(turn), 0.0), up(-out.y(), out.x(), 0.0);
        const double beyond = p.y() - std::clamp(p.y(), -2.0, 2.0);
        p = Vec3(-radius, -2.0, p.z()) + (radius + p.x()) * out + beyond * up;
    }
    return result;
}

Mesh slim_bar() {
    return make_bar({.width = 0.6, .across = 4, .along = 50});
}

Mesh pipe() {
    return make_cylinder({.radius = 0.3, .height = 5.0, .segments = 20, .rings = 70});
}

std::vector<TransferPair> ends(const Mesh& from, const Mesh& to) {
    return {{from.region("top"), to.region("top")}, {from.region("bottom"), to.region("bottom")}};
}

double farthest(const Mesh& a, const Mesh& b) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

ErrorCode transfer_error(auto&& work) {
    try {
        work();
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("transfer: a mesh gives its pose to itself, exactly") {
    Mesh rest = slim_bar();
    append(rest, make_sphere({.radius = 0.2, .segments = 3}));
    const Mesh posed = arched(rest, 2.5);
    CHECK(farthest(transferred(rest, posed, rest), posed) < 1e-9);
    CHECK(farthest(transferred(rest, rest, rest), rest) == 0.0);
}

TEST_CASE("transfer: a larger mesh elsewhere takes the pose larger there") {
    const Mesh rest = slim_bar(), posed = arched(rest, 2.5);
    Mesh large = rest, expected = posed;
    const Affine map = translation({10.0, 3.0, 0.0}) * scaling(Vec3::Constant(3.0), Vec3::Zero());
    transform(large, map);
    transform(expected, map);
    Mesh result = transferred(rest, posed, large);
    // The part that stays is at its place.
    CHECK(result.position(0) == large.position(0));
    CHECK(farthest(result, expected) < 1e-9);
}

TEST_CASE("transfer: a mesh with other faces takes the pose by its parts") {
    const Mesh rest = slim_bar(), to = pipe();
    for (const double angle : {0.5 * kPi, 1.4 * kPi}) {
        CAPTURE(angle);
        const Mesh result = transferred(rest, arched(rest, angle), to, ends(rest, to));
        CHECK(farthest(result, arched(to, angle)) < 0.05 * surface_radius(to));
    }
}

TEST_CASE("transfer: rest gives rest, and a rigid motion the same turn") {
    const Mesh rest = slim_bar(), to = pipe();
    CHECK(farthest(transferred(rest, rest, to, ends(rest, to)), to) < 1e-9);
    const Affine turn = rotation({1.0, 2.0, 0.5}, 2.0, {1.0, 0.0, 0.0});
    Mesh posed = rest, expected = to;
    transform(posed, turn);
    transform(expected, turn);
    const Mesh result = transferred(rest, posed, to, ends(rest, to));
    CHECK(farthest(result, expected) < 1e-2);
    const Vec3 before = expected.position(5) - expected.position(900);
    CHECK((result.position(5) - result.position(900) - before).norm() < 1e-9);
}

TEST_CASE("transfer: bad input is refused") {
    const Mesh rest = slim_bar(), posed = arched(rest, 1.0), to = pipe();
    const auto error = [&](const Mesh& from_posed, const std::vector<TransferPair>& pairs) {
        return transfer_error([&] { transferred(rest, from_posed, to, pairs); });
    };
    CHECK(error(to, ends(rest, to)) == ErrorCode::topology_mismatch);
    CHECK(error(posed, {}) == ErrorCode::topology_mismatch);
    CHECK(error(posed, {{to.region("top"), to.region("top")}}) == ErrorCode::topology_mismatch);
    const Region none = Region::none(rest.shared_topology());
    CHECK(error(posed, {{none, to.region("top")}}) == ErrorCode::region_empty);
    const TransferPair top{rest.region("top"), to.region("top")};
    CHECK(error(posed, {top, top}) == ErrorCode::invalid_argument);
    CHECK(transfer_error([&] { transferred(Mesh(), Mesh(), Mesh()); }) == ErrorCode::mesh_empty);
    Mesh two = to;
    append(two, make_sphere({.radius = 0.2, .segments = 3}));
    transform(two, translation({9.0, 0.0, 0.0}));
    Mesh apart = to;
    append(apart, two);
    const Region part(apart.shared_topology(), to.region("top").vertices());
    CHECK(transfer_error([&] {
              transferred(rest, posed, apart, {{rest.region("top"), part}});
          }) == ErrorCode::unconstrained);
}
