#include "tests/bench/limits.h"

#include <cstring>

#include "tests/bench/report.h"

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
            const double*, const int*, const double*, const int*, const double*, double*,
            const int*);
// OpenBLAS alone has it.
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace lissom::bench {
namespace {

// 256 MB: beyond the caches.
constexpr std::size_t kValues = 32 * 1024 * 1024;
constexpr int kSize = 1000;

// Seconds of `action` on the whole of the values, for so many bytes.
template <typename Action>
double scaled(double bytes, const Action& action) {
    return seconds(action) * bytes / static_cast<double>(kValues * sizeof(double));
}

}  // namespace

MemoryLimit::MemoryLimit() : values_(kValues, 1.0) {}

double MemoryLimit::seconds_to_write(double bytes) {
    return scaled(bytes, [&] { std::memset(values_.data(), 1, kValues * sizeof(double)); });
}

double MemoryLimit::seconds_to_read(double bytes) {
    return scaled(bytes,
                  [&] { sum_ += Eigen::Map<const Eigen::ArrayXd>(values_.data(), kValues).sum(); });
}

ProductLimit::ProductLimit()
    : a_(Eigen::MatrixXd::Random(kSize, kSize)),
      b_(Eigen::MatrixXd::Random(kSize, kSize)),
      c_(Eigen::MatrixXd::Zero(kSize, kSize)) {}

double ProductLimit::rate() {
    const int n = kSize;
    const double one = 1.0, zero = 0.0;
    set_blas_threads(1);
    const double time = seconds([&] {
        dgemm_("N", "T", &n, &n, &n, &one, a_.data(), &n, b_.data(), &n, &zero, c_.data(), &n);
    });
    return 2.0 * n * n * n / time;
}

const char* set_blas_threads(int threads) {
    if (!openblas_set_num_threads) return "BLAS";
    openblas_set_num_threads(threads);
    return "OpenBLAS";
}

}  // namespace lissom::bench
