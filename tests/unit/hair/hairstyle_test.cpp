// A hairstyle as a whole: curves that come, go and move, the field, roots and hair.
#include "kernel/hair/hairstyle.h"

#include <doctest/doctest.h>

#include <memory>

#include "kernel/core/machine_memory.h"
#include "kernel/hair/curve/length_text.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/style_roots.h"
#include "kernel/solve/field/grid_field.h"
#include "tests/unit/hair/hair_support.h"
#include "tests/unit/hair/style_scenes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

double max_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        greatest = std::max(greatest, std::abs(static_cast<double>(a[i]) - b[i]));
    }
    return greatest;
}

}  // namespace

TEST_CASE("hairstyle: curves keep their identity and order") {
    Hairstyle style = small_style();
    const CurveId a = style.add(stream(side(style, 1)));
    const CurveId b = style.add(parting(style));
    const CurveId c = style.add(tail(style));
    CHECK(kind_name(style.curve(a)) == "stream");
    CHECK(kind_name(style.curve(b)) == "dividing");
    CHECK(kind_name(style.curve(c)) == "ponytail");
    style.reorder(c, 0);
    CHECK(std::vector<CurveId>(style.curves().begin(), style.curves().end()) ==
          std::vector<CurveId>{c, a, b});
    style.reorder(c, 2);
    CHECK(style.curves()[2] == c);
    style.remove(a);
    CHECK_FALSE(style.has(a));
    CHECK(style.curves().size() == 2);
    CHECK(error_of([&] { style.curve(a); }).code() == ErrorCode::handle_removed);
    CHECK(error_of([&] { style.remove(a); }).code() == ErrorCode::handle_removed);
    CHECK(error_of([&] { style.reorder(b, 2); }).code() == ErrorCode::out_of_range);
    // Ids are not given twice.
    CHECK_FALSE(style.add(stream(side(style, 1))) == a);
}

TEST_CASE("hairstyle: whatever the way of edits, the field is that of the curves that are there") {
    Hairstyle direct = small_style(), edited = small_style();
    direct.add(stream(side(direct, 1)));
    direct.add(stream(side(direct, -1)));
    direct.add(parting(direct));

    const CurveId moved = edited.add(tail(edited));
    edited.solve();
    edited.set(moved, stream(side(edited, 1)));
    const CurveId gone =
        edited.add(stream({over(edited, 180, 40, 0.01), over(edited, 180, -20, 0.02)}));
    edited.solve();
    const CurveId right = edited.add(stream(side(edited, 1)));
    edited.solve();
    edited.set_points(right, side(edited, -1));
    const CurveId line = edited.add(parting(edited));
    edited.enable(line, false);
    edited.solve();
    edited.remove(gone);
    edited.enable(line, true);
    CHECK(max_difference(field_of(direct), field_of(edited)) < 1e-5);
}

TEST_CASE("hairstyle: a curve that is off has no effect") {
    Hairstyle one = small_style(), two = small_style();
    one.add(stream(side(one, 1)));
    two.add(stream(side(two, 1)));
    two.enable(two.add(tail(two)), false);
    CHECK(max_difference(field_of(one), field_of(two)) < 1e-6);
    StyleCurve off = tail(two);
    off.enabled = false;
    two.add(off);
    CHECK(max_difference(field_of(one), field_of(two)) < 1e-6);
}

TEST_CASE(
    "hairstyle: of curves that contradict each other the later counts, and order can change") {
    Hairstyle style = small_style();
    const std::vector<Vec3> forth = side(style, 1), back(forth.rbegin(), forth.rend());
    StyleCurve up = stream(back), down = stream(forth);
    std::get<StreamCurve>(up.shape).options.stop_length = 0.0;
    std::get<StreamCurve>(down.shape).options.stop_length = 0.0;
    const CurveId first = style.add(down);
    style.add(up);
    const Vec3 middle = style.course(first)[style.course(first).size() / 2];
    style.solve();
    CHECK(style.field().sample(middle).direction.y() > 0.5);
    style.reorder(first, 1);
    style.solve();
    CHECK(style.field().sample(middle).direction.y() < -0.5);
}

TEST_CASE("hairstyle: both solvers give the same field") {
    GridFieldOptions exact = HairField::default_options(), reference = exact;
    exact.refinements = reference.refinements = 2;
    reference.solver = GridSolver::cholesky;
    Hairstyle a = small_style(exact), b = small_style(reference);
    for (Hairstyle* style : {&a, &b}) {
        style->add(stream(side(*style, 1)));
        style->add(tail(*style));
        style->solve();
        style->add(parting(*style));
    }
    CHECK(max_difference(field_of(a), field_of(b)) < 1e-5);
}

