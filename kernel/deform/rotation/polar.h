/// Polar decomposition of deformation gradients (thesis section 2.4.4).
#pragma once

#include <span>

#include "kernel/core/geometry.h"

namespace lissom {

/// Returns the rotation nearest to `m` in the Frobenius norm: R = U V^T of its singular value
/// decomposition, with determinant +1 even if det m is negative. The zero matrix gives the
/// identity.
///
/// The quaternion of R is the top eigenvector of a 4 x 4 matrix, found from its characteristic
/// polynomial (Theobald, "Rapid calculation of RMSDs using a quaternion-based characteristic
/// polynomial", 2005) and polished by one Newton step; a singular value decomposition serves if
/// that eigenvector is not well separated.
Mat3 nearest_rotation(const Mat3& m);

/// The nearest rotation of each matrix of `m`, several at a time; r may be m. Errors:
/// invalid_argument if the numbers of matrices differ.
void nearest_rotations(std::span<const Mat3> m, std::span<Mat3> r);

/// The same as unit quaternions (w, x, y, z), of either sign. Errors: as nearest_rotations.
void nearest_quaternions(std::span<const Mat3> m, std::span<Vec4> q);

/// Uniform scale of `m`: the root mean square of its singular values, |m|_F / sqrt 3 (Eq 2.11).
double uniform_scale(const Mat3& m);

}  // namespace lissom
