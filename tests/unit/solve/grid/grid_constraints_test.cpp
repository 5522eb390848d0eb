#include "kernel/solve/grid/grid_constraints.h"

#include <limits>

#include "kernel/solve/grid/constraint_rows.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

const GridSize kSize{10, 10, 10};

ConstraintRows rows_of(const GridConstraints& constraints) {
    const auto merged = constraints.merged();
    return rows_in_order(kSize, merged, arrange_rows(merged));
}

std::vector<Index> points(const ConstraintRows& rows) {
    std::vector<Index> result;
    for (const GridPoint& p : rows.point) result.push_back(kSize.index(p));
    return result;
}

}  // namespace

TEST_CASE("grid constraints: owners of one point are averaged by the squares of their weights") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{5, Vec3(1.0, 0.0, 0.0), 3.0}, {4, Vec3(2.0, 2.0, 2.0), 0.1}});
    constraints.set(2, {{5, Vec3(0.0, 1.0, 0.0), 4.0}});
    const auto merged = constraints.merged();
    REQUIRE(merged.size() == 2);
    CHECK(merged[0].point == 4);
    CHECK(merged[0].weight == 0.1);
    CHECK(merged[0].value == Vec3(2.0, 2.0, 2.0));
    CHECK(merged[1].weight == 4.0);
    CHECK((merged[1].value - Vec3(9.0 / 25.0, 16.0 / 25.0, 0.0)).norm() < 1e-15);
}

TEST_CASE("grid constraints: an owner is replaced as a whole, and gone with none") {
    GridConstraints constraints(kSize);
    constraints.set(7, {{1}, {2}});
    constraints.set(7, {{3}});
    CHECK(constraints.of(7).size() == 1);
    CHECK(constraints.owners() == std::vector<ConstraintOwner>{7});
    constraints.set(7, {});
    CHECK(constraints.of(7).empty());
    CHECK(constraints.merged().empty());
}

TEST_CASE("grid constraints: new vectors at the same points leave the stamp") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{1}, {2}});
    const auto stamp = [&] { return constraints.merged()[0].stamp; };
    const auto before = stamp(), version = constraints.version();
    constraints.set(1, {{2, Vec3::UnitX()}, {1, Vec3::UnitX()}});
    CHECK(stamp() == before);
    CHECK(constraints.version() > version);
    constraints.set(1, {{2, Vec3::UnitX()}, {1, Vec3::UnitX(), 50.0}});
    CHECK(stamp() > before);
}

TEST_CASE("grid constraints: bad ones are refused, and nothing has changed") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{1}});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto code = [&](const GridConstraint& c) {
        return test::error_of([&] { constraints.set(1, {{2}, c}); }).code();
    };
    CHECK(code({-1}) == ErrorCode::out_of_range);
    CHECK(code({1000}) == ErrorCode::out_of_range);
    CHECK(code({3, Vec3(0.0, nan, 0.0)}) == ErrorCode::not_finite);
    CHECK(code({3, Vec3::Zero(), nan}) == ErrorCode::not_finite);
    CHECK(code({3, Vec3::Zero(), 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({3, Vec3::Zero(), -5.0}) == ErrorCode::invalid_argument);
    CHECK(code({2}) == ErrorCode::invalid_argument);
    REQUIRE(constraints.merged().size() == 1);
    CHECK(constraints.merged()[0].point == 1);
}

TEST_CASE("constraint rows: an owner that moves goes last and then only its rows change") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{10}, {11}});
    constraints.set(2, {{20}, {21}});
    CHECK(points(rows_of(constraints)) == std::vector<Index>{10, 11, 20, 21});
    constraints.set(1, {{11}, {12}});
    const ConstraintRows moved = rows_of(constraints);
    CHECK(points(moved) == std::vector<Index>{20, 21, 11, 12});
    constraints.set(1, {{12}, {13}});
    const ConstraintRows again = rows_of(constraints);
    CHECK(points(again) == std::vector<Index>{20, 21, 12, 13});
    CHECK(moved.common(again) == 2);
}

TEST_CASE("constraint rows: a point that another owner holds, too, stays where it is") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{10}, {11}});
    constraints.set(2, {{11}, {21}});
    CHECK(points(rows_of(constraints)) == std::vector<Index>{10, 11, 21});
    constraints.set(2, {{10}, {22}});
    CHECK(points(rows_of(constraints)) == std::vector<Index>{10, 11, 22});
}

TEST_CASE("constraint rows: other values leave an owner in its place") {
    GridConstraints constraints(kSize);
    constraints.set(1, {{10}, {11}});
    constraints.set(2, {{5}, {6}});
    constraints.set(1, {{10, Vec3::UnitX()}, {11}});
    CHECK(points(rows_of(constraints)) == std::vector<Index>{10, 11, 5, 6});
}
