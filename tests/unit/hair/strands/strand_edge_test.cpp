#include "kernel/hair/strands/strand_edge.h"

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/hair/style_scenes.h"

using namespace lissom;

namespace {

Strands combed_hair(Hairstyle& style) {
    style.add(test::stream(test::side(style, 1.0)));
    style.add(test::stream(test::side(style, -1.0)));
    HairOptions options;
    options.roots.count = 3000;
    options.growth.length = 0.12;
    return style.grow(options);
}

}  // namespace

TEST_CASE("strands at the hairline are finer and shorter, some are baby hair; roots stay") {
    Hairstyle style = test::small_style();
    const Strands before = combed_hair(style);
    const auto inside = inside_hairline(before, test::small_head(), style.scalp(), 0.02);
    Strands after = before;
    soften_edge(after, inside);
    Index edge = 0, baby = 0;
    for (Index s = 0; s < before.size(); ++s) {
        const auto i = static_cast<std::size_t>(s);
        CHECK(after.root(s) == before.root(s));
        const double was = length(before.strand(s)), now = length(after.strand(s));
        if (inside[i] == 1.0f) {
            CHECK(now == doctest::Approx(was));
            CHECK(after.widths().at(s, after.first_point(s)) ==
                  before.widths().at(s, before.first_point(s)));
        }
        if (inside[i] > 0.3f) continue;
        ++edge;
        CHECK(after.widths().at(s, after.first_point(s)) <
              0.7f * before.widths().at(s, before.first_point(s)));
        baby += now < 0.025;
    }
    REQUIRE(edge > 30);
    CHECK(baby > edge / 8);
    CHECK(baby < edge);
}

TEST_CASE("the softened edge of a part is the part of the softened edge") {
    Hairstyle style = test::small_style();
    Strands all = combed_hair(style);
    Strands part = prefix(all, 500);
    auto inside = inside_hairline(all, test::small_head(), style.scalp(), 0.02);
    soften_edge(all, inside);
    inside.resize(500);
    soften_edge(part, inside);
    for (Index s = 0; s < 500; ++s) {
        REQUIRE(part.strand(s).cols() == all.strand(s).cols());
        CHECK((part.strand(s) - all.strand(s)).cwiseAbs().maxCoeff() < 1e-6f);
    }
}

TEST_CASE("edges without sense are refused and change nothing") {
    Strands strands = test::rich_hair(10);
    const auto before = hash(strands);
    const auto code = [&](const StrandEdgeOptions& options, std::size_t count = 10) {
        const std::vector<float> inside(count, 0.5f);
        return test::error_of([&] { soften_edge(strands, inside, options); }).code();
    };
    CHECK(code({.width = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({.length = 1.5}) == ErrorCode::invalid_argument);
    CHECK(code({.baby = -0.1}) == ErrorCode::invalid_argument);
    CHECK(code({.baby_length = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({.stray = test::kNaN}) == ErrorCode::invalid_argument);
    CHECK(code({}, 9) == ErrorCode::invalid_argument);
    CHECK(hash(strands) == before);
    const Strands loose = test::strands_of({{Vec3(0, 0, 0), Vec3(0, 0.1, 0)}});
    CHECK(test::error_of([&] {
              (void)inside_hairline(loose, test::small_head(), *test::small_scalp(), 0.02);
          }).code() == ErrorCode::invalid_argument);
    Strands none;
    soften_edge(none, {});
    CHECK(none.empty());
}
