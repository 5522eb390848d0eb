// The shell of hair, silhouettes, and levels of detail in one call.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/levels/hair_levels.h"
#include "kernel/hair/levels/hair_shell.h"
#include "kernel/hair/levels/hair_silhouette.h"
#include "kernel/hair/levels/spread_order.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
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
    const Mesh shell = make_shell(hair);
    for (const Vec3& p : shell.positions()) CHECK(p.x() < 0.12);
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

TEST_CASE("shell: one very long strand takes the memory that it is charged, and no more") {
    const Strands hair =
        strands_of({{{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0}}, {{0.02, 0, 0}, {0.02, 0.3, -4691663}}});
    ContextOptions options;
    options.memory_limit = 100'000'000;
    CHECK(error_of([&] { make_shell(hair, {}, Context(options)); }).code() ==
          ErrorCode::memory_limit);
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

namespace {

double sum_of_widths(const Strands& strands) {
    double sum = 0.0;
    for (Index s = 0; s < strands.size(); ++s) sum += strands.widths().at(s, 0);
    return sum;
}

// Two boards apart, groups of 300 and of 100 strands.
Strands two_groups() {
    Strands hair = board(-0.3, 300);
    append(hair, board(0.1, 100));
    std::vector<Index> groups(400, 0);
    std::fill(groups.begin() + 300, groups.end(), 1);
    hair.set_groups(std::move(groups), {"left", "right"});
    return hair;
}

std::string message_of_levels(const Strands& hair, const HairLevelOptions& options) {
    try {
        make_hair_levels(hair, options);
    } catch (const Error& error) {
        return error.message();
    }
    return "";
}

}  // namespace

TEST_CASE("spread order: every beginning is as dense as all strands in each part") {
    // Three quarters of the strands, which come first, are rooted in the left half.
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 750; ++s) lists.push_back({Vec3(s / 750.0, 0, 0), Vec3(s / 750.0, 1, 0)});
    for (int s = 0; s < 250; ++s) lists.push_back({Vec3(1.0 + s / 250.0, 0, 0), Vec3(2, 1, 0)});
    const Strands hair = strands_of(lists);
    const std::vector<Index> order = spread_order(hair);
    std::vector<Index> sorted = order, all(1000);
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0);
    CHECK(sorted == all);
    for (const int count : {8, 50, 64, 333, 700}) {
        std::vector<int> found(8);
        for (int i = 0; i < count; ++i) ++found[at(order[at(i)] / 125)];
        for (const int part : found) CHECK(std::abs(part - count / 8.0) <= 0.02 * count + 2.0);
    }
}

TEST_CASE("spread order: the same strands in another order, and broken or no roots") {
    const Strands hair = random_hair(200);
    std::vector<Index> turned(200);
    std::iota(turned.rbegin(), turned.rend(), 0);
    const std::vector<Index> a = spread_order(hair), b = spread_order(select(hair, turned));
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == turned[at(b[i])]);
    CHECK(spread_order({}).empty());
    CHECK(spread_order(strands_of({{Vec3(kNaN, 0, 0)}, {Vec3(1, 2, 3)}})).size() == 2);
}

TEST_CASE("levels: fewer strands are wider, spread, and the beginning of those before") {
    const Strands hair = board(0.0, 400);
    const auto levels = make_hair_levels(
        hair, {.strands = {{.count = 400}, {.screen_size = 0.5, .points = 5}, {.count = 100}}});
    REQUIRE(levels.size() == 3);
    CHECK(levels[0].silhouette.worst == 0.0);
    const Index counts[] = {400, 200, 100};
    for (std::size_t i = 0; i < 3; ++i) {
        const HairLevel& level = levels[i];
        CHECK(level.kind == HairLevelKind::strands);
        CHECK(level.strands.size() == counts[i]);
        CHECK(level.screen_size == doctest::Approx(counts[i] / 400.0));
        CHECK(level.widen == doctest::Approx(400.0 / counts[i]));
        CHECK(sum_of_widths(level.strands) == doctest::Approx(sum_of_widths(hair)));
        CHECK(level.silhouette.mean < 0.06);
        for (Index s = 0; s < counts[i]; ++s) CHECK(level.strands.id(s) == levels[0].strands.id(s));
    }
    CHECK(levels[1].strands.point_count(7) == 5);
    CHECK(levels[2].strands.point_count(7) == 3);
    // The first half of strands that lie side by side covers a half.
    CHECK(HairSilhouette(hair).compare(prefix(hair, 200), 2.0).mean > 0.3);
}

