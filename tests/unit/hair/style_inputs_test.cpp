// A hairstyle follows from its inputs alone: whatever was edited, grown, undone or given up before.
#include "kernel/hair/style_inputs.h"

#include <doctest/doctest.h>

#include <functional>

#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/style_scenes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

HairOptions some_hair() {
    HairOptions options;
    options.roots.count = 150;
    options.growth.length = 0.08;
    return options;
}

StyleCurve random_shape(const Hairstyle& style, RandomPoints& random) {
    const double shift = random.uniform(-25.0, 25.0);
    const double kind = random.uniform(0.0, 3.0);
    if (kind < 1.8) {
        const double sign = random.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
        return stream({over(style, 20 * sign + shift, 50, 0.01),
                       over(style, 70 * sign + shift, 25, 0.02),
                       over(style, 85 * sign, -15, 0.02)});
    }
    if (kind < 2.5) {
        StyleCurve curve{
            DividingCurve{{over(style, shift, 45, 0), over(style, 0.5 * shift, 75, 0)}}};
        std::get<DividingCurve>(curve.shape).gap = random.uniform(-1.0, 1.0) < 0.0 ? 0.0 : 0.01;
        return curve;
    }
    const Vec3 tie = over(style, 180 + shift, 25, 0.02);
    return {Ponytail{{tie, tie + Vec3(0, -0.01, -0.04), tie + Vec3(0, -0.12, -0.06)}}};
}

// One edit by chance; `kept` is an earlier state to return to.
void edit_randomly(Hairstyle& style, RandomPoints& random, StyleInputs& kept) {
    const auto count = static_cast<double>(style.curves().size());
    const auto one = [&] {
        return style.curves()[static_cast<std::size_t>(random.uniform(0, count))];
    };
    const double what = count < 2.0 ? 0.0 : random.uniform(0.0, 11.0);
    if (what < 2.0) {
        style.add(random_shape(style, random));
    } else if (what < 3.0) {
        style.set(one(), random_shape(style, random));
    } else if (what < 5.0) {
        const CurveId id = one();
        std::vector<Vec3> points = drawn_points(style.curve(id));
        points.back() += Vec3(0.0, random.uniform(-0.01, 0.01), 0.0);
        style.set_points(id, points);
    } else if (what < 6.5) {
        const CurveId id = one();
        style.enable(id, !style.curve(id).enabled);
    } else if (what < 7.5) {
        style.reorder(one(), static_cast<Index>(random.uniform(0, count)));
    } else if (what < 8.5) {
        style.remove(one());
    } else if (what < 9.0) {
        style.solve();
    } else if (what < 9.5) {
        style.avoids_scalp() ? style.forget_scalp() : style.avoid_scalp();
    } else if (what < 10.0) {
        kept = style.inputs();
    } else {
        style.restore(kept);
    }
}

Hairstyle small_style_of(const StyleInputs& inputs,
                         const GridFieldOptions& options = HairField::default_options()) {
    Hairstyle style = small_style(options);
    style.restore(inputs);
    return style;
}

bool any_enabled(const Hairstyle& style) {
    return std::any_of(style.curves().begin(), style.curves().end(),
                       [&](CurveId id) { return style.curve(id).enabled; });
}

// Field, constraints and strands of the style are those of a new one with its inputs, to the bit.
void check_against_fresh(Hairstyle& style, const GridFieldOptions& options) {
    Hairstyle fresh = small_style_of(style.inputs(), options);
    REQUIRE(fresh.inputs() == style.inputs());
    CHECK(fresh.constraints().size() == style.constraints().size());
    CHECK(field_of(fresh) == field_of(style));
    if (any_enabled(style)) {
        CHECK(hash(fresh.grow(some_hair())) == hash(style.grow(some_hair())));
    }
}

// A context that is cancelled at its n-th checkpoint, counted from 0.
class CancelledAt {
  public:
    explicit CancelledAt(int n) : left_(n), context_(options()) {}
    CancelledAt(const CancelledAt&) = delete;
    CancelledAt& operator=(const CancelledAt&) = delete;

    const Context& context() const { return context_; }

  private:
    void count() {
        if (left_-- == 0) context_.cancel();
    }
    ContextOptions options() {
        ContextOptions options;
        options.progress = [this](std::string_view, double) { count(); };
        options.parallel_for = [this](std::size_t chunks,
                                      const std::function<void(std::size_t)>& chunk) {
            for (std::size_t i = 0; i < chunks; ++i) {
                count();
                chunk(i);
            }
        };
        return options;
    }

    int left_;
    Context context_;
};

// Runs `step` cancelled at every checkpoint until it gets through; `after` looks at what is left
// each time it did not. Returns how often that was.
int cancel_everywhere(const std::function<void(const Context&)>& step,
                      const std::function<void()>& after) {
    for (int n = 0;; ++n) {
        const CancelledAt run(n);
        try {
            step(run.context());
            return n;
        } catch (const Error& error) {
            REQUIRE(error.code() == ErrorCode::cancelled);
        }
        after();
    }
}

}  // namespace

