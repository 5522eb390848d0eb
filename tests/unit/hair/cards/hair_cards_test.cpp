#include "kernel/hair/cards/hair_cards.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <vector>

#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

constexpr double kBall = 0.1;

double to_ball(const Vec3& p) {
    return p.norm() - kBall;
}

// Hair of 12 cm that hangs from the upper half of a ball of 10 cm, close to it.
Strands ball_hair(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double up = 0.2 + 0.75 * std::fmod(0.618034 * s, 1.0);
        const double turn = 2.0 * kPi * std::fmod(0.754878 * s, 1.0);
        const double start = std::acos(up);
        std::vector<Vec3> points;
        for (int k = 0; k < 13; ++k) {
            const double a = start + 0.12 / kBall * k / 12, r = kBall + 0.004 + 0.0005 * k;
            points.push_back(
                r * Vec3(std::sin(a) * std::cos(turn), std::cos(a), std::sin(a) * std::sin(turn)));
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

CardOptions on_ball(Index count) {
    CardOptions options;
    options.count = count;
    options.distance = to_ball;
    return options;
}

TEST_CASE("hair cards: every strand has a card, and lies on it nearly whole") {
    const Strands hair = ball_hair(600);
    const HairCards cards = make_cards(hair, on_ball(40));
    CHECK(cards.cards.size() == 40);
    std::set<Index> seen;
    for (const Card& card : cards.cards) seen.insert(card.strands.begin(), card.strands.end());
    CHECK(seen.size() == 600);
    CHECK(cards.covered > 0.85);
    CHECK(cards.rms < 0.01);
    // More cards lie closer.
    CHECK(make_cards(hair, on_ball(120)).rms < cards.rms);
}

TEST_CASE("hair cards: none goes through the head") {
    const Strands hair = ball_hair(600);
    for (const Index count : {1, 10, 60}) {
        const CardOptions options = on_ball(count);
        const Mesh mesh = card_mesh(make_cards(hair, options), hair, options);
        for (const Vec3& p : mesh.positions()) CHECK(to_ball(p) > 0.5 * options.clearance);
        if (count < 60) continue;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            Vec3 middle = Vec3::Zero();
            for (const Index v : mesh.topology().face(f)) middle += mesh.position(v) / 3.0;
            CHECK(to_ball(middle) > 0.0);
        }
    }
}

TEST_CASE("hair cards: sections have orthonormal axes, fronts look away from the head") {
    const HairCards cards = make_cards(ball_hair(400), on_ball(30));
    for (const Card& card : cards.cards) {
        for (const CardSection& section : card.sections) {
            CHECK(section.across.norm() == doctest::Approx(1.0));
            CHECK(section.out.norm() == doctest::Approx(1.0));
            CHECK(std::abs(section.across.dot(section.out)) < 1e-9);
            CHECK(section.out.dot(section.center.normalized()) > 0.3);
            CHECK(section.half_width > 0.0);
        }
    }
}

TEST_CASE("hair cards: the mesh has texture coordinates in its slots and unit normals") {
    const Strands hair = ball_hair(400);
    CardOptions options = on_ball(30);
    options.slots = 7;
    const HairCards cards = make_cards(hair, options);
    REQUIRE(cards.slots.size() <= 7);
    const Mesh mesh = card_mesh(cards, hair, options);
    CHECK(mesh.face_count() == 30 * 2 * (options.sections - 1));
    const Attribute* const uv = mesh.attributes().find("uv");
    const Attribute* const normal = mesh.attributes().find("normal");
    const Attribute* const color = mesh.attributes().find("color");
    REQUIRE((uv && normal && color));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Card& card = cards.cards[at(v / (2 * options.sections))];
        const CardSlot& slot = cards.slots[at(card.slot)];
        CHECK(uv->at(v)[0] >= slot.low.x() - 1e-9);
        CHECK(uv->at(v)[1] <= slot.high.y() + 1e-9);
        const Vec3 n(normal->at(v)[0], normal->at(v)[1], normal->at(v)[2]);
        CHECK(n.norm() == doctest::Approx(1.0));
        CHECK(color->at(v)[0] > 0.0);
        CHECK(color->at(v)[0] <= 1.0);
    }
    // Slots do not overlap.
    for (std::size_t a = 0; a < cards.slots.size(); ++a) {
        for (std::size_t b = a + 1; b < cards.slots.size(); ++b) {
            const auto low = cards.slots[a].low.cwiseMax(cards.slots[b].low);
            const auto high = cards.slots[a].high.cwiseMin(cards.slots[b].high);
            CHECK((high - low).minCoeff() <= 0.0);
        }
    }
}

