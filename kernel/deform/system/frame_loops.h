/// The loops over vertices that every frame of a drag runs, in vector code chosen at run time;
/// private to kernel/deform. Rows of four numbers hold three coordinates and a zero.
#pragma once

#include <cstddef>
#include <span>

#include "kernel/core/geometry.h"

namespace lissom {

/// The columns of a 3 x 3 matrix.
using PaddedMat3 = Eigen::Matrix<double, 4, 3>;

inline Vec4 padded(const Vec3& v) {
    return {v.x(), v.y(), v.z(), 0.0};
}
inline PaddedMat3 padded_columns(const Mat3& m) {
    PaddedMat3 columns = PaddedMat3::Zero();
    columns.topRows<3>() = m;
    return columns;
}

/// The solution of the first system by its basis: sum over h of transform_h weight_h, for `count`
/// handles.
struct BasisLoop {
    /// Destination of evaluated values: added to the rest position, the base's transform less the
    /// identity of that, and the origin, to entry out[row] of each that is not kNoIndex.
    struct Places {
        const Vec3* rest;
        Mat4 shift;
        Vec3 origin;
        const Index* row;
        Vec3* out;
    };

    const Mat4* transform;
    const Vec4* const* weight;
    std::size_t count;

    /// x[row - begin] for rows [begin, end).
    void evaluate(Vec4* x, Index begin, Index end) const;
    /// The same to their places.
    void place(const Places& places, Index begin, Index end) const;
};

/// Deformation gradients of positions x by their stencils (GradientStencils).
struct GradientLoop {
    const Index* ring_begin;
    const Index* neighbor;
    const Vec3* self;
    const Vec3* stencil;

    /// m[row - begin] = M of vertex[row], for rows [begin, end).
    void gather(const Index* vertex, const Vec4* x, Mat3* m, Index begin, Index end) const;
};

/// The energy of the second system: with C the Laplacian of the symmetric coefficients c_ij,
/// (C x)_i = sum_j c_ij (x_i - x_j), and transforms S_i,
///   sum over edges of w_ij |(x_i - x_j) - (S_i + S_j) (v_i - v_j) / 2|^2
/// + sum over vertices of g_i |(C x)_i - S_i (C v)_i|^2.
struct EnergyLoop {
    const Index* ring_begin;
    const Index* neighbor;
    /// c_ij and w_ij of every ring entry, and g_i.
    const double* coefficient;
    const double* edge_weight;
    const double* row_weight;
    /// v_i, (C v)_i and sum_j w_ij (v_i - v_j) / 2.
    const Vec4* rest;
    const Vec4* laplacian;
    const Vec4* edge_sum;

    /// Null transforms stand for zeros below.
    ///
    /// u_i = g_i ((C x)_i - S_i (C v)_i).
    void bend(const PaddedMat3* s, const Vec4* x, Vec4* u, Index begin, Index end) const;
    /// Half the downward gradient of the energy at vertex[row] into r[row]; `u` from `bend`, of all
    /// vertices.
    void descend(const PaddedMat3* s, const Vec4* x, const Vec4* u, const Index* vertex, Vec3* r,
                 Index begin, Index end) const;
    /// m[row - begin]: the matrix whose nearest rotation, for vertex[row], has the least energy at
    /// positions x, each edge counting one half at either end:
    /// sum_j w_ij (x_i - x_j) (v_i - v_j)^T / 2 + g_i (C x)_i (C v)_i^T.
    void fit(const Vec4* x, const Index* vertex, Mat3* m, Index begin, Index end) const;
};

}  // namespace lissom