TEST_CASE("hairstyle: a mesh that is moved, turned and scaled has its hair moved with it") {
    const Affine map = rotation(Vec3(1, 2, 3), 0.8, Vec3(0.1, 0, 0)) *
                       scaling(Vec3::Constant(3.0), Vec3(0.2, 0.1, 0));
    const Mesh other = moved(small_head(), map);
    ScalpOptions hints;
    hints.hints.up = map.linear * Vec3::UnitY();
    hints.hints.front = map.linear * Vec3::UnitZ();
    hints.unit = 1.0;
    HairstyleOptions options;
    options.resolution = 6000;
    Hairstyle here(small_head(), small_scalp(), options);
    Hairstyle there(other, std::make_shared<const Scalp>(other, hints), options);
    for (Hairstyle* style : {&here, &there}) style->add(stream(side(*style, 1)));
    HairOptions hair;
    hair.roots.count = 300;
    const Strands a = here.grow(hair), b = there.grow(hair);
    REQUIRE(a.size() == b.size());
    int alike = 0;
    for (Index s = 0; s < a.size(); ++s) {
        const Vec3 tip = a.strand(s).rightCols<1>().cast<double>(),
                   moved_tip = b.strand(s).rightCols<1>().cast<double>();
        if ((map(tip) - moved_tip).norm() < 0.01 * 3.0) ++alike;
    }
    CHECK(alike >= 0.98 * a.size());
}

TEST_CASE("hairstyle: the first strands of many are the same, but for their number") {
    Hairstyle style = small_style();
    style.add(stream(side(style, 1)));
    style.add(parting(style));
    HairOptions few, many;
    few.roots.count = 200;
    many.roots.count = 1000;
    const Strands a = style.grow(few);
    Strands b = style.grow(many);
    REQUIRE(a.size() == 200);
    REQUIRE(b.size() == 1000);
    for (Index s = 0; s < a.size(); ++s) {
        REQUIRE(a.point_count(s) == b.point_count(s));
        CHECK(a.strand(s) == b.strand(s));
    }
}

TEST_CASE("hairstyle: no hair on the gap of a parting, and as many strands as asked") {
    Hairstyle style = small_style();
    style.add(stream(side(style, 1)));
    StyleCurve line = parting(style);
    std::get<DividingCurve>(line.shape).gap = 0.02;
    const CurveId id = style.add(line);
    HairOptions options;
    options.roots.count = 2000;
    options.growth.length = 0.01;
    const Strands hair = style.grow(options);
    CHECK(hair.size() == 2000);
    const std::vector<Vec3> course = style.course(id);
    double nearest = 1.0;
    for (Index s = 0; s < hair.size(); ++s) {
        const Vec3 root = style.scalp().to_metres(hair.root(s).cast<double>());
        for (const Vec3& p : course) nearest = std::min(nearest, (root - p).norm());
    }
    CHECK(nearest > 0.0095);
    // Without the curve hair grows there again.
    style.enable(id, false);
    const Strands closed = style.grow(options);
    int in_gap = 0;
    for (Index s = 0; s < closed.size(); ++s) {
        const Vec3 root = style.scalp().to_metres(closed.root(s).cast<double>());
        for (const Vec3& p : course) in_gap += (root - p).norm() < 0.009;
    }
    CHECK(in_gap > 5);
}

TEST_CASE("hairstyle: gaps that leave no scalp are refused soon, however wide") {
    Hairstyle style = small_style();
    StyleCurve line = parting(style);
    std::get<DividingCurve>(line.shape).gap = 1e308;
    style.add(line);
    HairOptions options;
    options.roots.count = 20;
    const Error error = error_of([&] { style.grow(options); });
    CHECK(error.code() == ErrorCode::region_empty);
    CHECK(error.message().find("narrower") != std::string::npos);

    int tried = 0;
    const auto bare = [&](const Root&) {
        if (++tried > 1'000'000) FAIL("roots are tried for ever");
        return true;
    };
    CHECK(error_of([&] {
              roots_but_for(small_head(), *small_scalp(), options.roots, bare, {});
          }).code() == ErrorCode::region_empty);
}

