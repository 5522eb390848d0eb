#include "kernel/hair/transfer/strand_transfer.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/style_scenes.h"

namespace lissom::test {
namespace {

// Strands that leave the skin along its normal and bend to the back.
Strands hair_to_transfer(Index count) {
    const std::vector<Root> roots = make_roots(small_head(), *small_scalp(), {.count = count});
    const double unit = small_scalp()->unit();
    std::vector<float> numbers;
    std::vector<Index> offsets = {0};
    for (const Root& root : roots) {
        Vec3 p = root.position * unit;
        Vec3 direction = small_scalp()->normal_at(root.triangle, root.barycentric);
        for (Index k = 0; k < 10; ++k) {
            for (const double x : p) numbers.push_back(static_cast<float>(x));
            p += 0.006 * direction;
            direction = (direction + Vec3(0, -0.06, -0.08)).normalized();
        }
        offsets.push_back(offsets.back() + 10);
    }
    Strands hair(std::move(numbers), std::move(offsets));
    hair.set_roots(roots_on(small_head(), roots));
    hair.set_groups(std::vector<Index>(roots.size(), 0), {"crown"});
    return hair;
}

double farthest_point(const Strands& a, const Strands& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.points().size(); ++i) {
        most = std::max(most, std::abs(double{a.points()[i]} - double{b.points()[i]}));
    }
    return most;
}

double strand_length(const Strands& hair, Index s) {
    double sum = 0.0;
    for (Index k = 1; k < hair.point_count(s); ++k) {
        sum += (point_of(hair.strand(s), k) - point_of(hair.strand(s), k - 1)).norm();
    }
    return sum;
}

// The same head with other faces and another shape.
Mesh other_head(const Vec3& scale) {
    Mesh head = make_head({.vertices = 3000});
    for (Vec3& p : head.edit_positions()) p = p.cwiseProduct(scale);
    return head;
}

Strands transferred_to(const Strands& hair, const Mesh& head, const TransferOptions& options = {}) {
    const Scalp scalp(head);
    return transferred(hair, {small_head(), *small_scalp()}, {head, scalp}, options);
}

}  // namespace

TEST_CASE("transfer: onto the same head hair stays as it is") {
    const Strands hair = hair_to_transfer(200);
    const Strands same = transferred_to(hair, small_head());
    CHECK(farthest_point(hair, same) < 1e-5);
    CHECK(same.group_names() == hair.group_names());
    for (Index s = 0; s < hair.size(); ++s) {
        const auto place = root_place(same.roots(), s, small_head());
        REQUIRE(place);
        CHECK((*place * small_scalp()->unit() - point_of(same.strand(s), 0)).norm() < 1e-5);
    }
}

TEST_CASE("transfer: a head that was turned, moved and scaled takes its hair along") {
    const Strands hair = hair_to_transfer(200);
    const Eigen::AngleAxisd turn(0.5, Vec3(0.2, 1, 0.1).normalized());
    const Affine map{1.2 * turn.toRotationMatrix(), Vec3(0.4, -0.1, 0.2)};
    const Mesh head = moved(small_head(), map);
    ScalpOptions hints;
    hints.hints.up = turn * small_scalp()->frame().up();
    hints.hints.front = turn * small_scalp()->frame().front();
    hints.unit = small_scalp()->unit();
    const Scalp scalp(head, hints);
    const Strands made =
        transferred(hair, {small_head(), *small_scalp()}, {head, scalp}, {.scale = 1.2});
    Strands expected = hair;
    transform(expected, map);
    CHECK(farthest_point(made, expected) < 1e-3);
    CHECK(made.widths().common == hair.widths().common);
}

TEST_CASE("transfer: on a head of other faces and shape roots lie on its skin, lengths are kept") {
    const Strands hair = hair_to_transfer(300);
    const Mesh head = other_head(Vec3(0.9, 1.1, 1.05));
    const Scalp scalp(head);
    const Strands made = transferred_to(hair, head, {.scale = 1.0});
    REQUIRE(made.size() == hair.size());
    const SpatialTree tree(head);
    const WindingNumber winding(head);
    double longest = 0.0, apart = 0.0;
    for (Index s = 0; s < made.size(); ++s) {
        const auto place = root_place(made.roots(), s, head);
        REQUIRE(place);
        CHECK((*place * scalp.unit() - point_of(made.strand(s), 0)).norm() < 1e-5);
        longest = std::max(longest, std::abs(strand_length(made, s) / strand_length(hair, s) - 1));
        const Vec3 now = scalp.to_metres(point_of(made.strand(s), 0) / scalp.unit());
        const Vec3 was =
            small_scalp()->to_metres(point_of(hair.strand(s), 0) / small_scalp()->unit());
        apart = std::max(apart, std::acos(now.normalized().dot(was.normalized())));
        for (Index k = 1; k < made.point_count(s); ++k) {
            const Vec3 p = point_of(made.strand(s), k) / scalp.unit();
            CHECK((winding(p) < 0.5 || tree.nearest(p).distance * scalp.unit() < 2e-4));
        }
    }
    CHECK(longest < 0.03);
    // Roots keep their directions.
    CHECK(apart < 6.0 * kDegree);
}

TEST_CASE("transfer: hair without roots and bad options are refused") {
    const Strands hair = hair_to_transfer(20);
    Strands rootless = hair;
    rootless.set_roots({});
    const auto code = [&](const Strands& strands, const TransferOptions& options) {
        try {
            transferred_to(strands, small_head(), options);
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::internal;
    };
    CHECK(code(rootless, {}) == ErrorCode::invalid_argument);
    for (const double bad : {0.0, -1.0, kNaN, 1.0 / 0.0}) {
        CHECK(code(hair, {.scale = bad}) == ErrorCode::invalid_argument);
    }
    CHECK(code(hair, {.clearance = -1.0}) == ErrorCode::invalid_argument);
    CHECK(code(hair, {.clearance = kNaN}) == ErrorCode::invalid_argument);
    const Mesh head = other_head(Vec3::Ones());
    CHECK_THROWS_AS(transferred(hair, {small_head(), *small_scalp()}, {head, *small_scalp()}),
                    Error);
}

}  // namespace lissom::test
