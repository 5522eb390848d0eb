/// Forces that push apart parts of a deformed surface; private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/contact/penetration.h"
#include "kernel/deform/frame/displaced_frame.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"

namespace lissom {

/// The displacement u of a frame by contact forces. Penetrating points are taken together in rows:
/// the mean over a row of u at its vertices less u at their exits, along its way, shall be at least
/// its depth. With K the matrix of the second system, J the rows and l their forces,
///     u = K^-1 (J^T l + change of the rotations),  l >= 0, zero if u is more than asked for,
/// a linear complementarity problem in few unknowns; see DisplacedFrame.
class Separation {
  public:
    /// Displaces `frame`, a full one of `prepared`, which has the implicit method.
    Separation(const Preparation& prepared, const DeformFrame& frame, const Context& context);

    /// Adds rows for vertices that penetrate with the present displacement. Returns whether there
    /// are any that forces can move.
    bool add(std::span<const Penetration> penetrations, const Context& context);
    /// Finds the forces and the displacement for all rows. `softness` is added to the diagonal of
    /// the rows' compliance, as a part of its mean: with more, stiff places are pushed less, and
    /// not as far as is asked. Errors: cancelled.
    void solve(double softness, const Context& context);
    /// Adds the displacement to the positions of the frame.
    void displace(DeformFrame& frame) const { displaced_.displace(frame); }

  private:
    struct Row {
        /// Free vertices with their coefficients.
        std::vector<std::pair<Index, double>> entries;
        Vec3 way = Vec3::Zero();
        double depth = 0.0, force = 0.0;
        /// Displacement of the vertices along `way` by a unit force.
        std::vector<float> response;
    };

    void add_rows(const Penetration& penetration, std::size_t most, std::vector<Row>& rows) const;
    Row row_around(const Penetration& penetration, std::size_t seed, double reach) const;
    void add_entry(Row& row, Index mesh_vertex, double coefficient) const;
    void find_responses(std::span<Row> rows, const Context& context);
    void find_compliance();
    static Vec3 mean_of(const Row& row, std::span<const Vec4> u);
    void find_forces(double softness);
    void add_answers();

    DisplacedFrame displaced_;
    std::vector<Row> rows_;
    Eigen::MatrixXd compliance_;
};

}  // namespace lissom
