#include "kernel/hair/operators/strand_detail.h"

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A helix of 3 mm about a bowed course, of `length` metres along it.
Strands ringlet(double length = 0.2, Index points = 161) {
    std::vector<float> list;
    for (Index k = 0; k < points; ++k) {
        const double a = length * k / (points - 1), turn = 2.0 * kPi * a / 0.025;
        const double radius = 0.003 * std::min(1.0, a / 0.02), bow = 1.5 * a;
        const Vec3 course = Vec3(std::sin(bow), 1.0 - std::cos(bow), 0.0) / 1.5;
        const Vec3 normal(-std::sin(bow), std::cos(bow), 0.0);
        const Vec3 p = course + radius * (std::cos(turn) * normal + std::sin(turn) * Vec3::UnitZ());
        for (const double x : p) list.push_back(static_cast<float>(x));
    }
    return {std::move(list), {0, points}};
}

// Bowed strands without details, from different roots.
Strands smooth_hair(Index count, double length, Index points) {
    std::vector<float> list;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < count; ++s) {
        for (Index k = 0; k < points; ++k) {
            const double a = length * k / (points - 1);
            const Vec3 p(0.01 * s + 2.0 * a * a, 0.3 * a * s / count, -a + 1.0 * a * a);
            for (const double x : p) list.push_back(static_cast<float>(x));
        }
        offsets.push_back(offsets.back() + points);
    }
    return {std::move(list), std::move(offsets)};
}

double difference(const Strands& a, const Strands& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.points().size(); ++i) {
        worst = std::max(worst, std::abs(double(a.points()[i]) - b.points()[i]));
    }
    return worst;
}

double straight_length(const Strands& strands, Index s) {
    return double((strands.strand(s).col(strands.point_count(s) - 1) - strands.root(s)).norm());
}

double bend_between(const StrandView& strand, Index k) {
    const Vec3 a = point_of(strand, k) - point_of(strand, k - 1);
    const Vec3 b = point_of(strand, k + 1) - point_of(strand, k);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Sum of the angles between segments, and the greatest.
double turning(const StrandView& strand) {
    double sum = 0.0;
    for (Index k = 1; k + 1 < strand.cols(); ++k) sum += bend_between(strand, k);
    return sum;
}
double sharpest(const StrandView& strand) {
    double most = 0.0;
    for (Index k = 1; k + 1 < strand.cols(); ++k) most = std::max(most, bend_between(strand, k));
    return most;
}

void turn(Strands& strands, const Mat3& rotation) {
    for (Index s = 0; s < strands.size(); ++s) {
        StrandEdit edit = strands.edit_strand(s);
        edit = (rotation.cast<float>() * edit).eval();
    }
}

}  // namespace

TEST_CASE("details of a strand given to it leave it as it is") {
    const Strands example = ringlet();
    for (const bool keep : {true, false}) {
        Strands made = example;
        DetailOptions options;
        options.keep_length = keep;
        add_detail(made, example, options);
        CHECK(made.point_count() == example.point_count());
        CHECK(difference(made, example) < 1e-6);
    }
}

TEST_CASE("a smooth strand with the details of a helix winds as often as the helix does") {
    const Strands example = ringlet();
    Strands made = smooth_hair(20, 0.2, 41);
    const double before = turning(made.strand(3));
    add_detail(made, example);
    for (Index s = 0; s < made.size(); ++s) {
        // The helix is longer than its course, and so has more turns than as much hair.
        const double part = length(made.strand(s)) / length(example.strand(0));
        CHECK(turning(made.strand(s)) ==
              doctest::Approx(part * turning(example.strand(0)) + before).epsilon(0.1));
        CHECK(made.point_count(s) > 100);
    }
}

TEST_CASE("details keep roots, and lengths unless they are asked not to") {
    const Strands before = smooth_hair(30, 0.25, 60);
    DetailOptions options;
    Strands made = before;
    add_detail(made, ringlet(), options);
    for (Index s = 0; s < made.size(); ++s) {
        CHECK(made.root(s) == before.root(s));
        CHECK(length(made.strand(s)) == doctest::Approx(length(before.strand(s))).epsilon(1e-3));
        CHECK(straight_length(made, s) < 0.97 * straight_length(before, s));
    }
    options.keep_length = false;
    made = before;
    add_detail(made, ringlet(), options);
    for (Index s = 0; s < made.size(); ++s) {
        CHECK(length(made.strand(s)) > 1.1 * length(before.strand(s)));
        CHECK(straight_length(made, s) ==
              doctest::Approx(straight_length(before, s)).epsilon(0.05));
    }
}

