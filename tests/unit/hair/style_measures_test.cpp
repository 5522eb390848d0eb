#include "kernel/hair/style_measures.h"

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/stream_curve.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Strands strands_of(const std::vector<std::vector<Vec3>>& all) {
    std::vector<float> points;
    std::vector<Index> offsets{0};
    for (const std::vector<Vec3>& strand : all) {
        for (const Vec3& p : strand) {
            for (int d = 0; d < 3; ++d) points.push_back(static_cast<float>(p[d]));
        }
        offsets.push_back(static_cast<Index>(points.size() / 3));
    }
    return {points, offsets};
}

// A generated head; the frame of its scalp is that of the mesh, in metres.
struct Bald {
    Mesh head = make_head({.vertices = 4000});
    Scalp scalp{head};
    HairField field{DistanceGrid(head, fit_grid(scalp.default_box(), 30000))};
    std::vector<Root> roots = make_roots(head, scalp, {.count = 4000});

    double step() const { return field.layout().step; }
    // Degrees, millimetres.
    Vec3 at(double azimuth, double elevation, double lift) const {
        return scalp.at({azimuth * kPi / 180, elevation * kPi / 180}, 1e-3 * lift).position;
    }
    void stream(ConstraintOwner owner, const std::vector<Vec3>& points, double stop) {
        std::vector<Vec3> curve = smooth_curve(points, 0.2 * step());
        push_out(curve, field.distances(), 0.002);
        curve = resampled_curve(curve, step());
        field.set_constraints(owner, stream_constraints(field.layout(), curve, {stop}));
    }
    Strands grown(double length) {
        field.solve();
        GrowthOptions options;
        options.length = length;
        Strands strands;
        grow(head, field, roots, options, strands);
        return strands;
    }
};

}  // namespace

TEST_CASE("measures: crossings of a line are counted near it and near the root") {
    const DividingLine line(std::vector<Vec3>{{0, 0, 0}, {0, 0, -0.1}},
                            std::vector<Vec3>{Vec3::UnitY(), Vec3::UnitY()});
    const auto strand = [](double x, double z, double reach) {
        return std::vector<Vec3>{{x, 0, z}, {x, 0.005, z}, {x + reach, 0.005, z}};
    };
    const Strands strands = strands_of({
        strand(0.01, -0.05, 0.02),    // away from the line
        strand(0.01, -0.05, -0.02),   // across it
        strand(-0.01, -0.05, 0.012),  // across it the other way
        strand(0.019, -0.05, -0.04),  // farther along than asked
        strand(0.03, -0.05, -0.05),   // rooted too far from it
        strand(0.01, 0.015, -0.02),   // past the end of the line
        {{0.01, 0, -0.02}},           // no hair
    });
    CrossingOptions options;
    options.reach = 0.02;
    const StrandFraction count = parting_crossings(strands, line, options);
    CHECK(count.strands == 6);
    CHECK(count.found == 2);
    CHECK(count.fraction() == Approx(2.0 / 6.0));
    CHECK(parting_crossings(strands, line, {0.02, 0.03}).found == 3);
    CHECK(parting_crossings(Strands(), line).fraction() == 0.0);
    CHECK(test::error_of([&] {
              parting_crossings(strands, line, {-1.0, 0.0});
          }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("measures: passages go through the circle, in its direction") {
    const PonytailSection section{{0, 0, -0.1}, -Vec3::UnitZ(), 0.02};
    const Strands strands = strands_of({
        {{0, 0, 0}, {0.01, 0, -0.2}},
        {{0.05, 0, 0}, {0.05, 0, -0.2}},                        // beside it
        {{0, 0, -0.2}, {0, 0, 0}},                              // the other way
        {{0, 0, 0}, {0.05, 0, -0.2}, {0, 0, 0}, {0, 0, -0.2}},  // beside it, back, and through
        {{0, 0, 0}},
    });
    const StrandFraction count = section_passages(strands, section);
    CHECK(count.strands == 5);
    CHECK(count.found == 2);
}

TEST_CASE("measures: hair does not cross an oblique parting") {
    Bald bald;
    // The directions of the curve of a side parting.
    std::vector<Vec3> points;
    for (const auto& [azimuth, elevation] :
         {std::pair{-22.0, 37.0}, {-28.0, 52.0}, {-42.0, 68.0}, {-70.0, 76.0}}) {
        points.push_back(bald.at(azimuth, elevation, 0));
    }
    points = resampled_curve(smooth_curve(points, 0.002), bald.step());
    std::vector<Vec3> normals;
    for (Vec3& p : points) {
        const ScalpPoint on_scalp = bald.scalp.at(bald.scalp.direction_of(p));
        p = on_scalp.position;
        normals.push_back(on_scalp.normal);
    }
    for (const double side : {1.0, -1.0}) {
        bald.stream(
            side > 0 ? 1 : 2,
            {bald.at(side * 60, 60, 15), bald.at(side * 88, 30, 20), bald.at(side * 95, 0, 20)},
            0.04);
    }
    bald.stream(3, {bald.at(180, 65, 10), bald.at(180, 30, 20), bald.at(180, -20, 20)}, 0.04);
    const DividingLine line(points, normals);
    const auto crossing = [&](const DividingOptions& options) {
        bald.field.set_constraints(
            4, dividing_constraints(bald.field.distances(), points, normals, options));
        Strands strands = bald.grown(0.06);
        return parting_crossings(strands, line);
    };
    const StrandFraction count = crossing({});
    CHECK(count.strands > 150);
    CHECK(count.fraction() < 0.01);
    // Without the curve hair flows over it.
    bald.field.set_constraints(4, {});
    CHECK(parting_crossings(bald.grown(0.06), line).fraction() > 0.05);
}

TEST_CASE("measures: hair that is gathered passes through the tie") {
    Bald bald;
    const Vec3 tie = bald.at(180, 20, 20);
    PonytailOptions options;
    options.radius = 0.022;
    const std::vector<Vec3> spine{tie, tie + Vec3(0, 0.005, -0.03), tie + Vec3(0, -0.02, -0.07),
                                  tie + Vec3(0, -0.15, -0.08)};
    const PonytailShape shape =
        ponytail_shape(smooth_curve(spine, 0.3 * bald.step()), bald.step(), options);
    bald.field.set_constraints(1, ponytail_constraints(bald.field.distances(), shape, options));
    ConstraintOwner owner = 2;
    for (int k = 0; k < 8; ++k) {
        const double angle = 2.0 * kPi * k / 8.0;
        std::vector<Vec3> points;
        for (const double away : {55.0, 35.0, 20.0}) {
            points.push_back(bald.at(180 + away * std::cos(angle), 20 + away * std::sin(angle),
                                     5 + 0.2 * (55 - away)));
        }
        points.push_back(tie + 0.4 * 0.022 * Vec3(-std::cos(angle), std::sin(angle), 0.0));
        bald.stream(owner++, points, 0.0);
    }
    const StrandFraction count = section_passages(bald.grown(0.5), shape.tie());
    CHECK(count.strands == 4000);
    CHECK(count.fraction() > 0.98);
}
