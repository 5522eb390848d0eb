#include "kernel/hair/scalp/mask_stroke.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <span>

#include "kernel/io/style_file.h"
#include "tests/unit/hair/style_scenes.h"
#include "tests/unit/support.h"

namespace lissom {
namespace {

MaskStroke dab(MaskKind kind, const Vec3& at, double value) {
    MaskStroke stroke;
    stroke.kind = kind;
    stroke.points = {at};
    stroke.value = value;
    stroke.radius = 0.03;
    return stroke;
}

double strand_length(const Strands& strands, Index s) {
    double length = 0.0;
    const auto points = strands.strand(s);
    for (Eigen::Index i = 1; i < points.cols(); ++i) {
        length += (points.col(i) - points.col(i - 1)).norm();
    }
    return length;
}

Vec3 root_in_metres(const Hairstyle& style, const Strands& strands, Index s) {
    return style.scalp().to_metres(strands.strand(s).col(0).cast<double>());
}

HairOptions some_hair() {
    HairOptions options;
    options.roots.count = 4000;
    options.growth.length = 0.1;
    options.growth.variation = 0.0;
    return options;
}

}  // namespace

TEST_CASE("mask: full under the brush, fading at its rim, nothing beyond, in any order of kinds") {
    MaskStroke stroke = dab(MaskKind::length, Vec3::Zero(), 0.2);
    stroke.points = {Vec3(-0.1, 0, 0), Vec3(0.1, 0, 0)};
    const MaskStroke all[] = {dab(MaskKind::density, Vec3::Zero(), 0.0), stroke};
    const ScalpMask mask(all, MaskKind::length);
    CHECK(mask.at(Vec3(0.05, 0, 0)) == doctest::Approx(0.2));
    CHECK(mask.at(Vec3(0, 0.014, 0)) == doctest::Approx(0.2));
    double last = mask.at(Vec3(0, 0.015, 0));
    for (double y = 0.016; y < 0.03; y += 0.001) {
        const double here = mask.at(Vec3(0, y, 0));
        CHECK(here > last);
        last = here;
    }
    CHECK(mask.at(Vec3(0, 0.0301, 0)) == 1.0);
    CHECK(mask.at(Vec3(0.131, 0, 0)) == 1.0);
    CHECK(ScalpMask({}, MaskKind::length).is_empty());
}

TEST_CASE("mask: a later stroke paints over, and 1 takes away what was there") {
    const Vec3 p = Vec3::Zero();
    const MaskStroke all[] = {dab(MaskKind::length, p, 0.2), dab(MaskKind::length, p, 3.0),
                              dab(MaskKind::length, p, 1.0)};
    CHECK(ScalpMask(std::span(all, 2), MaskKind::length).at(p) == doctest::Approx(3.0));
    CHECK(ScalpMask(all, MaskKind::length).at(p) == doctest::Approx(1.0));
}

TEST_CASE("mask: what no brush can paint is refused, and the style is as it was") {
    Hairstyle style = test::small_style();
    const auto code = [&](const auto& change) {
        MaskStroke bad = dab(MaskKind::density, Vec3::Zero(), 0.5);
        change(bad);
        return test::error_of([&] { style.add_mask(bad); }).code();
    };
    CHECK(code([](auto& m) { m.points.clear(); }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& m) { m.value = 1.5; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& m) { m.value = -0.1; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& m) { m.radius = 0.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& m) { m.softness = 2.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& m) { m.points[0].x() = std::numeric_limits<double>::quiet_NaN(); }) ==
          ErrorCode::not_finite);
    CHECK(style.masks().empty());
}

// The head's vertices are a centimetre apart: the mask is not theirs.
TEST_CASE("mask: hair is shorter where that was painted and nowhere else") {
    Hairstyle style = test::small_style();
    style.add(test::stream(test::side(style, 1)));
    style.add(test::stream(test::side(style, -1)));
    const Vec3 middle = test::over(style, 60, 45, 0.0);
    const Strands before = style.grow(some_hair());
    style.add_mask(dab(MaskKind::length, middle, 0.3));
    const Strands after = style.grow(some_hair());
    REQUIRE(after.size() == before.size());
    Index shorter = 0;
    for (Index s = 0; s < after.size(); ++s) {
        const double from = (root_in_metres(style, after, s) - middle).norm();
        const double ratio = strand_length(after, s) / std::max(strand_length(before, s), 1e-9);
        if (from > 0.031) CHECK(ratio == doctest::Approx(1.0));
        if (from < 0.014 && strand_length(before, s) > 0.09) {
            ++shorter;
            CHECK(ratio < 0.45);
        }
    }
    CHECK(shorter > 10);
    style.clear_masks(MaskKind::length);
    CHECK(strand_length(style.grow(some_hair()), 7) == doctest::Approx(strand_length(before, 7)));
}

TEST_CASE("mask: no hair where the density is painted to 0, and half of it where to a half") {
    Hairstyle style = test::small_style();
    style.add(test::stream(test::side(style, 1)));
    const Vec3 bald = test::over(style, 60, 45, 0.0), thin = test::over(style, -60, 45, 0.0);
    const auto near = [&](const Strands& strands, const Vec3& at) {
        Index count = 0;
        for (Index s = 0; s < strands.size(); ++s) {
            count += (root_in_metres(style, strands, s) - at).norm() < 0.014;
        }
        return count;
    };
    const Strands before = style.grow(some_hair());
    style.add_mask(dab(MaskKind::density, bald, 0.0));
    style.add_mask(dab(MaskKind::density, thin, 0.5));
    const Strands after = style.grow(some_hair());
    REQUIRE(near(before, bald) > 20);
    CHECK(near(after, bald) == 0);
    CHECK(near(after, thin) > 0.3 * near(before, thin));
    CHECK(near(after, thin) < 0.75 * near(before, thin));
    CHECK(after.size() == before.size());
}

TEST_CASE("mask: a style file keeps what was painted") {
    Hairstyle style = test::small_style();
    style.add(test::stream(test::side(style, 1)));
    style.add_mask(dab(MaskKind::density, test::over(style, 0, 60, 0.0), 0.25));
    style.add_mask(dab(MaskKind::length, test::over(style, 90, 30, 0.0), 2.5));
    const StyleContent content = decode_style(encode_style(content_of(style)));
    REQUIRE(content.masks.size() == 2);
    CHECK(std::equal(content.masks.begin(), content.masks.end(), style.masks().begin()));
    const Hairstyle copy = make_style(content, test::small_head(), test::small_scalp());
    CHECK(copy.masks().size() == 2);
    StyleInputs undo = style.inputs();
    style.clear_masks(MaskKind::density);
    CHECK(style.masks().size() == 1);
    style.restore(undo);
    CHECK(style.masks().size() == 2);
}

}  // namespace lissom
