/// The motion of the space around a head: the mean of the rigid motions of its skin, on a grid;
/// private to kernel/hair.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/follow/head_motion.h"

namespace lissom {

/// Weights of skin places follow Shepard (1968): 1 / (d^2 + 1e-4 m^2)^2 at the distance d.
class MotionField {
  public:
    /// A field at finite `points` (x y z each) that moves with the vertices `samples` of `head`.
    /// Errors: memory_limit.
    MotionField(std::span<const float> points, const HeadMotion& head, std::vector<Index> samples,
                const Context& context);

    /// Takes the motion that `head` has now.
    void move(const HeadMotion& head, const Context& context);

    /// A motion: a point moves by the first three columns, each times a coordinate from the origin
    /// of the field on, and the last.
    using Node = Eigen::Array<float, 4, 4>;

    /// Returns the motion at a point of the field.
    Node motion_at(const float* point) const {
        const Eigen::Array3f local =
            Eigen::Array3f(point[0], point[1], point[2]) - origin_.head<3>();
        const Eigen::Array3f cell = (local * per_step_).max(0.0f).min(most_);
        const Eigen::Array3i low = cell.cast<int>();
        const Eigen::Array3f u = cell - low.cast<float>();
        const Node* const node =
            nodes_.data() + (low[2] * counts_[1] + low[1]) * counts_[0] + low[0];
        Node sum = Node::Zero();
        for (int corner = 0; corner < 8; ++corner) {
            const float weight = ((corner & 1) != 0 ? u[0] : 1.0f - u[0]) *
                                 ((corner & 2) != 0 ? u[1] : 1.0f - u[1]) *
                                 ((corner & 4) != 0 ? u[2] : 1.0f - u[2]);
            sum += weight * node[steps_[static_cast<std::size_t>(corner)]];
        }
        return sum;
    }
    /// The origin; the fourth number is 0.
    const Eigen::Array4f& origin() const { return origin_; }
    /// Returns the place to which a point goes with a motion.
    Eigen::Array4f moved(const Eigen::Array4f& point, const Node& motion) const {
        const Eigen::Array4f local = point - origin_;
        return point + local[0] * motion.col(0) + local[1] * motion.col(1) +
               local[2] * motion.col(2) + motion.col(3);
    }
    /// Returns the place to which a point of the field goes.
    Eigen::Vector3f moved(const float* point) const {
        const Eigen::Array4f from(point[0], point[1], point[2], 0.0f);
        return moved(from, motion_at(point)).head<3>().matrix();
    }

    std::size_t memory_bytes() const;

  private:
    void lay_out(const Box& box);
    void mark(std::span<const float> points);
    void weigh(const HeadMotion& head, const Context& context);

    Eigen::Array4f origin_ = Eigen::Array4f::Zero();
    Eigen::Array3f most_ = Eigen::Array3f::Zero();
    float per_step_ = 1.0f;
    std::array<Index, 3> counts_{};
    std::array<Index, 8> steps_{};
    std::vector<Node, Eigen::aligned_allocator<Node>> nodes_;
    /// Nodes around points, and their weights of the samples, a row each.
    std::vector<Index> used_, samples_;
    Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights_, motions_;
    MemoryCharge charge_;
};

/// Returns up to `count` of the vertices `among`, each the one farthest from those before, from the
/// one farthest from their mean on.
std::vector<Index> spread_vertices(std::span<const Vec3> places, std::span<const Index> among,
                                   Index count);

}  // namespace lissom