TEST_CASE("hairstyle: curves that come together are those that come one by one, all or none") {
    Hairstyle one = small_style(), all = small_style();
    const CurveId first = all.add(stream(side(all, -1)));
    one.add(stream(side(one, -1)));
    const std::vector<StyleCurve> more = {stream(side(one, 1)), parting(one), tail(one)};
    for (const StyleCurve& curve : more) one.add(curve);
    std::vector<StyleCurve> faulty = more;
    std::get<DividingCurve>(faulty[1].shape).gap = -1.0;
    const Error error = error_of([&] { all.add_all(faulty); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.message().rfind("curve 2: the gap", 0) == 0);
    Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { all.add_all(more, cancelled); }).code() == ErrorCode::cancelled);
    CHECK(all.curves().size() == 1);
    const std::vector<CurveId> ids = all.add_all(more);
    CHECK(all.inputs() == one.inputs());
    CHECK(all.curves()[0] == first);
    CHECK(all.curves()[3] == ids[2]);
    CHECK(all.add_all({}).empty());
    CHECK(field_of(all) == field_of(one));
}

TEST_CASE("hairstyle: what growth would refuse of a curve is refused when it is added") {
    Hairstyle style = small_style();
    const auto refused = [&](const StyleCurve& curve, const char* said) {
        const Error error = error_of([&] { style.add(curve); });
        CHECK(error.code() == ErrorCode::invalid_argument);
        CHECK(error.message().find(said) != std::string::npos);
    };
    for (const double weight : {0.0, 1e-7, 1e10, std::nan("")}) {
        CAPTURE(weight);
        for (StyleCurve curve : {stream(side(style, 1)), parting(style), tail(style)}) {
            std::visit([&](auto& shape) { shape.options.weight = weight; }, curve.shape);
            refused(curve, "weight of a curve must be from 1e-6 to 1e9");
        }
    }
    StyleCurve pony = tail(style);
    std::get<Ponytail>(pony.shape).ragged = 1.5;
    refused(pony, "ragged");
    std::get<Ponytail>(pony.shape).ragged = 0.5;
    std::get<Ponytail>(pony.shape).tail_length = -1.0;
    refused(pony, "tail length");
    CHECK(style.curves().empty());
}

TEST_CASE("hairstyle: strands know their roots, texture and tie") {
    Hairstyle style = small_style();
    StyleCurve pony = tail(style);
    pony.name = "pony";
    style.add(pony);
    for (const double azimuth : {40.0, 90.0, 130.0, -40.0, -90.0, -130.0}) {
        StyleCurve lead = stream({over(style, azimuth, 45, 0.01), over(style, 180, 40, 0.012),
                                  over(style, 180, 26, 0.02)});
        std::get<StreamCurve>(lead.shape).options.stop_length = 0.0;
        style.add(lead);
    }
    HairOptions options;
    options.roots.count = 500;
    const Strands hair = style.grow(options);
    REQUIRE(hair.group_names() == std::vector<std::string>{"pony"});
    int caught = 0;
    for (Index s = 0; s < hair.size(); ++s) caught += hair.group(s) == 0;
    CHECK(caught > 50);
    REQUIRE(hair.roots().uvs.size() == 500);
    REQUIRE(hair.roots().faces.size() == 500);
    float least = 1.0f, most = 0.0f;
    for (const auto& uv : hair.roots().uvs) {
        CHECK(uv.minCoeff() >= 0.0f);
        CHECK(uv.maxCoeff() <= 1.0f);
        least = std::min(least, uv.x());
        most = std::max(most, uv.x());
    }
    CHECK(most - least > 0.5f);
}

TEST_CASE("hairstyle: growing into strands again gives the same as anew") {
    Hairstyle style = small_style();
    const CurveId id = style.add(stream(side(style, 1)));
    HairOptions options;
    options.roots.count = 300;
    Strands again;
    style.grow(options, again);
    style.set_points(id, side(style, -1));
    style.grow(options, again);
    CHECK(hash(again) == hash(style.grow(options)));
}

