#include "kernel/hair/field/field_gravity.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/style_file.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/style_scenes.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

Hairstyle style_with(double gravity) {
    HairstyleOptions options;
    options.resolution = 12000;
    options.gravity = gravity;
    return Hairstyle(small_head(), small_scalp(), options);
}

Strands few_strands(Hairstyle& style) {
    HairOptions hair;
    hair.roots.count = 1500;
    return style.grow(hair);
}

// Points before the face, below the eyes and above the chin, as a fraction of all.
double share_over_face(const Hairstyle& style, const Strands& hair) {
    Index over = 0, count = 0;
    for (Index s = 0; s < hair.size(); ++s) {
        const auto strand = hair.strand(s);
        for (Eigen::Index k = 0; k < strand.cols(); ++k, ++count) {
            const Vec3 p =
                style.scalp().to_metres(strand.col(k).cast<double>() / style.scalp().unit());
            const bool inside = p.z() > 0.03 && p.y() < 0.0 && p.y() > -0.1;
            if (inside && std::abs(p.x()) < 0.6 * p.z()) ++over;
        }
    }
    return static_cast<double>(over) / count;
}

// The mean direction of strands from root to tip.
Vec3 mean_way(const Strands& hair, double side) {
    Vec3 sum = Vec3::Zero();
    for (Index s = 0; s < hair.size(); ++s) {
        const auto strand = hair.strand(s);
        if (strand.col(0).x() * side <= 0.0) continue;
        sum += (strand.rightCols<1>() - strand.col(0)).cast<double>();
    }
    return sum.normalized();
}

GridLayout small_layout() {
    return {{8, 6, 10}, Vec3(-0.1, -0.2, -0.1), 0.03};
}

}  // namespace

TEST_CASE("gravity: all of it by default, none to the letter of the thesis") {
    CHECK(HairstyleOptions{}.gravity == 1.0);
    CHECK(style_options_with(HairFidelity::lissom).gravity == 1.0);
    CHECK(style_options_with(HairFidelity::thesis).gravity == 0.0);
}

TEST_CASE("gravity: with 0 the field is that of the curves, to the bit") {
    Hairstyle with = style_with(0.0);
    with.add(stream(side(with, 1)));
    with.solve();
    std::vector<float> solved(with.field().values().size());
    for (std::size_t i = 3; i < solved.size(); i += 4) solved[i] = with.field().values()[i];
    with.field().grid().evaluate(solved);
    CHECK(std::equal(solved.begin(), solved.end(), with.field().values().begin()));
}

TEST_CASE("gravity: near curves the field is theirs, far away it is the fallen one") {
    Hairstyle none = style_with(0.0), all = style_with(1.0);
    for (Hairstyle* style : {&none, &all}) {
        style->add(stream(side(*style, 1)));
        style->solve();
    }
    for (const StyleConstraint& one : all.constraints()) {
        if (one.kind == ConstraintKind::stop) continue;
        CHECK(none.field().sample(one.point).direction == all.field().sample(one.point).direction);
    }
    const Vec3 far(-0.13, 0.0, -0.05);
    CHECK((all.field().sample(far).direction - Vec3(0, -1, 0)).norm() < 0.3);
    CHECK(none.field().sample(far).direction != all.field().sample(far).direction);
}

TEST_CASE("gravity: distances from curves are exact") {
    const GridLayout layout = small_layout();
    const std::vector<Index> styled{layout.index(1, 2, 3), layout.index(6, 5, 8)};
    FieldGravity gravity{.amount = 1.0, .styled = styled, .held = 0.045, .fade = 0.09};
    std::vector<float> values(4 * at(layout.size()), 0.0f), gradients(values.size(), 0.0f);
    for (std::size_t i = 3; i < values.size(); i += 4) values[i] = 1.0f;
    add_gravity(values, gradients, layout, gravity);
    for (Index i = 0; i < layout.size(); ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Index s : styled) {
            nearest = std::min(nearest, (layout.point(i) - layout.point(s)).norm());
        }
        const double t = std::clamp((nearest - 0.045) / 0.09, 0.0, 1.0);
        const Vec3 fallen = fallen_direction(layout.point(i), 1.0, Vec3::Zero());
        const Vec3 found(values[4 * at(i)], values[4 * at(i) + 1], values[4 * at(i) + 2]);
        CHECK((found - t * t * (3.0 - 2.0 * t) * fallen).norm() < 1e-6);
    }
}

