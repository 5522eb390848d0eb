#include "kernel/solve/dual/least_norm.h"

#include <Eigen/QR>

#include "kernel/core/index.h"

namespace lissom {
namespace {

// Up to this number of unknowns a solution takes no memory.
constexpr int kFew = 16;
using FewMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kFew, kFew>;

template <typename Matrix>
void solve_rows(const Matrix& a, std::span<Vec3> rows) {
    Matrix b(count_of(rows), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) b.row(index_of(i)) = rows[i].transpose();
    const Matrix x = a.completeOrthogonalDecomposition().solve(b);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = x.row(index_of(i)).transpose();
}

}  // namespace

Eigen::MatrixXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.completeOrthogonalDecomposition().solve(b);
}

void solve_least_norm(const Eigen::MatrixXd& a, std::span<Vec3> rows) {
    if (a.rows() <= kFew) {
        solve_rows<FewMatrix>(a, rows);
    } else {
        solve_rows<Eigen::MatrixXd>(a, rows);
    }
}

}  // namespace lissom
