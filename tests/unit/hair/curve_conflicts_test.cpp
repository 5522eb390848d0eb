// What holds where curves say different things.
#include "kernel/hair/curve_conflicts.h"

#include <doctest/doctest.h>

using namespace lissom;

namespace {

CurveClaim claim(int rank, std::vector<GridConstraint> constraints) {
    return {std::move(constraints), rank};
}

}  // namespace

TEST_CASE("claims to different points stay as they are") {
    std::vector<CurveClaim> claims = {claim(0, {{1, {1, 0, 0}, 100.0}, {2, {0, 1, 0}, 100.0}}),
                                      claim(0, {{3, {0, 0, 1}, 50.0}})};
    settle_conflicts(claims);
    CHECK(claims[0].constraints[0].value == Vec3(1, 0, 0));
    CHECK(claims[0].constraints[1].value == Vec3(0, 1, 0));
    CHECK(claims[1].constraints[0].value == Vec3(0, 0, 1));
    CHECK(claims[1].constraints[0].weight == 50.0);
}

TEST_CASE("claims that agree share a point by their weights") {
    std::vector<CurveClaim> claims = {claim(0, {{7, {1, 0, 0}, 100.0}}),
                                      claim(0, {{7, Vec3(1, 1, 0).normalized(), 100.0}})};
    settle_conflicts(claims);
    const Vec3 mean = 0.5 * (Vec3(1, 0, 0) + Vec3(1, 1, 0).normalized());
    CHECK((claims[0].constraints[0].value - mean).norm() < 1e-15);
    CHECK(claims[0].constraints[0].value == claims[1].constraints[0].value);
    CHECK(claims[0].constraints[0].weight == claims[1].constraints[0].weight);
}

TEST_CASE("of claims that contradict each other the last counts") {
    std::vector<CurveClaim> claims = {claim(0, {{7, {1, 0, 0}, 100.0}}),
                                      claim(0, {{7, {-1, 0, 0}, 30.0}})};
    settle_conflicts(claims);
    for (const CurveClaim& one : claims) {
        CHECK(one.constraints[0].value == Vec3(-1, 0, 0));
        CHECK(one.constraints[0].weight == 30.0);
    }
}

TEST_CASE("a higher rank counts before a later place") {
    std::vector<CurveClaim> claims = {claim(1, {{7, {0, 0.3, 0}, 100.0}}),
                                      claim(0, {{7, {0, 1, 0}, 100.0}}),
                                      claim(-1, {{7, {0, 1, 0}, 100.0}})};
    settle_conflicts(claims);
    for (const CurveClaim& one : claims) CHECK(one.constraints[0].value == Vec3(0, 0.3, 0));
}

TEST_CASE("a vector that vanishes agrees with any") {
    std::vector<CurveClaim> claims = {claim(0, {{7, {0, 0, 0}, 100.0}}),
                                      claim(0, {{7, {1, 0, 0}, 100.0}})};
    settle_conflicts(claims);
    CHECK(claims[0].constraints[0].value == Vec3(0.5, 0, 0));
}
