/// Limits of this machine, measured when they are asked for: what other times are compared with.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom::bench {

/// Reads and writes memory that no cache holds.
class MemoryLimit {
  public:
    MemoryLimit();
    /// Seconds that it takes one thread to write so many bytes: what any result that goes to memory
    /// costs.
    double seconds_to_write(double bytes);
    /// Seconds that it takes one thread to read so many bytes.
    double seconds_to_read(double bytes);

  private:
    std::vector<double> values_;
    double sum_ = 0.0;
};

/// Products of large square matrices by the linked BLAS, on one thread.
class ProductLimit {
  public:
    ProductLimit();
    /// Floating-point operations a second of one product.
    double rate();

  private:
    Eigen::MatrixXd a_, b_, c_;
};

/// Sets the threads of the linked BLAS where it has such a setting; what it is called.
const char* set_blas_threads(int threads);

}  // namespace lissom::bench