TEST_CASE("levels: a factor of widths of one's own, and a width for silhouettes alone") {
    const Strands thin = board(0.0, 101, 1e-5f);
    CHECK(code_of_level([&] { make_hair_levels(thin, {.strands = {{.count = 50}}}); }) ==
          ErrorCode::invalid_argument);
    const auto levels =
        make_hair_levels(thin, {.strands = {{.count = 51, .widen = 2.0}}, .width = 0.001});
    CHECK(levels[0].strands.widths().common == doctest::Approx(2e-5f));
    CHECK(levels[0].silhouette.mean < 0.06);
}

TEST_CASE("levels: cards and shells are those of their functions") {
    const Strands hair = radial_hair(3000);
    const auto levels = make_hair_levels(hair, {.cards = {{.count = 40, .sections = 5, .slots = 8}},
                                                .shell = ShellOptions{.triangles = 300},
                                                .fit_shell = false,
                                                .width = 0.0005});
    REQUIRE(levels.size() == 2);
    CHECK(levels[0].kind == HairLevelKind::cards);
    Strands full = hair;
    StrandWidths widths;
    widths.common = 0.0005f;
    full.set_widths(widths);
    const CardOptions own{.count = 40, .sections = 5, .slots = 8};
    const HairCards cards = make_cards(full, own);
    const Mesh mesh = card_mesh(cards, full, own);
    CHECK(std::ranges::equal(levels[0].mesh.positions(), mesh.positions()));
    CHECK(levels[0].silhouette.mean == HairSilhouette(full).compare(cards, full).mean);
    CHECK(levels[1].kind == HairLevelKind::shell);
    const Mesh shell = make_shell(full, {.triangles = 300});
    CHECK(std::ranges::equal(levels[1].mesh.positions(), shell.positions()));
    CHECK(levels[1].silhouette.mean == HairSilhouette(full).compare(shell).mean);
    // A detail of a cell of 5 mm is a pixel of 1080.
    const Box box = bounds(hair);
    CHECK(levels[1].screen_size == doctest::Approx((box.max.y() - box.min.y()) / 5.4));
    CHECK(levels[0].screen_size ==
          doctest::Approx((box.max.y() - box.min.y()) / (1080.0 * cards.rms)));
}

TEST_CASE("levels: the density of a shell is fitted to the silhouette of the hair") {
    const Strands hair = two_groups();
    HairLevelOptions options{.shell = ShellOptions{.triangles = 300}, .fit_shell = false};
    const double before = make_hair_levels(hair, options)[0].silhouette.mean;
    options.fit_shell = true;
    const auto fitted = make_hair_levels(hair, options);
    CHECK(fitted[0].silhouette.mean <= before);
    CHECK(fitted[0].silhouette.mean == HairSilhouette(hair).compare(fitted[0].mesh).mean);
}

