#include "kernel/hair/curve/stream_curve.h"

#include <array>
#include <map>

#include "kernel/hair/curve/curve.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

GridLayout unit_grid() {
    return {{12, 10, 8}, Vec3(-1, 2, 3), 0.5};
}

Vec3 place(const GridLayout& layout, Index point) {
    const Index nx = layout.counts[0], ny = layout.counts[1];
    return layout.point(point % nx, point / nx % ny, point / nx / ny);
}

const StreamOptions kNoStop{0.0};

}  // namespace

TEST_CASE("stream: corners of the cells along a straight curve take its direction") {
    const GridLayout grid = unit_grid();
    const Vec3 a = grid.point(1, 2, 3) + Vec3(0.1, 0.2, 0.15), b = a + Vec3(3, 0, 0);
    const std::vector<GridConstraint> all =
        stream_constraints(grid, resampled_curve(std::vector{a, b}, grid.step), kNoStop);
    // Seven planes of four corners around six middles.
    CHECK(all.size() == 28);
    for (const GridConstraint& c : all) {
        CHECK((c.value - Vec3::UnitX()).norm() < 1e-12);
        CHECK(c.weight == 100.0);
        CHECK((place(grid, c.point) - a).tail<2>().cwiseAbs().maxCoeff() < grid.step);
    }
    CHECK(std::is_sorted(all.begin(), all.end(),
                         [](const auto& p, const auto& q) { return p.point < q.point; }));
}

TEST_CASE("stream: a corner that is given several vectors takes their mean by trilinear weights") {
    const GridLayout grid = unit_grid();
    const std::array<Vec3, 2> at{Vec3(0.25, 0.125, 0.5), Vec3(0.625, 0.75, 0.25)};
    const std::array<Vec3, 2> given{Vec3::UnitX(), Vec3::UnitY()};
    VectorSplat splat(grid);
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(splat.add(grid.point(2, 3, 4) + grid.step * at[k], given[k], ConstraintKind::stream));
    }
    const std::vector<GridConstraint> all = splat.constraints(7.0);
    REQUIRE(all.size() == 8);
    for (const GridConstraint& c : all) {
        const Vec3 corner = (place(grid, c.point) - grid.point(2, 3, 4)) / grid.step;
        Vec3 sum = Vec3::Zero();
        double weights = 0.0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double weight = (Vec3::Ones() - (at[k] - corner).cwiseAbs()).prod();
            sum += weight * given[k];
            weights += weight;
        }
        CHECK((c.value - sum / weights).norm() < 1e-12);
    }
}

TEST_CASE("stream: a curve and its reverse give opposite constraints at the same points") {
    const GridLayout grid = unit_grid();
    std::vector<Vec3> curve =
        smooth_curve(std::vector<Vec3>{{0, 3, 4}, {1, 4, 4.5}, {2.5, 4, 5.5}, {3, 5, 6}}, 0.1);
    curve = resampled_curve(curve, grid.step);
    const auto forth = stream_constraints(grid, curve, kNoStop);
    std::reverse(curve.begin(), curve.end());
    const auto back = stream_constraints(grid, curve, kNoStop);
    REQUIRE(forth.size() == back.size());
    for (std::size_t i = 0; i < forth.size(); ++i) {
        CHECK(forth[i].point == back[i].point);
        CHECK((forth[i].value + back[i].value).norm() < 1e-12);
        CHECK(forth[i].value.norm() <= 1.0 + 1e-12);
        CHECK(forth[i].value.norm() > 0.7);
    }
}

TEST_CASE("stream: beyond the end vectors vanish evenly") {
    const GridLayout grid = unit_grid();
    const std::vector<Vec3> line{grid.point(1, 4, 4) + Vec3(0.0, 0.25, 0.25),
                                 grid.point(4, 4, 4) + Vec3(0.0, 0.25, 0.25)};
    const auto plain = stream_constraints(grid, resampled_curve(line, grid.step), kNoStop);
    const auto stopped = stream_constraints(grid, resampled_curve(line, grid.step), {2.0});
    CHECK(stopped.size() > plain.size());
    std::map<double, double> length;
    for (const GridConstraint& c : stopped) length[place(grid, c.point).x()] = c.value.norm();
    double before = 2.0;
    for (const auto& [x, size] : length) {
        CHECK(size <= before + 1e-12);
        before = size;
    }
    CHECK(length.begin()->second == Approx(1.0));
    CHECK(length.rbegin()->second == Approx(0.0));
}

TEST_CASE("stream: what leaves the grid is left out; a curve that is all outside is refused") {
    const GridLayout grid = unit_grid();
    const Vec3 inside = grid.point(10, 4, 4) + Vec3(0.1, 0.1, 0.1);
    const std::vector<Vec3> leaving{inside, inside + Vec3(20, 0, 0)};
    for (const GridConstraint& c : stream_constraints(grid, resampled_curve(leaving, 0.5), {})) {
        CHECK(c.point < grid.size());
    }
    const std::vector<Vec3> away{{100, 100, 100}, {101, 100, 100}};
    CHECK(test::error_of([&] { stream_constraints(grid, away, {}); }).code() ==
          ErrorCode::out_of_range);
    const std::vector<Vec3> very_far{{1e300, 0, 0}, {1e300, 1e299, 0}};
    CHECK(test::error_of([&] { stream_constraints(grid, very_far, {}); }).code() ==
          ErrorCode::out_of_range);
}
