// The shell of hair, and silhouettes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/levels/hair_shell.h"
#include "kernel/hair/levels/hair_silhouette.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_selection.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/strands/strand_support.h"

namespace lissom::test {
namespace {

constexpr double kInner = 0.05, kOuter = 0.09;

// Strands straight out of a ball, or of its upper half, in all directions alike.
Strands radial_hair(Index count, bool upper_half = false) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double y = upper_half ? (s + 0.5) / count : 1.0 - 2.0 * (s + 0.5) / count;
        const double turn = 2.399963229728653 * s, across = std::sqrt(1.0 - y * y);
        const Vec3 direction(across * std::cos(turn), y, across * std::sin(turn));
        std::vector<Vec3> list;
        for (int k = 0; k < 8; ++k) {
            list.push_back((kInner + k / 7.0 * (kOuter - kInner)) * direction);
        }
        lists.push_back(list);
    }
    Strands hair = strands_of(lists);
    hair.set_colors({Eigen::Vector3f(0.6f, 0.4f, 0.2f)});
    return hair;
}

double distance_to_ball(const Vec3& p) {
    return p.norm() - kInner;
}

// Parallel strands 1 mm apart and wide: a board of 0.1 x 0.1 metres, `x` to the right.
Strands board(double x, Index count = 101, float width = 0.001f) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double at = x + 0.1 * s / (count - 1);
        lists.push_back({Vec3(at, 0, 0), Vec3(at, 0.05, 0), Vec3(at, 0.1, 0)});
    }
    Strands hair = strands_of(lists);
    StrandWidths widths;
    widths.common = width;
    hair.set_widths(widths);
    return hair;
}

template <typename Action>
ErrorCode code_of_level(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("shell: around hair in all directions it is closed, and as large as the hair") {
    const Strands hair = radial_hair(6000);
    const Mesh shell = make_shell(hair, {.triangles = 1500});
    CHECK(shell.face_count() <= 1510);
    CHECK(shell.face_count() > 700);
    for (const Vec3& p : shell.positions()) {
        CHECK(p.norm() < kOuter + 0.008);
        CHECK(p.norm() > 0.02);
    }
    CHECK(shell.topology().is_closed());
}

TEST_CASE("shell: with a head there is nothing under the hair, and nothing in the head") {
    const Strands hair = radial_hair(6000);
    const Mesh shell =
        make_shell(hair, {.triangles = 1500, .clearance = 0.002, .distance = distance_to_ball});
    for (const Vec3& p : shell.positions()) {
        CHECK(p.norm() > kOuter - 0.02);
        CHECK(p.norm() < kOuter + 0.008);
    }
    CHECK(volume(shell) > 4.0 / 3.0 * kPi * std::pow(kOuter - 0.008, 3));
    const Mesh half =
        make_shell(radial_hair(3000, true),
                   {.triangles = 800, .clearance = 0.002, .distance = distance_to_ball});
    CHECK_FALSE(half.topology().is_closed());
    for (const Vec3& p : half.positions()) {
        CHECK(p.norm() > kInner + 0.0015);
        // The bare lower half of the ball has no surface.
        CHECK(p.y() > -0.02);
    }
}

TEST_CASE("shell: it grows with the hair and its cell, and moves with it by whole cells") {
    const Strands hair = radial_hair(3000);
    const Mesh one = make_shell(hair, {.triangles = 500});
    Strands twice = hair;
    transform(twice, {2.0 * Mat3::Identity(), Vec3(1, 2, 3)});
    const Mesh two = make_shell(twice, {.triangles = 500, .cell = 0.01});
    REQUIRE(one.face_count() == two.face_count());
    CHECK(std::abs(volume(two) / volume(one) - 8.0) < 0.1);
}

TEST_CASE("shell: colours are those of the hair, and darker inside") {
    const Mesh shell = make_shell(radial_hair(4000), {.triangles = 600});
    const Attribute* const color = shell.attributes().find("color");
    const Attribute* const normal = shell.attributes().find("normal");
    REQUIRE(color);
    REQUIRE(normal);
    for (Index v = 0; v < shell.vertex_count(); ++v) {
        const auto c = color->at(v), n = normal->at(v);
        CHECK(c[0] <= 0.6 + 1e-3);
        CHECK(std::abs(c[1] - c[0] / 1.5) < 1e-3);
        CHECK(std::abs(c[2] - c[0] / 3.0) < 1e-3);
        CHECK(std::abs(Vec3(n[0], n[1], n[2]).norm() - 1.0) < 1e-5);
    }
    Strands uncolored = strands_of({{Vec3(0, 0, 0), Vec3(0, 0.01, 0)}});
    CHECK(make_shell(uncolored, {.triangles = 50}).attributes().find("color") == nullptr);
}

TEST_CASE("shell: a strand apart from the others is outside") {
    Strands hair = radial_hair(6000);
    append(hair, strands_of({{Vec3(0.2, 0, 0), Vec3(0.2, 0.1, 0)}}));
    for (const Vec3& p : make_shell(hair).positions()) CHECK(p.x() < 0.12);
}

TEST_CASE("shell: bad options and hair without length are refused") {
    const Strands hair = radial_hair(100);
    for (const ShellOptions& bad : {ShellOptions{.triangles = 3}, ShellOptions{.cell = 0.0},
                                    ShellOptions{.cell = kNaN}, ShellOptions{.level = 0.0},
                                    ShellOptions{.level = 1.0}, ShellOptions{.clearance = -1.0}}) {
        CHECK(code_of_level([&] { make_shell(hair, bad); }) == ErrorCode::invalid_argument);
    }
    CHECK(code_of_level([] { make_shell({}); }) == ErrorCode::invalid_argument);
    CHECK(code_of_level([] { make_shell(strands_of({{Vec3(1, 2, 3)}})); }) ==
          ErrorCode::invalid_argument);
    const Strands broken = strands_of({{Vec3(0, 0, 0), Vec3(0, kNaN, 0)}});
    CHECK(code_of_level([&] { make_shell(broken); }) == ErrorCode::not_finite);
    // Hair as large as a house takes a larger cell, and no more memory.
    CHECK(make_shell(strands_of({{Vec3(0, 0, 0), Vec3(100, 90, 80)}})).face_count() > 0);
}

TEST_CASE("silhouette: equal hair has no error, and half of it one of a half") {
    Strands both = board(-0.15);
    append(both, board(0.05));
    const HairSilhouette all(both, {.views = 1});
    CHECK(all.compare(both).worst == 0.0);
    const SilhouetteError half = all.compare(board(0.05));
    CHECK(std::abs(half.mean - 0.5) < 0.02);
    CHECK(std::abs(half.worst - 0.5) < 0.02);
}

TEST_CASE("silhouette: fewer strands need their width") {
    const HairSilhouette all(board(0.0), {.views = 1});
    const Strands few = board(0.0, 51);
    CHECK(all.compare(few, 2.0).mean < 0.05);
    CHECK(all.compare(few, 0.5).mean > 0.5);
}

TEST_CASE("silhouette: a surface as large as the hair has a small error") {
    const HairSilhouette all(board(0.0), {.views = 1});
    FaceList faces;
    faces.add({0, 1, 2, 3});
    const Mesh sheet({Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.1, 0.1, 0), Vec3(0, 0.1, 0)}, faces);
    CHECK(all.compare(sheet).mean < 0.09);
    const Mesh far({Vec3(1, 0, 0), Vec3(1.1, 0, 0), Vec3(1.1, 0.1, 0), Vec3(1, 0.1, 0)}, faces);
    CHECK(all.compare(far).mean == doctest::Approx(1.0));
    const Strands hair = radial_hair(20000);
    StrandWidths widths;
    widths.common = 0.0005f;
    Strands wide = hair;
    wide.set_widths(widths);
    CHECK(HairSilhouette(wide).compare(make_shell(wide)).mean < 0.15);
}

