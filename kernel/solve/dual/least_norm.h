/// Least squares of small dense systems that need not have full rank.
#pragma once

#include <Eigen/Core>
#include <span>

#include "kernel/core/geometry.h"

namespace lissom {

/// Returns the X that makes |A X - B| least, and of these the one with the least norm. A and B have
/// as many rows; any rank. Source: complete orthogonal decomposition (Golub and Van Loan, section
/// 5.5).
Eigen::MatrixXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Replaces the rows of B by those of that X, for a square A of as many; takes no memory for up to
/// 16 rows.
void solve_least_norm(const Eigen::MatrixXd& a, std::span<Vec3> rows);

}  // namespace lissom