TEST_CASE("hairstyle: the scalp step turns the field along the head, and can be taken back") {
    Hairstyle style = small_style();
    // From the top straight down through the head.
    style.add(stream({Vec3(0, 0.16, 0), Vec3(0, 0.13, 0)}));
    const std::vector<float> before = field_of(style);
    style.avoid_scalp();
    CHECK(style.avoids_scalp());
    double deepest = 0.0;
    for (const double azimuth : {-120.0, -60.0, 0.0, 60.0, 120.0}) {
        const Vec3 p = over(style, azimuth, 40, 0.005);
        const Vec3 normal = p.normalized();
        deepest = std::min(deepest, style.field().sample(p).direction.dot(normal));
    }
    CHECK(deepest > -0.35);
    style.forget_scalp();
    CHECK_FALSE(style.avoids_scalp());
    CHECK(max_difference(before, field_of(style)) < 1e-5);
}

TEST_CASE("hairstyle: its constraints are listed once a point, with kind and curve") {
    Hairstyle style = small_style();
    const CurveId flow = style.add(stream(side(style, 1)));
    const CurveId line = style.add(parting(style));
    const CurveId pony = style.add(tail(style));
    const CurveId off = style.add(stream(side(style, -1)));
    style.enable(off, false);
    style.avoid_scalp();
    const std::vector<StyleConstraint> all = style.constraints();
    CHECK(static_cast<int>(all.size()) == style.field().grid().constraint_count());
    std::array<int, 8> counts{};
    for (const StyleConstraint& one : all) {
        ++counts[static_cast<std::size_t>(one.kind)];
        CHECK(one.vector.norm() <= 1.0 + 1e-9);
        CHECK(one.weight == 100.0);
        const bool own = one.kind == ConstraintKind::stream       ? one.curve == flow
                         : one.kind == ConstraintKind::parting    ? one.curve == line
                         : one.kind == ConstraintKind::separation ? one.curve == line
                         : one.kind == ConstraintKind::section    ? one.curve == pony
                         : one.kind == ConstraintKind::gather     ? one.curve == pony
                         : one.kind == ConstraintKind::scalp      ? !one.curve
                                                                  : one.curve.has_value();
        CHECK(own);
        CHECK_FALSE(one.curve == off);
        // The field keeps them.
        const Vec3 field = style.field().sample(one.point).direction;
        if (one.kind != ConstraintKind::scalp) CHECK((field - one.vector).norm() < 0.3);
    }
    for (const ConstraintKind kind :
         {ConstraintKind::stream, ConstraintKind::stop, ConstraintKind::parting,
          ConstraintKind::separation, ConstraintKind::section, ConstraintKind::gather,
          ConstraintKind::scalp}) {
        CAPTURE(kind_name(kind));
        CHECK(counts[static_cast<std::size_t>(kind)] > 0);
    }
}

TEST_CASE("hairstyle: refused curves leave everything as it was") {
    Hairstyle style = small_style();
    const CurveId id = style.add(stream(side(style, 1)));
    const std::vector<float> before = field_of(style);
    const auto add = [&](StyleCurve curve) { return error_of([&] { style.add(curve); }).code(); };
    CHECK(add(stream({})) == ErrorCode::invalid_argument);
    CHECK(add(stream({Vec3(0, 0.1, 0)})) == ErrorCode::invalid_argument);
    CHECK(add(stream({Vec3(0, 0.1, 0), Vec3(0, kNaN, 0)})) == ErrorCode::not_finite);
    CHECK(add(stream({Vec3(5, 5, 5), Vec3(6, 5, 5)})) == ErrorCode::out_of_range);
    CHECK(add({DividingCurve{{Vec3(0, 0.3, 0), Vec3(0, 0.35, 0)}}}) == ErrorCode::out_of_range);
    CHECK(add({Ponytail{{Vec3(0, 0.1, -0.1)}}}) == ErrorCode::invalid_argument);
    StyleCurve negative = stream(side(style, 1));
    std::get<StreamCurve>(negative.shape).clearance = -1.0;
    CHECK(add(negative) == ErrorCode::invalid_argument);
    const std::vector<Vec3> outside = {Vec3(5, 5, 5), Vec3(6, 5, 5)};
    CHECK(error_of([&] { style.set_points(id, outside); }).code() == ErrorCode::out_of_range);
    CHECK(style.curves().size() == 1);
    CHECK(style.solved());
    CHECK(field_of(style) == before);
}

TEST_CASE("hairstyle: hair leaves a parting that is added after it has grown") {
    HairOptions options;
    options.roots.count = 800;
    StyleCurve line = parting(small_style());
    std::get<DividingCurve>(line.shape).gap = 0.01;
    Hairstyle grown = small_style(), fresh = small_style();
    grown.add(stream(side(grown, 1)));
    grown.grow(options);
    grown.add(line);
    fresh.add(stream(side(fresh, 1)));
    fresh.add(line);
    CHECK(hash(grown.grow(options)) == hash(fresh.grow(options)));
}