TEST_CASE("silhouette: cards show the strands of their slots, flat on the card") {
    const Strands hair = radial_hair(2000);
    const HairCards cards = make_cards(hair, {.count = 60, .slots = 20});
    const Strands shown = shown_by(cards, hair);
    const SpatialTree surface(card_mesh(cards, hair));
    Index s = 0;
    for (const Card& card : cards.cards) {
        const Card& drawn = cards.cards[at(cards.slots[at(card.slot)].card)];
        for (std::size_t i = 0; i < drawn.strands.size(); ++i, ++s) {
            REQUIRE(s < shown.size());
            CHECK(shown.point_count(s) == hair.point_count(drawn.strands[i]));
            for (Index k = 0; k < shown.point_count(s); ++k) {
                CHECK(surface.nearest(point_of(shown.strand(s), k)).distance < 0.003);
            }
        }
    }
    CHECK(s == shown.size());
    Strands wide = hair;
    StrandWidths widths;
    widths.common = 0.002f;
    wide.set_widths(widths);
    const HairSilhouette all(wide, {.views = 2});
    CHECK(all.compare(cards, wide).mean == all.compare(shown_by(cards, wide)).mean);
}

TEST_CASE("silhouette: bad options and hair that covers nothing are refused") {
    for (const SilhouetteOptions& bad :
         {SilhouetteOptions{.views = 0}, SilhouetteOptions{.views = 65},
          SilhouetteOptions{.pixel = 0.0}, SilhouetteOptions{.pixel = kNaN}}) {
        CHECK(code_of_level([&] { HairSilhouette(board(0.0), bad); }) ==
              ErrorCode::invalid_argument);
    }
    CHECK(code_of_level([] { HairSilhouette(strands_of({})); }) == ErrorCode::invalid_argument);
    CHECK(code_of_level([] { HairSilhouette(board(0.0, 3, 1e-6f)); }) ==
          ErrorCode::invalid_argument);
    const HairSilhouette all(board(0.0), {.views = 1});
    CHECK(code_of_level([&] { all.compare(board(0.0), 0.0); }) == ErrorCode::invalid_argument);
}

}  // namespace lissom::test