TEST_CASE("details turn with the strand that gets them, and not with the example") {
    const Mat3 rotation = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
    const Strands hair = smooth_hair(10, 0.2, 161), example = ringlet();
    Strands made = hair, turned = hair, turned_example = example, other = hair;
    add_detail(made, example);
    turn(turned, rotation);
    add_detail(turned, example);
    Strands expected = made;
    turn(expected, rotation);
    CHECK(difference(turned, expected) < 2e-5);
    turn(turned_example, rotation);
    add_detail(other, turned_example);
    CHECK(difference(other, made) < 2e-5);
}

TEST_CASE("strands longer than their example repeat it without a kink") {
    Strands made = smooth_hair(4, 0.6, 481);
    const Strands example = ringlet();
    DetailOptions options;
    options.keep_length = false;
    add_detail(made, example, options);
    CHECK(sharpest(made.strand(0)) < 1.6 * sharpest(example.strand(0)));
    // It winds in its last third as much as in its middle one.
    const StrandView strand = made.strand(0);
    const auto third = index_of(strand.cols()) / 3;
    const StrandView middle(strand.col(third).data(), 3, third);
    const StrandView last(strand.col(2 * third).data(), 3, third);
    CHECK(turning(last) == doctest::Approx(turning(middle)).epsilon(0.2));
}

TEST_CASE("twice the scale is twice as wide and long a detail") {
    Strands made = smooth_hair(2, 0.2, 161);
    DetailOptions options;
    options.scale = 2.0;
    options.keep_length = false;
    add_detail(made, ringlet(), options);
    Strands same = smooth_hair(2, 0.2, 161);
    options.scale = 1.0;
    add_detail(same, ringlet(), options);
    CHECK(turning(made.strand(0)) < 0.7 * turning(same.strand(0)));
    CHECK(length(made.strand(0)) == doctest::Approx(length(same.strand(0))).epsilon(0.1));
}

TEST_CASE("strands of one guide take the details of one example") {
    Strands hair = smooth_hair(40, 0.2, 161);
    GuideOptions guides;
    guides.count = 2;
    assign_guides(hair, guides);
    Strands examples = ringlet();
    for (Index i = 1; i < 8; ++i) append(examples, ringlet(0.2 - 0.01 * i));
    add_detail(hair, examples);
    std::vector<Index> numbers(at(hair.size()));
    double apart = 0.0;
    for (Index s = 0; s < hair.size(); ++s) {
        if (hair.guides().ids[at(s)] != hair.guides().ids[0]) continue;
        apart = std::max(apart, std::abs(turning(hair.strand(s)) - turning(hair.strand(0))));
    }
    CHECK(apart < 3.0);
}

TEST_CASE("details alone hang straight, and give the same hair as their example") {
    const Strands example = ringlet(), wisps = details(example);
    CHECK(wisps.root(0) == example.root(0));
    const Eigen::Vector3f way = wisps.strand(0).col(wisps.point_count(0) - 1) - wisps.root(0);
    CHECK(double(-way.y()) > 0.95 * double(way.norm()));
    Strands a = smooth_hair(3, 0.2, 161), b = a;
    DetailOptions options;
    options.resample = false;
    add_detail(a, example, options);
    add_detail(b, wisps, options);
    CHECK(turning(a.strand(1)) == doctest::Approx(turning(b.strand(1))).epsilon(0.1));
}

TEST_CASE("examples without bends are refused, and strands stay as they were") {
    Strands hair = smooth_hair(5, 0.2, 41);
    const std::uint64_t before = hash(hair);
    const auto refused = [&](const Strands& examples, const DetailOptions& options = {}) {
        const Error error = error_of([&] { add_detail(hair, examples, options); });
        CHECK(hash(hair) == before);
        return error.code() == ErrorCode::invalid_argument;
    };
    CHECK(refused(Strands()));
    CHECK(refused(strands_of({{{0, 0, 0}, {0, 1, 0}}})));
    CHECK(refused(strands_of({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}})));
    CHECK(refused(strands_of({{{0, 0, 0}, {0, std::nanf(""), 0}, {0, 1, 0}}})));
    DetailOptions options;
    options.span = 0.0;
    CHECK(refused(ringlet(), options));
    options = {};
    options.scale = INFINITY;
    CHECK(refused(ringlet(), options));
}
