#include "kernel/solve/grid/grid_laplacian.h"

#include <random>
#include <vector>

#include "kernel/solve/field/grid_dissection.h"
#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("grid laplacian: the stencil does what the matrix does") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (const GridBoundary boundary : {GridBoundary::zero_flux, GridBoundary::thesis}) {
        for (const GridSize& size : {GridSize{1, 1, 1}, GridSize{2, 1, 3}, GridSize{7, 5, 6}}) {
            const GridLaplacian laplacian(size, boundary, 0.2);
            const auto n = static_cast<std::size_t>(size.count());
            std::vector<double> x(3 * n), y(3 * n), product(3 * n), scratch(3 * n);
            for (double& v : x) v = number(random);
            laplacian.apply(x.data(), y.data(), scratch.data(), {});
            laplacian.matrix().multiply(x.data(), product.data(), 3);
            for (std::size_t i = 0; i < 3 * n; ++i) {
                CHECK(y[i] == doctest::Approx(product[i]).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("grid laplacian: constant fields cost nothing, whatever the boundary") {
    for (const GridBoundary boundary : {GridBoundary::zero_flux, GridBoundary::thesis}) {
        const GridLaplacian laplacian({4, 5, 3}, boundary, 0.5);
        std::vector<double> x(180, 3.0), y(180, 1.0), scratch(180);
        laplacian.apply(x.data(), y.data(), scratch.data(), {});
        for (const double v : y) CHECK(std::abs(v) < 1e-14);
    }
}

TEST_CASE("grid dissection: every point comes once") {
    for (const GridSize& size : {GridSize{1, 1, 1}, GridSize{20, 3, 9}, GridSize{11, 12, 13}}) {
        std::vector<int> seen(static_cast<std::size_t>(size.count()), 0);
        for (const Index i : dissect_grid(size)) ++seen[i];
        for (const int count : seen) CHECK(count == 1);
    }
}

TEST_CASE("grid size: axes without points and grids beyond the limit are refused") {
    for (const GridSize& size : {GridSize{0, 1, 1}, GridSize{4, -1, 4}, GridSize{4, 4, 3000},
                                 GridSize{2000, 2000, 2000}}) {
        CHECK(test::error_of([&] { require_valid(size); }).code() == ErrorCode::invalid_argument);
    }
    CHECK_NOTHROW(require_valid({2048, 1, 1}));
    CHECK_NOTHROW(require_valid({256, 256, 256}));
    if (sizeof(std::size_t) < 8) {
        CHECK_THROWS_AS(require_valid({256, 256, 257}), Error);
    } else {
        CHECK_NOTHROW(require_valid({1024, 1024, 256}));
    }
}