TEST_CASE("hair cards: a cap of few triangles lies over the skin that hair grows on") {
    const Mesh head = make_sphere({.radius = kBall, .segments = 40});
    std::vector<std::vector<Vec3>> lists;
    StrandRoots roots;
    for (Index f = 0; f < head.face_count(); ++f) {
        Vec3 middle = Vec3::Zero();
        for (const Index v : head.topology().face(f)) middle += head.position(v);
        middle /= static_cast<double>(head.topology().face(f).size());
        if (middle.y() < 0.02) continue;
        lists.push_back({middle, 1.2 * middle, 1.4 * middle});
        roots.faces.push_back(f);
        roots.barycentrics.push_back(Eigen::Vector3f::Constant(1.0f / 3.0f));
    }
    Strands hair = strands_of(lists);
    hair.set_roots(roots);
    HairCards cards = make_cards(hair, on_ball(20));
    const CardCapOptions options;
    add_cap(cards, hair, head, options);
    CHECK(count_of(cards.cap.triangles) <= options.triangles);
    CHECK(roots.faces.size() > 2 * cards.cap.triangles.size());
    double lowest = 1.0;
    for (std::size_t v = 0; v < cards.cap.positions.size(); ++v) {
        const Vec3& p = cards.cap.positions[v];
        CHECK(std::abs(to_ball(p) - options.offset) < options.error + 1e-4);
        CHECK(cards.cap.normals[v].dot(p.normalized()) > 0.9);
        lowest = std::min(lowest, p.y());
        // It shows within the hair, though roots are denser at the pole of this ball.
        if (p.y() > 0.05) CHECK(cards.cap.cover[v] > 0.7);
    }
    CHECK(lowest > 0.0);
    CHECK(lowest < 0.025);
    // For the eye it ends where roots end.
    double edge = 1.0;
    const Mesh seen = cut_cap(cards.cap);
    for (const Vec3& p : seen.positions()) edge = std::min(edge, p.y());
    CHECK(edge == doctest::Approx(0.02).epsilon(0.25));
}

TEST_CASE("hair cards: the edge of a cap does not follow the faces of a coarse head") {
    // Roots above a slanting plane, at random places of few faces.
    const Mesh head = make_sphere({.radius = kBall, .segments = 20});
    const Triangulation faces = triangulate_faces(head.topology(), head.positions());
    std::vector<std::vector<Vec3>> lists;
    StrandRoots roots;
    const auto height = [](const Vec3& p) { return p.y() + 0.5 * p.x() - 0.02; };
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        const Triangle& corners = faces.triangles[t];
        const Vec3 a = head.position(corners[0]), ab = head.position(corners[1]) - a,
                   ac = head.position(corners[2]) - a;
        const auto count = static_cast<Index>(1e5 * ab.cross(ac).norm());
        for (Index i = 0; i < count; ++i) {
            double u = std::fmod(0.7548776662 * (i + 1), 1.0),
                   v = std::fmod(0.5698402910 * (i + 1), 1.0);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const Vec3 p = a + u * ab + v * ac;
            if (height(p) < 0.0) continue;
            lists.push_back({p, 1.2 * p});
            roots.faces.push_back(faces.face[t]);
            roots.barycentrics.emplace_back(0.4f, 0.3f, 0.3f);
        }
    }
    Strands hair = strands_of(lists);
    hair.set_roots(roots);
    const Mesh seen = cut_cap(make_cap(hair, head));
    REQUIRE(seen.face_count() > 0);
    for (Index v = 0; v < seen.vertex_count(); ++v) {
        CHECK(height(seen.position(v)) > -0.008);
        if (seen.topology().is_boundary(v)) CHECK(std::abs(height(seen.position(v))) < 0.008);
    }
}

// Straight strands of 20 cm that hang as tufts, round or flat.
Strands hanging_tufts(Index tufts, Index of_each, double depth) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < tufts * of_each; ++s) {
        const double turn = 2.4 * s, r = 0.01 * std::sqrt(std::fmod(0.618034 * s, 1.0));
        const Vec3 root(0.1 * (s % tufts) + r * std::cos(turn), 0.0, depth * r * std::sin(turn));
        std::vector<Vec3> points;
        for (int k = 0; k < 9; ++k) points.push_back(root - Vec3(0.0, 0.025 * k, 0.0));
        lists.push_back(points);
    }
    return strands_of(lists);
}