TEST_CASE("gravity: falling hair never points into the head, and is the same on both sides") {
    RandomPoints random(7);
    for (int k = 0; k < 500; ++k) {
        const Vec3 p = random.in_box({{-0.15, -0.3, -0.15}, {0.15, 0.2, 0.15}});
        const Vec3 outward = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        const Vec3 way = fallen_direction(p, 0.005, outward);
        CHECK(way.norm() == Approx(1.0));
        CHECK(way.dot(outward) > -1e-9);
        const Vec3 flip(-1, 1, 1);
        const Vec3 mirrored =
            fallen_direction(p.cwiseProduct(flip), 0.005, outward.cwiseProduct(flip));
        CHECK((mirrored - way.cwiseProduct(flip)).norm() < 1e-9);
    }
}

TEST_CASE("gravity: a stream on one side leaves the hair of the other hanging, and the face free") {
    Hairstyle style = style_with(1.0);
    style.add(stream(side(style, 1)));
    const Strands hair = few_strands(style);
    CHECK(mean_way(hair, -1.0).y() < -0.8);
    CHECK(std::abs(mean_way(hair, -1.0).x()) < 0.4);
    CHECK(share_over_face(style, hair) < 0.002);
}

TEST_CASE("gravity: hair falls on from the end of a stream") {
    double lengths[2] = {};
    for (const double gravity : {0.0, 1.0}) {
        Hairstyle style = style_with(gravity);
        for (const double sign : {-1.0, 1.0}) {
            style.add(stream({over(style, 30 * sign, 60, 0.01), over(style, 80 * sign, 30, 0.01)}));
        }
        lengths[gravity > 0.0] = strand_statistics(few_strands(style)).mean_length;
    }
    CHECK(lengths[1] > 0.2);
    CHECK(lengths[1] > 1.2 * lengths[0]);
}

TEST_CASE("gravity: hair with a parting alone falls to both sides") {
    Hairstyle style = style_with(1.0);
    style.add(parting(style));
    const Strands hair = few_strands(style);
    for (const double side : {-1.0, 1.0}) CHECK(mean_way(hair, side).y() < -0.7);
    CHECK(share_over_face(style, hair) < 0.002);
    CHECK(strand_statistics(hair).mean_length > 0.15);
}

TEST_CASE("gravity: a stream that stops before a tie leads into it") {
    Hairstyle none = style_with(0.0), all = style_with(1.0);
    double caught[2] = {};
    int place = 0;
    for (Hairstyle* style : {&none, &all}) {
        style->add(tail(*style));
        for (const double sign : {-1.0, 1.0}) {
            style->add(stream({over(*style, 40 * sign, 45, 0.01), over(*style, 90 * sign, 35, 0.01),
                               over(*style, 150 * sign, 30, 0.01)}));
        }
        HairOptions hair;
        hair.roots.count = 1500;
        Strands strands;
        const GrowthReport report = style->grow(hair, strands);
        for (const Index tie : report.ties) caught[place] += tie == 0 ? 1.0 / 1500 : 0.0;
        ++place;
    }
    CHECK(caught[1] > 0.8);
    CHECK(caught[1] >= caught[0]);
}

TEST_CASE("gravity: it is kept by files, and files that do not name it have none") {
    Hairstyle style = style_with(0.5);
    style.add(stream(side(style, 1)));
    std::string text = encode_style(content_of(style));
    CHECK(decode_style(text).options.gravity == 0.5);
    const std::size_t from = text.find("\"gravity\"");
    REQUIRE(from != std::string::npos);
    text.erase(from, text.find(',', from) + 1 - from);
    CHECK(decode_style(text).options.gravity == 0.0);
}

TEST_CASE("gravity: out of range is refused") {
    for (const double wrong : {-0.1, 1.1, kNaN}) {
        CHECK(error_of([&] { style_with(wrong); }).code() == ErrorCode::invalid_argument);
    }
}
