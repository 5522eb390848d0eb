#include "kernel/solve/dual/bordered_cholesky.h"

#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// A positive definite matrix that no row can be taken out of unnoticed.
double entry(Index i, Index j) {
    return std::exp(-0.05 * std::abs(i - j)) + 0.2 * std::sin(0.3 * i) * std::sin(0.3 * j) +
           (i == j ? 0.5 : 0.0);
}

void fill(Index column, Index begin, Index end, double* entries) {
    for (Index i = begin; i < end; ++i) entries[i - begin] = entry(i, column);
}

std::vector<double> right_hand_sides(Index size) {
    std::vector<double> b(4 * static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::cos(1.7 * static_cast<double>(i));
    return b;
}

// The greatest entry of M x - b.
double defect(const BorderedCholesky& factor) {
    const Index size = factor.size();
    const std::vector<double> b = right_hand_sides(size);
    std::vector<double> x = b;
    factor.solve(x.data());
    double worst = 0.0;
    for (Index i = 0; i < size; ++i) {
        for (int c = 0; c < 4; ++c) {
            double sum = -b[4 * i + c];
            for (Index j = 0; j < size; ++j) sum += entry(i, j) * x[4 * j + c];
            worst = std::max(worst, std::abs(sum));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("bordered cholesky: it solves, whatever the number of rows") {
    for (const Index size : {1, 2, 3, 5, 63, 64, 65, 130, 333}) {
        BorderedCholesky factor;
        factor.extend(size, fill, {});
        CHECK(factor.size() == size);
        CHECK(defect(factor) < 1e-11);
    }
}

TEST_CASE("bordered cholesky: rows taken away and added again leave a factor of what is there") {
    BorderedCholesky factor;
    for (const Index size : {100, 260, 40, 41, 300, 7, 200}) {
        factor.truncate(size);
        factor.extend(size, fill, {});
        CHECK(factor.size() == size);
        CHECK(defect(factor) < 1e-11);
    }
}

TEST_CASE("bordered cholesky: threads change no bit") {
    ContextOptions options;
    options.threads = 2;
    BorderedCholesky one, two;
    std::vector<double> x = right_hand_sides(400), y = x;
    for (const Index size : {250, 400}) {
        one.extend(size, fill, {});
        two.extend(size, fill, Context(options));
    }
    one.solve(x.data());
    two.solve(y.data());
    CHECK(x == y);
}

TEST_CASE("bordered cholesky: an indefinite matrix is refused and the old rows stay") {
    BorderedCholesky factor;
    factor.extend(80, fill, {});
    const auto bad = [](Index column, Index begin, Index end, double* entries) {
        fill(column, begin, end, entries);
        if (column == 90) entries[0] = -1.0;
    };
    CHECK(test::error_of([&] { factor.extend(120, bad, {}); }).code() ==
          ErrorCode::not_positive_definite);
    // Those of whole panels.
    CHECK(factor.size() == 64);
    CHECK(defect(factor) < 1e-11);
}

TEST_CASE("bordered cholesky: the same to the bit, whatever rows there were before") {
    BorderedCholesky direct, edited;
    direct.extend(150, fill, {});
    for (const Index size : {30, 90, 131, 150}) {
        edited.truncate(size - 25);
        edited.extend(size, fill, {});
    }
    std::vector<double> x(4 * 150, 1.0), y = x;
    direct.solve(x.data());
    edited.solve(y.data());
    CHECK(x == y);
}

TEST_CASE("bordered cholesky: memory is charged before it is taken") {
    ContextOptions options;
    options.memory_limit = 1000000;
    const Context context(options);
    BorderedCholesky factor;
    factor.extend(100, fill, context);
    CHECK(context.memory()->used() == BorderedCholesky::bytes(100));
    CHECK(test::error_of([&] { factor.extend(1000, fill, context); }).code() ==
          ErrorCode::memory_limit);
    CHECK(defect(factor) < 1e-11);
}