TEST_CASE("levels: by groups each has its part of the counts, and is measured by itself") {
    const Strands hair = two_groups();
    const HairLevelOptions options{
        .strands = {{.count = 40}}, .cards = {{.count = 8}}, .by_group = true};
    const auto levels = make_hair_levels(hair, options);
    REQUIRE(levels.size() == 4);
    CHECK(levels[0].strands.size() == 30);
    CHECK(levels[1].cards.cards.size() == 6);
    CHECK(levels[2].strands.size() == 10);
    CHECK(levels[3].cards.cards.size() == 2);
    for (std::size_t i = 0; i < 4; ++i) CHECK(levels[i].group == index_of(i / 2));
    const auto right = make_hair_levels(select_group(hair, "right"),
                                        {.strands = {{.count = 10}}, .cards = {{.count = 2}}});
    CHECK(right[0].silhouette.mean == levels[2].silhouette.mean);
    CHECK(right[1].silhouette.mean == levels[3].silhouette.mean);
    // Strands of no group come last.
    Strands some = hair;
    std::vector<Index> groups = hair.groups();
    for (std::size_t s = 0; s < 300; ++s) groups[s] = kNoIndex;
    some.set_groups(std::move(groups), {"left", "right"});
    const auto rest = make_hair_levels(some, options);
    REQUIRE(rest.size() == 4);
    CHECK(rest[0].group == 1);
    CHECK(rest[2].group == kNoIndex);
    CHECK(rest[2].strands.size() == 30);
}

TEST_CASE("levels: the usual ones are seven, from all strands down to a shell") {
    const HairLevelOptions usual = usual_hair_levels();
    CHECK(usual.strands.size() + usual.cards.size() == 6);
    CHECK(usual.shell);
    HairLevelOptions options = usual;
    options.width = 0.001;
    const auto levels = make_hair_levels(radial_hair(1500), options);
    REQUIRE(levels.size() == 7);
    CHECK(levels.back().kind == HairLevelKind::shell);
    for (const HairLevel& level : levels) CHECK(level.silhouette.mean < 0.35);
}

TEST_CASE("levels: budgets of 0 and of ten million, no levels and no hair are refused") {
    const Strands hair = board(0.0);
    const HairLevelOptions bad[] = {
        {},
        {.strands = {{}}},
        {.strands = {{.count = 10'000'000}}},
        {.strands = {{.count = -1}}},
        {.strands = {{.count = 5, .screen_size = 0.5}}},
        {.strands = {{.screen_size = 1.5}}},
        {.strands = {{.screen_size = kNaN}}},
        {.strands = {{.count = 5, .points = 1}}},
        {.strands = {{.count = 5, .widen = -1.0}}},
        {.strands = std::vector<StrandLevelOptions>(9, {.count = 5})},
        {.cards = {{.count = 0}}},
        {.cards = {{.count = 10'000'000}}},
        {.shell = ShellOptions{.triangles = 0}},
        {.shell = ShellOptions{.triangles = 10'000'000}},
        {.strands = {{.count = 5}}, .width = kNaN},
    };
    for (const HairLevelOptions& options : bad) {
        CHECK(code_of_level([&] { make_hair_levels(hair, options); }) ==
              ErrorCode::invalid_argument);
    }
    CHECK(message_of_levels(hair, bad[2]).find("the hair has 101") != std::string::npos);
    Strands many = board(0.0);
    many.set_groups(std::vector<Index>(at(many.size()), 0), std::vector<std::string>(1001, "lock"));
    CHECK(message_of_levels(many, {.strands = {{.count = 1}}, .by_group = true}).find("has 1001") !=
          std::string::npos);
    CHECK(code_of_level([] { make_hair_levels({}, {.strands = {{.count = 1}}}); }) ==
          ErrorCode::invalid_argument);
    CHECK(message_of_levels(two_groups(), {.cards = {{.sections = 1}}, .by_group = true})
              .starts_with("group 'left': "));
    // A group that covers no pixel has no levels.
    Strands stub = two_groups();
    append(stub, strands_of({{Vec3(0, 0, 0), Vec3(0, 0.001, 0)}}));
    std::vector<Index> groups = stub.groups();
    groups.back() = 2;
    stub.set_groups(std::move(groups), {"left", "right", "stub"});
    CHECK(make_hair_levels(stub, {.strands = {{.count = 9}}, .by_group = true}).size() == 2);
    const Strands broken = strands_of({{Vec3(0, 0, 0), Vec3(0, kNaN, 0)}});
    CHECK(code_of_level([&] { make_hair_levels(broken, {.strands = {{.count = 1}}}); }) ==
          ErrorCode::not_finite);
}

}  // namespace lissom::test