TEST_CASE("hair cards: a stray strand has no card of its own") {
    const Strands tufts = hanging_tufts(10, 80, 0.2);
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < tufts.size(); ++s) {
        std::vector<Vec3> points;
        for (Index k = 0; k < tufts.point_count(s); ++k) {
            points.push_back(point_of(tufts.strand(s), k));
        }
        lists.push_back(points);
    }
    lists.push_back({Vec3(0.4, 0.0, 0.5), Vec3(0.4, 0.1, 0.5), Vec3(0.4, 0.2, 0.5)});
    const HairCards cards = make_cards(strands_of(lists), {.count = 30, .crossed = false});
    CHECK(count_of(cards.cards) == 29);
    for (const Card& card : cards.cards) {
        for (const CardSection& section : card.sections) CHECK(section.center.z() < 0.1);
    }
}

TEST_CASE("hair cards: round tufts have two cards that cross, within the count") {
    CardOptions options;
    options.count = 8;
    const Strands round = hanging_tufts(4, 100, 1.0);
    const HairCards cards = make_cards(round, options);
    CHECK(cards.cards.size() <= 8);
    int crossings = 0;
    for (const Card& card : cards.cards) {
        if (card.crosses == kNoIndex) continue;
        const Card& first = cards.cards[at(card.crosses)];
        CHECK(first.crosses == kNoIndex);
        CHECK(first.strands == card.strands);
        for (std::size_t k = 0; k < card.sections.size(); ++k) {
            CHECK(std::abs(card.sections[k].across.dot(first.sections[k].across)) < 1e-6);
        }
        ++crossings;
    }
    CHECK(crossings >= 2);
    options.crossed = false;
    CHECK(cards.rms < make_cards(round, options).rms);
    for (const Card& card : make_cards(round, options).cards) CHECK(card.crosses == kNoIndex);
}

TEST_CASE("hair cards: flat tufts have one card each") {
    CardOptions options;
    options.count = 4;
    options.distance = [](const Vec3& p) { return p.z() + 0.1; };
    for (const Card& card : make_cards(hanging_tufts(4, 100, 0.1), options).cards) {
        CHECK(card.crosses == kNoIndex);
    }
}

TEST_CASE("hair cards: a place on a card is that which it was made of") {
    const HairCards cards = make_cards(ball_hair(200), on_ball(8));
    const Card& card = cards.cards[3];
    const CardSection& section = card.sections[5];
    const Vec3 p = section.center + 0.5 * section.half_width * section.across;
    const CardPoint place = place_on_card(card, p);
    CHECK(place.u == doctest::Approx(0.5).epsilon(0.15));
    CHECK(place.v == doctest::Approx(5.0 / (count_of(card.sections) - 1.0)).epsilon(0.05));
    CHECK(std::abs(place.out) < 1e-3);
}

TEST_CASE("hair cards: groups share no card, and locks stay whole") {
    Strands hair = ball_hair(300);
    std::vector<Index> groups;
    for (Index s = 0; s < 300; ++s) groups.push_back(hair.root(s).x() > 0.0f ? 1 : 0);
    hair.set_groups(groups, {"left", "right"});
    assign_guides(hair, {.count = 30});
    const HairCards cards = make_cards(hair, on_ball(20));
    const std::vector<Index> guides = present_guides(hair);
    for (const Card& card : cards.cards) {
        const std::set<Index> own(card.strands.begin(), card.strands.end());
        for (const Index s : card.strands) {
            CHECK(hair.group(s) == hair.group(card.strands.front()));
            CHECK(own.contains(guides[at(s)]));
        }
    }
}

TEST_CASE("hair cards: budgets, one strand, bad input, threads") {
    const Strands hair = ball_hair(100);
    CardOptions options = on_ball(10);
    options.triangles = 100;
    CHECK(card_mesh(make_cards(hair, options), hair, options).face_count() <= 100);
    options.triangles = 19;
    CHECK_THROWS_AS(make_cards(hair, options), Error);
    options.triangles = 10'000'000;
    CHECK_THROWS_AS(make_cards(hair, options), Error);
    options.triangles = 1260;
    CHECK(card_mesh(make_cards(hair, options), hair, options).face_count() == 1260);
    CHECK_THROWS_AS(make_cards(hair, {.count = 0}), Error);
    CHECK_THROWS_AS(make_cards(hair, {.count = 10'000'000}), Error);
    CHECK_THROWS_AS(make_cards({}, {}), Error);
    const HairCards one = make_cards(ball_hair(1), {});
    REQUIRE(one.cards.size() == 1);
    CHECK(one.cards[0].sections.front().half_width > 0.0);
    ContextOptions two;
    two.threads = 2;
    const Mesh a = card_mesh(make_cards(hair, on_ball(9)), hair, on_ball(9));
    const Mesh b =
        card_mesh(make_cards(hair, on_ball(9), Context(two)), hair, on_ball(9), Context(two));
    for (Index v = 0; v < a.vertex_count(); ++v) CHECK(a.position(v) == b.position(v));
}

}  // namespace
}  // namespace lissom::test
