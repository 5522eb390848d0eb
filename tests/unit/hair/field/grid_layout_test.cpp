#include "kernel/hair/field/grid_layout.h"

#include "tests/unit/hair/hair_support.h"

using namespace lissom;

TEST_CASE("a grid covers its box with an even number of points on each axis") {
    test::RandomPoints random(1);
    for (int i = 0; i < 200; ++i) {
        const Vec3 low = random.in_box({Vec3(-5, -5, -5), Vec3(5, 5, 5)});
        const Vec3 size = random.in_box({Vec3(0.1, 0.1, 0.1), Vec3(3, 3, 3)});
        const Box box{low, low + size};
        const auto resolution = static_cast<Index>(random.uniform(1000, 100000));
        const GridLayout grid = fit_grid(box, resolution);
        CHECK(grid.size() <= resolution);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(grid.counts[axis] % 2 == 0);
            CHECK(grid.box().min[axis] <= box.min[axis] + 1e-9);
            CHECK(grid.box().max[axis] >= box.max[axis] - 1e-9);
            CHECK((grid.box().center() - box.center()).norm() < 1e-9);
        }
    }
}

TEST_CASE("a grid has nearly as many points as asked for") {
    const Box box{Vec3(-0.25, 1.3, -0.2), Vec3(0.25, 1.9, 0.2)};
    for (const Index resolution : {10000, 25000, 50000, 250000, 2000000}) {
        CHECK(fit_grid(box, resolution).size() > 0.85 * resolution);
    }
}

TEST_CASE("no grid plane runs through the middle of the box") {
    const GridLayout grid = fit_grid({Vec3(-1, -1, -1), Vec3(1, 2, 1)}, 20000);
    for (Index i = 0; i < grid.counts[0]; ++i) {
        CHECK(std::abs(grid.point(i, 0, 0).x()) > 0.4 * grid.step);
    }
}

TEST_CASE("points are numbered with x fastest") {
    const GridLayout grid = fit_grid({Vec3(-1, -1, -1), Vec3(1, 2, 1)}, 20000);
    CHECK(grid.index(1, 0, 0) == 1);
    CHECK(grid.index(0, 1, 0) == grid.counts[0]);
    CHECK(grid.index(grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1) ==
          grid.size() - 1);
}

TEST_CASE("grids without sense are refused") {
    const auto code = [](const Box& box, Index resolution) {
        return test::error_of([&] { (void)fit_grid(box, resolution); }).code();
    };
    const Box box{Vec3::Zero(), Vec3::Ones()};
    CHECK(code(Box{}, 20000) == ErrorCode::not_finite);
    CHECK(code({Vec3(test::kNaN, 0, 0), Vec3::Ones()}, 20000) == ErrorCode::not_finite);
    CHECK(code({Vec3::Zero(), Vec3(1, 0, 1)}, 20000) == ErrorCode::invalid_argument);
    CHECK(code(box, kMinimumResolution - 1) == ErrorCode::invalid_argument);
    CHECK(code(box, kMaximumResolution + 1) == ErrorCode::invalid_argument);
}
