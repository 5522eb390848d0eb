#include "kernel/solve/sparse/sparse_matrix.h"

#include <vector>

#include "kernel/core/extended.h"
#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("triplets: repeated entries are summed and the diagonal is complete") {
    const SymmetricMatrix a = symmetric_from_triplets(
        3, {{0, 0, 2.0}, {2, 0, 1.0}, {2, 0, 0.5}, {0, 2, 99.0}, {2, 2, 4.0}});
    CHECK(a.begin == std::vector<Index>{0, 2, 3, 4});
    CHECK(a.row == std::vector<Index>{0, 2, 1, 2});
    CHECK(a.value == std::vector<double>{2.0, 1.5, 0.0, 4.0});
}

TEST_CASE("triplets: an entry outside the matrix is refused") {
    const Error error = test::error_of([] { symmetric_from_triplets(2, {{2, 0, 1.0}}); });
    CHECK(error.code() == ErrorCode::out_of_range);
}

TEST_CASE("multiply uses both halves of a symmetric matrix") {
    const SymmetricMatrix a = symmetric_from_triplets(2, {{0, 0, 2.0}, {1, 0, 3.0}, {1, 1, 5.0}});
    const std::vector<double> x{1.0, 10.0, -1.0, 0.0};
    std::vector<double> y(4);
    a.multiply(x.data(), y.data(), 2);
    CHECK(y == std::vector<double>{32.0, 53.0, -2.0, -3.0});
}

TEST_CASE("residual: what multiply leaves of each column, with digits that double would lose") {
    const SymmetricMatrix a = symmetric_from_triplets(
        4, {{0, 0, 2.0}, {1, 0, 3.0}, {1, 1, 5.0}, {2, 2, 1.0}, {3, 1, -4.0}, {3, 3, 7.0}});
    std::vector<double> x, ax(12), r(12);
    std::vector<Extended> b;
    for (int i = 0; i < 12; ++i) x.push_back(i % 5 - 2.5);
    a.multiply(x.data(), ax.data(), 3);
    for (std::size_t i = 0; i < 12; ++i) b.push_back(ax[i] + Extended(0.25) * i);
    a.residual(b.data(), x.data(), r.data(), 3);
    for (std::size_t i = 0; i < 12; ++i) CHECK(r[i] == 0.25 * static_cast<double>(i));
    // A difference that is nothing beside b.
    for (Extended& v : b) v += 1e-17;
    if (sizeof(Extended) == sizeof(double)) return;
    a.residual(b.data(), x.data(), r.data(), 3);
    CHECK(r[0] == doctest::Approx(1e-17).epsilon(0.1));
}
