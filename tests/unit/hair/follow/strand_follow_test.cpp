#include "kernel/hair/follow/strand_follow.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/mesh/edit/transform.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/style_scenes.h"

namespace lissom::test {
namespace {

// Strands that leave the skin for five millimetres, and then lie along it to the back and down.
Strands combed_hair(Index count, Index points = 14) {
    const std::vector<Root> roots = make_roots(small_head(), *small_scalp(), {.count = count});
    const SpatialTree& tree = small_scalp()->tree();
    std::vector<float> numbers;
    std::vector<Index> offsets = {0};
    for (const Root& root : roots) {
        Vec3 p = root.position;
        for (Index k = 0; k < points; ++k) {
            for (const double x : p) numbers.push_back(static_cast<float>(x));
            p += Vec3(0, -0.006, -0.008);
            const SurfacePoint foot = tree.nearest(p);
            const Vec3 normal = small_scalp()->normal_at(foot.triangle, foot.barycentric);
            if (normal.dot(p - foot.position) < 0.004) p = foot.position + 0.004 * normal;
        }
        offsets.push_back(offsets.back() + points);
    }
    Strands hair(std::move(numbers), std::move(offsets));
    hair.set_roots(roots_on(small_head(), roots));
    hair.set_groups(std::vector<Index>(roots.size(), 0), {"crown"});
    std::vector<std::uint32_t> ids;
    for (std::size_t s = 0; s < roots.size(); ++s) {
        ids.push_back(static_cast<std::uint32_t>(100 + 3 * s));
    }
    hair.set_guides({ids, std::vector<float>(roots.size(), 0.1f)});
    hair.set_ids(ids);
    return hair;
}

// The head leans to the side over its neck, and its skull grows.
Mesh leaning(double degrees, double growth) {
    Mesh head = small_head();
    for (Vec3& p : head.edit_positions()) {
        const double up = std::clamp((p.y() + 0.14) / 0.14, 0.0, 1.0);
        const double share = up * up * (3.0 - 2.0 * up);
        const Vec3 pivot(0, -0.1, -0.02);
        const Eigen::AngleAxisd turn(share * degrees * kDegree, Vec3(1, 0, 0.8).normalized());
        p = pivot + (1.0 + share * growth) * (turn * (p - pivot));
    }
    return head;
}

Affine some_similarity(double scale) {
    const Eigen::AngleAxisd turn(0.8, Vec3(1, 2, -1).normalized());
    return {scale * turn.toRotationMatrix(), Vec3(0.3, -0.2, 0.5)};
}

double farthest(const Strands& a, const Strands& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.points().size(); ++i) {
        most = std::max(most, std::abs(double{a.points()[i]} - double{b.points()[i]}));
    }
    return most;
}

double length_of(const Strands& hair, Index s) {
    double sum = 0.0;
    for (Index k = 1; k < hair.point_count(s); ++k) {
        sum += (point_of(hair.strand(s), k) - point_of(hair.strand(s), k - 1)).norm();
    }
    return sum;
}

Strands followed(const Strands& hair, const Mesh& head, const FollowOptions& options = {}) {
    return StrandFollower(hair, small_head(), options).follow(head);
}

Index points_inside(const Strands& hair, const Mesh& head, double deep) {
    const SpatialTree tree(head);
    const WindingNumber winding(head);
    Index inside = 0;
    for (Index s = 0; s < hair.size(); ++s) {
        for (Index k = 1; k < hair.point_count(s); ++k) {
            const Vec3 p = point_of(hair.strand(s), k);
            if (tree.nearest(p).distance > deep && winding(p) > 0.5) ++inside;
        }
    }
    return inside;
}

ErrorCode code_of_follow(const Strands& hair, const Mesh& rest, const Mesh& head) {
    try {
        StrandFollower(hair, rest).follow(head);
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

TEST_CASE("follow: on the head at rest strands stay to the bit") {
    const Strands hair = combed_hair(200);
    const Strands same = followed(hair, small_head());
    CHECK(std::equal(hair.points().begin(), hair.points().end(), same.points().begin()));
}

TEST_CASE("follow: strands move, turn and grow with the whole head") {
    const Strands hair = combed_hair(200);
    for (const double scale : {1.0, 0.6, 1.7}) {
        const Affine map = some_similarity(scale);
        Strands expected = hair;
        transform(expected, map);
        for (const FollowCollision collision :
             {FollowCollision::none, FollowCollision::near, FollowCollision::all}) {
            const Strands made = followed(hair, moved(small_head(), map), {.collision = collision});
            CHECK(farthest(made, expected) < 2e-6);
            CHECK(std::abs(made.widths().common / expected.widths().common - 1.0f) < 1e-5f);
        }
    }
}

TEST_CASE(
    "follow: neighbours may have different numbers of points, as blocks of them move together") {
    const Strands hair = combed_hair(600);
    // Every other point of some: they have their course.
    std::vector<float> numbers;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < hair.size(); ++s) {
        const StrandView strand = hair.strand(s);
        const Index step = 1 + s % 3;
        for (Index k = 0; k < index_of(strand.cols()); ++k) {
            if (k % step != 0 && k + 1 < index_of(strand.cols())) continue;
            for (int c = 0; c < 3; ++c) numbers.push_back(strand(c, k));
        }
        offsets.push_back(index_of(numbers.size() / 3));
    }
    Strands mixed(std::move(numbers), std::move(offsets));
    mixed.set_roots(hair.roots());
    const Affine map = some_similarity(1.2);
    Strands expected = mixed;
    transform(expected, map);
    CHECK(farthest(followed(mixed, moved(small_head(), map)), expected) < 2e-6);
    const Strands bent = followed(mixed, leaning(25, 0.0), {.collision = FollowCollision::none});
    for (Index s = 0; s < mixed.size(); ++s) {
        CHECK(std::abs(length_of(bent, s) / length_of(mixed, s) - 1.0) < 0.01);
    }
}

TEST_CASE("follow: a similarity after a deformation gives the similarity of the strands") {
    const Strands hair = combed_hair(200);
    const Mesh bent = leaning(25, 0.12);
    const Affine map = some_similarity(1.3);
    Strands expected = followed(hair, bent);
    transform(expected, map);
    CHECK(farthest(followed(hair, moved(bent, map)), expected) < 2e-5);
}

TEST_CASE("follow: roots lie on their places, lengths stay, and nothing goes inside") {
    const Strands hair = combed_hair(300);
    const Mesh bent = leaning(28, 0.16);
    REQUIRE(points_inside(hair, small_head(), 2e-4) == 0);
    for (const FollowCollision collision : {FollowCollision::near, FollowCollision::all}) {
        const Strands made = followed(hair, bent, {.collision = collision});
        double worst = 0.0;
        for (Index s = 0; s < made.size(); ++s) {
            const Vec3 place = *root_place(made.roots(), s, bent);
            CHECK((made.root(s).cast<double>() - place).norm() < 1e-6);
            worst = std::max(worst, std::abs(length_of(made, s) / length_of(hair, s) - 1.0));
        }
        CHECK(worst < 0.01);
        CHECK(points_inside(made, bent, 2e-4) == 0);
    }
}

TEST_CASE("follow: short hair turns with the skin at its root") {
    const Strands hair = combed_hair(200, 4);
    const Affine turned = {Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero()};
    // All above the neck turns; the rest stays.
    Mesh head = small_head();
    for (Vec3& p : head.edit_positions()) {
        if (p.y() > -0.09) p = turned(p);
    }
    const Strands made = followed(hair, head, {.collision = FollowCollision::none});
    Index looked_at = 0;
    for (Index s = 0; s < hair.size(); ++s) {
        if (hair.root(s).y() < 0.02f) continue;
        ++looked_at;
        const Vec3 tip = turned(point_of(hair.strand(s), 3));
        CHECK((point_of(made.strand(s), 3) - tip).norm() < 5e-4);
    }
    CHECK(looked_at > 100);
}

TEST_CASE("follow: everything that strands hold is kept") {
    const Strands hair = combed_hair(50);
    const Strands made = followed(hair, leaning(10, 0.0));
    CHECK(made.ids() == hair.ids());
    CHECK(made.guides() == hair.guides());
    CHECK(made.groups() == hair.groups());
    CHECK(made.group_names() == hair.group_names());
    CHECK(made.widths().common == hair.widths().common);
    CHECK(made.roots().triangles == hair.roots().triangles);
}

TEST_CASE("follow: threads and frames before do not matter") {
    const Strands hair = combed_hair(400);
    const Mesh bent = leaning(20, 0.1), other = leaning(-15, 0.0);
    const Strands alone = followed(hair, bent);
    const Context three = threads(3);
    StrandFollower follower(hair, small_head(), {}, three);
    follower.follow(other, three);
    std::vector<float> points(hair.points().size());
    follower.move(bent.positions(), points, three);
    CHECK(std::equal(points.begin(), points.end(), alone.points().begin()));
    follower.move(small_head().positions(), points, three);
    CHECK(std::equal(points.begin(), points.end(), hair.points().begin()));
}

TEST_CASE("follow: strands without a root among others go with the head around them") {
    Strands hair = combed_hair(100);
    StrandRoots roots = hair.roots();
    roots.faces[7] = kNoIndex;
    hair.set_roots(roots);
    const Affine map = some_similarity(1.0);
    const Strands made = followed(hair, moved(small_head(), map));
    const Vec3 expected = map(hair.root(7).cast<double>());
    CHECK((made.root(7).cast<double>() - expected).norm() < 1e-5);
}

TEST_CASE("follow: broken strands go along") {
    Strands hair = combed_hair(20);
    hair.edit_points()[5] = float(kNaN);
    append(hair, Strands({0, 0.2f, 0, 0, 0.2f, 0}, {0, 1, 2}));
    const Strands made = followed(hair, leaning(10, 0.0));
    CHECK(std::isnan(made.points()[5]));
    CHECK(made.strand(made.size() - 1).allFinite());
    CHECK(followed(combed_hair(0), leaning(10, 0.0)).empty());
}

TEST_CASE("follow: misuse is told") {
    const Strands hair = combed_hair(100);
    const Mesh bent = leaning(10, 0.0), other = make_head({.vertices = 4000});
    Strands bald = hair;
    bald.set_roots({});
    CHECK(code_of_follow(bald, small_head(), bent) == ErrorCode::invalid_argument);
    CHECK(code_of_follow(hair, small_head(), other) == ErrorCode::topology_mismatch);
    CHECK(code_of_follow(hair, other, other) == ErrorCode::invalid_argument);
    CHECK(code_of_follow(hair, small_head(), moved(small_head(), scaling({-1, 1, 1}, {0, 0, 0}))) ==
          ErrorCode::invalid_argument);
    CHECK(code_of_follow(hair, small_head(), moved(small_head(), scaling({0, 0, 0}, {0, 0, 0}))) ==
          ErrorCode::invalid_argument);
    StrandFollower follower(hair, small_head());
    std::vector<Vec3> positions(bent.positions().begin(), bent.positions().end());
    std::vector<float> points(hair.points().size(), 7.0f);
    positions[3].y() = kNaN;
    CHECK_THROWS_AS(follower.move(positions, points), Error);
    CHECK_THROWS_AS(follower.move(std::span(positions).first(5), points), Error);
    CHECK_THROWS_AS(follower.move(bent.positions(), std::span(points).first(5)), Error);
    CHECK(points[0] == 7.0f);
    CHECK_THROWS_AS(StrandFollower(hair, small_head(), {.scale = 0.0}), Error);
    CHECK_THROWS_AS(StrandFollower(hair, small_head(), {.ramp = kNaN}), Error);
}

}  // namespace
}  // namespace lissom::test