TEST_CASE("hairstyle: what is beyond its limit is refused, and the limit is told") {
    Hairstyle style = small_style();
    style.add(stream(side(style, 1)));
    const Box box = style.layout().box();
    const auto told = [](const Error& error, const std::string& text) {
        CAPTURE(error.message());
        return error.code() == ErrorCode::invalid_argument &&
               error.message().find(text) != std::string::npos;
    };
    const auto grow = [&](const auto& change) {
        HairOptions options;
        options.roots.count = 20;
        change(options.growth);
        return error_of([&] { style.grow(options); });
    };
    const std::string most = length_text(longest_hair(style.layout()));
    CHECK(longest_hair(style.layout()) == doctest::Approx(2.0 * box.diagonal()));
    CHECK(told(grow([](GrowthOptions& o) { o.length = 50.0; }), most));
    CHECK(told(grow([](GrowthOptions& o) {
                   o.length_map.assign(static_cast<std::size_t>(small_head().vertex_count()), 20.0);
               }),
               most));
    CHECK(told(grow([](GrowthOptions& o) { o.segment = 1e-9; }), "0.01"));
    CHECK(told(grow([](GrowthOptions& o) { o.segment = 11.0; }), "10 steps"));

    const auto add = [&](StyleCurve curve) { return error_of([&] { style.add(curve); }); };
    StyleCurve wide = tail(style), inside = tail(style), long_tail = tail(style);
    std::get<Ponytail>(wide.shape).options.radius = 5.0;
    CHECK(told(add(wide), length_text(0.5 * (box.max - box.min).minCoeff())));
    for (Vec3& p : std::get<Ponytail>(inside.shape).spine) p.z() += 0.06;
    CHECK(told(add(inside), "inside the head"));
    CHECK(style.curves().size() == 1);
    std::get<Ponytail>(long_tail.shape).tail_length = 50.0;
    style.add(long_tail);
    CHECK(told(grow([](GrowthOptions&) {}), "tail"));
}

