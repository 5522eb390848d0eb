#include "kernel/solve/dual/least_norm.h"

#include <Eigen/QR>

namespace lissom {

Eigen::MatrixXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace lissom
