#include "kernel/io/basis_keys.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Nearer poses are the same. Floats tell poses apart from some 1e-6 on.
constexpr double kSamePose = 1e-3;
// Least part of a pose across the axes before it, relative to the farthest pose.
constexpr double kOwnDirection = 1e-3;

// The rotation of a linear map by its columns, one after another; zero if they have no volume.
Mat3 rotation_part(const Mat3& linear) {
    Mat3 turn = Mat3::Zero();
    turn.col(0) = linear.col(0).normalized();
    turn.col(1) = (linear.col(1) - turn.col(0) * turn.col(0).dot(linear.col(1))).normalized();
    turn.col(2) = turn.col(0).cross(turn.col(1));
    return turn;
}

// A quaternion of any length, w first, by its largest member.
Vec4 quaternion_of(const Mat3& r) {
    const Vec4 squares(1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
                       1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2));
    const Vec3 turned(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
    const double xy = r(0, 1) + r(1, 0), xz = r(0, 2) + r(2, 0), yz = r(1, 2) + r(2, 1);
    Index largest = 0;
    squares.maxCoeff(&largest);
    switch (largest) {
        case 0:
            return {squares[0], turned[0], turned[1], turned[2]};
        case 1:
            return {turned[0], squares[1], xy, xz};
        case 2:
            return {turned[1], xy, squares[2], yz};
        default:
            return {turned[2], xz, yz, squares[3]};
    }
}

// Half a turn one way is half a turn the other way: the first large coordinate is positive.
bool looks_back(const Vec3& axis) {
    constexpr double kLarge = 0.51;
    for (const double x : axis) {
        if (std::abs(x) > kLarge) return x < 0.0;
    }
    return false;
}

Vec3 turn_vector(const Mat3& rotation) {
    constexpr double kHalfTurn = 1e-4;
    const Vec4 q = quaternion_of(rotation);
    Vec3 axis = q.tail<3>();
    const double length = axis.norm();
    if (!(length > 0.0)) return Vec3::Zero();
    axis /= length;
    const double w = std::abs(q[0]);
    if (w <= kHalfTurn * length ? looks_back(axis) : q[0] < 0.0) axis = -axis;
    return 2.0 * std::atan2(length, w) * axis;
}

// Directions of the poses that those before them do not have.
MatrixXd axes_of(const MatrixXd& poses) {
    const double least = kOwnDirection * poses.colwise().norm().maxCoeff();
    MatrixXd axes(0, poses.rows());
    for (Eigen::Index k = 0; k < poses.cols(); ++k) {
        VectorXd own = poses.col(k);
        for (int pass = 0; pass < 2; ++pass) {
            const VectorXd along = axes * own;
            own -= axes.transpose() * along;
        }
        if (!(own.norm() > least)) continue;
        axes.conservativeResize(axes.rows() + 1, Eigen::NoChange);
        axes.bottomRows<1>() = own.normalized().transpose();
    }
    return axes;
}

double cube(double x) {
    return x * x * x;
}

// The values at a place of all functions that weights are made of: see EngineKeys::blend.
VectorXd functions_at(const MatrixXd& nodes, const VectorXd& at) {
    VectorXd values(nodes.rows() + nodes.cols() + 1);
    for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
        values[n] = cube((nodes.row(n).transpose() - at).norm());
    }
    values.segment(nodes.rows(), nodes.cols()) = at;
    values[values.size() - 1] = 1.0;
    return values;
}

// Weights that are 1 at their own key and 0 at the other nodes, with least bending.
MatrixXd blend_of(const MatrixXd& nodes, Eigen::Index keys) {
    const Eigen::Index n = nodes.rows(), all = n + nodes.cols() + 1;
    MatrixXd system = MatrixXd::Zero(all, all);
    for (Eigen::Index i = 0; i < n; ++i) {
        system.row(i) = functions_at(nodes, nodes.row(i).transpose()).transpose();
    }
    system.bottomLeftCorner(all - n, n) = system.topRightCorner(n, all - n).transpose();
    MatrixXd wanted = MatrixXd::Zero(all, keys);
    wanted.topRows(keys).setIdentity();
    return system.partialPivLu().solve(wanted);
}

void require_different(const MatrixXd& poses) {
    for (Eigen::Index a = 0; a < poses.cols(); ++a) {
        for (Eigen::Index b = 0; b < a; ++b) {
            if ((poses.col(a) - poses.col(b)).norm() > kSamePose) continue;
            throw Error(ErrorCode::invalid_argument,
                        "key poses " + std::to_string(b + 1) + " and " + std::to_string(a + 1) +
                            " are the same; half a turn has no direction, and full turns are not "
                            "told apart");
        }
    }
}

}  // namespace

Eigen::Matrix<double, 12, 1> engine_pose(const Affine& local, const Vec3& center, double size) {
    const Mat3 turn = rotation_part(local.linear);
    const Mat3 stretch = turn.transpose() * local.linear - Mat3::Identity();
    Eigen::Matrix<double, 12, 1> pose;
    pose.head<3>() = turn_vector(turn);
    pose.segment<3>(3) = (local(center) - center) / (size > 0.0 ? size : 1.0);
    pose.tail<6>() << stretch(0, 0), stretch(0, 1), stretch(0, 2), stretch(1, 1), stretch(1, 2),
        stretch(2, 2);
    return pose;
}

VectorXd EngineKeys::weights_at(const VectorXd& pose) const {
    const VectorXd at = (axes * pose).cwiseMax(min).cwiseMin(max);
    return blend.transpose() * functions_at(nodes, at);
}

EngineKeys fit_engine_keys(const MatrixXd& poses) {
    require_different(poses);
    const Eigen::Index count = poses.cols();
    const bool has_rest = (poses.colwise().norm().array() <= kSamePose).any();
    EngineKeys keys;
    keys.axes = axes_of(poses);
    keys.nodes = MatrixXd::Zero(count + (has_rest ? 0 : 1), keys.axes.rows());
    keys.nodes.topRows(count) = (keys.axes * poses).transpose();
    keys.min = keys.nodes.colwise().minCoeff().transpose();
    keys.max = keys.nodes.colwise().maxCoeff().transpose();
    keys.blend = blend_of(keys.nodes, count);
    return keys;
}

BasisKey make_basis_key(Deformer& deformer, const Context& context) {
    BasisKey key;
    key.positions = deformer.solve(FrameQuality::full, context);
    for (const HandleId handle : deformer.handles()) {
        key.transforms.push_back(deformer.pose(handle).transform);
    }
    return key;
}

std::vector<BasisKey> make_basis_keys(Deformer& deformer,
                                      std::span<const std::vector<Affine>> poses,
                                      const Context& context) {
    const std::vector<HandleId> handles = deformer.handles();
    const DeformSnapshot before = deformer.snapshot();
    std::vector<BasisKey> keys;
    try {
        for (const std::vector<Affine>& pose : poses) {
            if (pose.size() != handles.size()) {
                throw Error(ErrorCode::invalid_argument,
                            std::to_string(pose.size()) + " transforms of a key for " +
                                std::to_string(handles.size()) + " handles");
            }
            deformer.restore(before);
            for (std::size_t h = 0; h < handles.size(); ++h) {
                deformer.set_transform(handles[h], pose[h]);
            }
            keys.push_back(make_basis_key(deformer, context));
        }
        deformer.restore(before);
    } catch (...) {
        // That may be its second attempt, after it found no memory.
        deformer.restore(before);
        throw;
    }
    return keys;
}

}  // namespace lissom