TEST_CASE("hairstyle: a grid that does not fit into memory is refused before it is made") {
    ContextOptions limited;
    limited.memory_limit = std::size_t{1} << 30;
    const Context context(limited);
    HairstyleOptions huge;
    // Grids have fewer points where addresses have 32 bits.
    huge.resolution = sizeof(std::size_t) < 8 ? 12'000'000 : 190'000'000;
    const Error error = error_of([&] { Hairstyle(small_head(), small_scalp(), huge, context); });
    CHECK(error.code() == ErrorCode::memory_limit);
    CHECK(error.message().find(" GB") != std::string::npos);
    CHECK(context.memory()->peak() == 0);
    // What it says would fit does.
    const std::size_t at = error.message().find("at most ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stol(error.message().substr(at + 8)) > 5'000'000);
    if (machine_memory() > 0) CHECK(machine_memory() > (std::size_t{1} << 28));
}

TEST_CASE("hairstyle: a large grid is given up soon after it was cancelled") {
    HairstyleOptions large;
    large.resolution = 1'000'000;
    for (const double share : {0.0, 0.1, 0.25}) {
        Context* running = nullptr;
        ContextOptions options;
        options.progress = [&](std::string_view, double fraction) {
            if (fraction >= share) running->cancel();
        };
        Context context(options);
        running = &context;
        CHECK(error_of([&] { Hairstyle(small_head(), small_scalp(), large, context); }).code() ==
              ErrorCode::cancelled);
    }
}

TEST_CASE("hairstyle: the distance to the surface is that of the surface, not of the grid") {
    const Hairstyle style = small_style();
    const Scalp& scalp = style.scalp();
    const SpatialTree tree(style.head());
    RandomPoints random(5);
    double worst = 0.0, grid = 0.0;
    for (int i = 0; i < 400; ++i) {
        const ScalpDirection direction{random.uniform(-3.1, 3.1), random.uniform(0.5, 1.5)};
        const double lift = random.uniform(-0.006, 0.006);
        const Vec3 p = scalp.to_metres(scalp.at(direction, lift).position);
        const double exact = std::copysign(tree.nearest(p).distance, lift);
        worst = std::max(worst, std::abs(style.surface_distance(p) - exact));
        grid = std::max(grid, std::abs(style.field().distances().value(p) - exact));
    }
    CHECK(worst < 1e-9);
    CHECK(grid > 1e-4);
    CHECK(style.surface_distance(Vec3::Zero()) < -0.03);
}

TEST_CASE("hairstyle: what cannot be made or grown is refused") {
    Hairstyle style = small_style();
    CHECK(error_of([&] { style.grow(); }).code() == ErrorCode::invalid_argument);
    style.enable(style.add(stream(side(style, 1))), false);
    CHECK(error_of([&] { style.grow(); }).code() == ErrorCode::invalid_argument);
    const Mesh other = make_head({.vertices = 4000});
    CHECK(error_of([&] { Hairstyle(other, small_scalp()); }).code() ==
          ErrorCode::topology_mismatch);
    HairstyleOptions flat;
    flat.volume = Box{Vec3(0, 0, 0), Vec3(1, 0, 1)};
    CHECK(error_of([&] { Hairstyle(small_head(), small_scalp(), flat); }).code() ==
          ErrorCode::invalid_argument);
    HairstyleOptions coarse;
    coarse.resolution = 10;
    CHECK(error_of([&] { Hairstyle(small_head(), small_scalp(), coarse); }).code() ==
          ErrorCode::invalid_argument);
    style.enable(style.curves()[0], true);
    HairOptions none;
    none.roots.count = 0;
    CHECK(style.grow(none).empty());
}

TEST_CASE("hairstyle: a parting keeps its hints, and all of a side tell its tilt together") {
    Hairstyle style = small_style();
    const CurveId parting = style.add(test::parting(style)),
                  other = style.add(stream(side(style, 1)));
    const StyleInputs before = style.inputs();
    const auto field = field_of(style);
    CHECK(style.tilt(parting).left.tilt == DividingOptions::Tilt{});
    // From the front to the back: the head's left is the curve's right.
    const auto hint = [&](double elevation) {
        return std::vector<Vec3>{over(style, 15, elevation, 0), over(style, 24, elevation + 9, 0)};
    };
    style.add_hint(parting, hint(52));
    const SideTilt one = style.tilt(parting).left;
    const bool is_left = one.pieces > 0;
    const auto told = [&] {
        const TiltFit& fit = style.tilt(parting);
        return is_left ? fit.left : fit.right;
    };
    CHECK(told().pieces > 3);
    CHECK(std::abs(told().tilt.start - told().tilt.end) < 0.3);
    const StyleInputs first = style.inputs();
    const auto pieces = told().pieces;
    style.add_hint(parting, hint(70));
    CHECK(told().pieces > pieces);
    CHECK(field_of(style) != field);
    // What is put back is all of it.
    const TiltFit both = style.tilt(parting);
    const StyleInputs last = style.inputs();
    style.restore(first);
    CHECK(told().pieces == pieces);
    style.restore(before);
    CHECK(field_of(style) == field);
    style.restore(last);
    CHECK(style.tilt(parting) == both);
    // A curve that leaves its hints has the tilts of its options again.
    StyleCurve moved = style.curve(parting);
    std::get<DividingCurve>(moved.shape).options.left = {0.2, 0.2};
    std::get<DividingCurve>(moved.shape).options.right = {0.2, 0.2};
    drawn_points(moved) = {over(style, -60, 50, 0), over(style, -100, 50, 0)};
    style.set(parting, moved);
    CHECK(told().pieces == 0);
    CHECK(told().tilt == DividingOptions::Tilt{0.2, 0.2});
    style.restore(last);

    const auto refused = [&](CurveId id, std::vector<Vec3> points) {
        return error_of([&] { style.add_hint(id, std::move(points)); }).code();
    };
    CHECK(refused(other, hint(60)) == ErrorCode::invalid_argument);
    CHECK(refused(CurveId{99}, hint(60)) == ErrorCode::handle_removed);
    CHECK(refused(parting, {over(style, 180, 0, 0), over(style, 160, 0, 0)}) ==
          ErrorCode::out_of_range);
    CHECK(refused(parting, {Vec3::Constant(std::nan("")), Vec3::Zero()}) == ErrorCode::not_finite);
    CHECK(refused(parting, {}) == ErrorCode::invalid_argument);
    CHECK(style.inputs() == last);
    CHECK(error_of([&] { (void)style.tie(parting); }).code() == ErrorCode::invalid_argument);
    CHECK(style.tie(style.add(tail(style))).radius > 0.0);
}