TEST_CASE("style inputs: after any edits field and strands are those of a fresh style") {
    GridFieldOptions dense = HairField::default_options(), iterative = dense, thesis = dense;
    iterative.dense_limit = 0;
    thesis.boundary = GridBoundary::thesis;
    std::uint32_t seed = 40;
    for (const GridFieldOptions& options : {dense, dense, iterative, thesis}) {
        RandomPoints random(++seed);
        Hairstyle style = small_style(options);
        StyleInputs kept;
        for (int step = 0; step < 40; ++step) {
            CAPTURE(seed);
            CAPTURE(step);
            edit_randomly(style, random, kept);
            if (step % 4 == 1 && any_enabled(style)) style.grow(some_hair());
            if (step % 8 == 7) check_against_fresh(style, options);
        }
    }
}

TEST_CASE("style inputs: a copy that is given back is an undo, to the bit") {
    Hairstyle style = small_style();
    const CurveId flow = style.add(stream(side(style, 1)));
    const CurveId line = style.add(parting(style));
    const StyleInputs before = style.inputs();
    const auto field = field_of(style);
    const auto hair = hash(style.grow(some_hair()));
    style.set_points(flow, side(style, -1));
    style.remove(line);
    style.add(tail(style));
    style.avoid_scalp();
    style.grow(some_hair());
    style.restore(before);
    CHECK(style.inputs() == before);
    CHECK(style.has(line));
    CHECK(field_of(style) == field);
    CHECK(hash(style.grow(some_hair())) == hair);
    // Ids are not given twice, not even after an undo.
    const CurveId next = style.add(tail(style));
    CHECK(next.value > line.value + 1);
}

TEST_CASE("style inputs: what is not one of this style is refused, and nothing has changed") {
    Hairstyle style = small_style();
    style.add(stream(side(style, 1)));
    const StyleInputs good = style.inputs();
    const auto refused = [&](const std::function<void(StyleInputs&)>& spoil) {
        StyleInputs bad = good;
        spoil(bad);
        const ErrorCode code = error_of([&] { style.restore(bad); }).code();
        CHECK(style.inputs() == good);
        return code;
    };
    CHECK(refused([](StyleInputs& s) { s.curves.push_back(s.curves[0]); }) ==
          ErrorCode::invalid_argument);
    CHECK(refused([](StyleInputs& s) { s.curves[0].id = {}; }) == ErrorCode::invalid_argument);
    CHECK(refused([](StyleInputs& s) { drawn_points(s.curves[0].curve).clear(); }) ==
          ErrorCode::invalid_argument);
    CHECK(refused([](StyleInputs& s) { s.scalp_step = {{100'000'000}}; }) ==
          ErrorCode::out_of_range);
}

TEST_CASE("style inputs: a solve that is cancelled anywhere leaves style and field as they were") {
    for (const Index limit : {3000, 0}) {
        GridFieldOptions options = HairField::default_options();
        options.dense_limit = limit;
        Hairstyle style = small_style(options);
        const CurveId flow = style.add(stream(side(style, 1)));
        const std::vector<float> before = field_of(style);
        style.set_points(flow, side(style, -1));
        style.add(tail(style));
        const StyleInputs inputs = style.inputs();
        const auto shown = [&] {
            return std::vector<float>(style.field().values().begin(), style.field().values().end());
        };
        const int failures =
            cancel_everywhere([&](const Context& context) { style.solve(context); },
                              [&] {
                                  CHECK(style.inputs() == inputs);
                                  CHECK_FALSE(style.solved());
                                  CHECK(shown() == before);
                              });
        CHECK(failures > 5);
        check_against_fresh(style, options);
    }
}

TEST_CASE("style inputs: avoid_scalp that is cancelled anywhere leaves style and field") {
    Hairstyle style = small_style();
    style.add(stream({Vec3(0, 0.16, 0), Vec3(0, 0.13, 0)}));
    style.avoid_scalp();
    const StyleInputs inputs = style.inputs();
    const std::vector<float> before = field_of(style);
    const int failures =
        cancel_everywhere([&](const Context& context) { style.avoid_scalp({}, context); },
                          [&] {
                              CHECK(style.inputs() == inputs);
                              const auto values = style.field().values();
                              CHECK(std::equal(values.begin(), values.end(), before.begin()));
                          });
    CHECK(failures > 5);
    check_against_fresh(style, HairField::default_options());
}

TEST_CASE(
    "style inputs: growth that is cancelled anywhere leaves the style, and old hair or none") {
    Hairstyle style = small_style();
    style.add(stream(side(style, 1)));
    style.add(parting(style));
    Strands hair = style.grow(some_hair());
    const auto grown = hash(hair);
    style.add(tail(style));
    HairOptions options = some_hair();
    options.growth.seed = 7;
    const StyleInputs inputs = style.inputs();
    // What a failed growth emptied stays empty; what a failed solve left is what was there.
    int untouched = 0;
    const int failures =
        cancel_everywhere([&](const Context& context) { style.grow(options, hair, context); },
                          [&] {
                              CHECK(style.inputs() == inputs);
                              CHECK((hair.empty() || hash(hair) == grown));
                              untouched += !hair.empty();
                          });
    CHECK(failures > 5);
    CHECK(untouched > 0);
    CHECK(hash(hair) == hash(small_style_of(inputs).grow(options)));
}
