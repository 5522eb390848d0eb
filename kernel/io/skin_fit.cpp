#include "kernel/io/skin_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr Index kMaxJoints = 250, kMaxInfluences = 8, kGrain = 256;
// Joints whose weights are solved for before the largest are chosen, and passes of the division
// into rigid parts that the fit starts from.
constexpr std::size_t kCandidates = 10;
constexpr int kDivisionPasses = 8;

using Poses = std::vector<std::vector<Vec3>>;

void require_skin(std::span<const Vec3> rest, const Poses& poses, const SkinOptions& options) {
    const auto refuse = [](const std::string& text) {
        throw Error(ErrorCode::invalid_argument, text);
    };
    if (options.joints < 1 || options.joints > kMaxJoints) refuse("a skin has 1 to 250 joints");
    if (options.influences < 1 || options.influences > kMaxInfluences) {
        refuse("a vertex follows 1 to 8 joints");
    }
    if (options.passes < 1) refuse("a skin is fitted in at least one pass");
    if (rest.empty() || poses.empty()) refuse("a skin needs vertices that move and a pose");
    for (const auto& pose : poses) {
        if (pose.size() != rest.size()) refuse("a pose has another number of points than the rest");
    }
}

// The rigid motion that takes points p with weights to q best, from the sums of weights, w p, w q
// and w p q^T.
struct MotionSums {
    double weight = 0.0;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    Mat3 product = Mat3::Zero();

    void add(double w, const Vec3& p, const Vec3& q) {
        weight += w;
        from += w * p;
        to += w * q;
        product += w * p * q.transpose();
    }

    Affine motion() const {
        if (!(weight > 0.0)) return {};
        const Mat3 covariance = product - from * to.transpose() / weight;
        const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
        Mat3 sign = Mat3::Identity();
        if ((svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0) sign(2, 2) = -1.0;
        Affine result;
        result.linear = svd.matrixV() * sign * svd.matrixU().transpose();
        result.translation = (to - result.linear * from) / weight;
        return result;
    }
};

// Weights of few joints for one vertex: minimise |A w - b| with sum 1, without negative ones.
struct WeightSystem {
    Eigen::MatrixXd gram;
    Eigen::VectorXd right;

    // Solves for the joints of `active`; false if they do not determine the weights.
    bool solve(const std::vector<Index>& active, Eigen::VectorXd& weights) const {
        const auto n = static_cast<Eigen::Index>(active.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 1, n + 1);
        Eigen::VectorXd sides(n + 1);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Index a = active[static_cast<std::size_t>(i)];
            for (Eigen::Index k = 0; k < n; ++k) {
                matrix(i, k) = gram(a, active[static_cast<std::size_t>(k)]);
            }
            matrix(i, n) = matrix(n, i) = 1.0;
            sides[i] = right[a];
        }
        sides[n] = 1.0;
        const Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix);
        weights = lu.solve(sides).head(n);
        return weights.allFinite();
    }
};

// Removes joints with negative weights until none is left, and then the least until at most `most`
// are.
std::vector<Index> positive_joints(const WeightSystem& system, std::vector<Index> active,
                                   std::size_t most, Eigen::VectorXd& weights) {
    constexpr double kMinWeight = 1e-4;
    while (active.size() > 1) {
        const bool solved = system.solve(active, weights);
        Eigen::Index least = static_cast<Eigen::Index>(active.size()) - 1;
        if (solved && weights.minCoeff(&least) > kMinWeight && active.size() <= most) return active;
        active.erase(active.begin() + least);
    }
    weights = Eigen::VectorXd::Ones(1);
    return active;
}

class SkinFitter {
  public:
    SkinFitter(std::span<const Vec3> rest, const Poses& poses, bool still,
               const SkinOptions& options, const Context& context)
        : rest_(rest),
          poses_(poses),
          first_moving_(still ? 1 : 0),
          options_(options),
          context_(context),
          joint_count_(std::min<Index>(options.joints, count_of(rest) + first_moving_)) {
        fit_.influences = options.influences;
        fit_.motions.assign(poses.size(), std::vector<Affine>(at(joint_count_)));
        fit_.joints.assign(rest.size() * at(options.influences), 0);
        fit_.weights.assign(fit_.joints.size(), 0.0);
    }

    SkinFit fit() {
        Progress progress(context_, "fit a skin");
        divide();
        fit_weights();
        for (int pass = 0; pass < options_.passes; ++pass) {
            progress.update(static_cast<std::size_t>(pass),
                            static_cast<std::size_t>(options_.passes));
            fit_motions();
            fit_weights();
        }
        find_centers();
        measure();
        return std::move(fit_);
    }

  private:
    // Squared distance of a vertex, as a rigid part of a joint, from its places in all poses.
    double error_of(std::size_t v, Index joint) const {
        double sum = 0.0;
        for (std::size_t p = 0; p < poses_.size(); ++p) {
            sum += (fit_.motions[p][at(joint)](rest_[v]) - poses_[p][v]).squaredNorm();
        }
        return sum;
    }

    // Divides the vertices into rigid parts: from places far apart, each part takes the vertices
    // that it moves best.
    void divide() {
        part_.assign(rest_.size(), first_moving_ < joint_count_ ? first_moving_ : 0);
        spread_parts();
        for (int pass = 0; pass < kDivisionPasses; ++pass) {
            context_.checkpoint();
            move_parts();
            assign_parts();
        }
        move_parts();
    }

    void spread_parts() {
        std::vector<double> distance(rest_.size(), std::numeric_limits<double>::infinity());
        std::size_t seed = 0;
        for (Index joint = first_moving_; joint < joint_count_; ++joint) {
            for (std::size_t v = 0; v < rest_.size(); ++v) {
                const double d = difference(v, seed);
                if (d >= distance[v]) continue;
                distance[v] = d;
                part_[v] = joint;
            }
            seed = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                            distance.begin());
        }
    }

    // Squared distance of two vertices at rest and, on the average, in the poses.
    double difference(std::size_t a, std::size_t b) const {
        double sum = 0.0;
        for (const auto& pose : poses_) {
            sum += ((pose[a] - rest_[a]) - (pose[b] - rest_[b])).squaredNorm();
        }
        return (rest_[a] - rest_[b]).squaredNorm() + sum / static_cast<double>(poses_.size());
    }

    void move_parts() {
        for (std::size_t p = 0; p < poses_.size(); ++p) {
            std::vector<MotionSums> sums(at(joint_count_));
            for (std::size_t v = 0; v < rest_.size(); ++v) {
                sums[at(part_[v])].add(1.0, rest_[v], poses_[p][v]);
            }
            for (Index joint = first_moving_; joint < joint_count_; ++joint) {
                fit_.motions[p][at(joint)] = sums[at(joint)].motion();
            }
        }
    }

    void assign_parts() {
        context_.parallel_for(0, count_of(rest_), kGrain, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                double best = std::numeric_limits<double>::infinity();
                for (Index joint = 0; joint < joint_count_; ++joint) {
                    const double error = error_of(at(i), joint);
                    if (error >= best) continue;
                    best = error;
                    part_[at(i)] = joint;
                }
            }
        });
    }

    void fit_weights() {
        context_.parallel_for(0, count_of(rest_), kGrain, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) fit_vertex(at(i));
        });
    }

    // The joints that alone move a vertex best.
    std::vector<Index> candidates(std::size_t v) const {
        std::vector<Index> joints(at(joint_count_));
        std::iota(joints.begin(), joints.end(), 0);
        std::vector<double> errors;
        for (const Index joint : joints) errors.push_back(error_of(v, joint));
        const std::size_t count = std::min(joints.size(), kCandidates);
        std::partial_sort(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(count),
                          joints.end(), [&](Index a, Index b) {
                              return std::pair(errors[at(a)], a) < std::pair(errors[at(b)], b);
                          });
        joints.resize(count);
        return joints;
    }

    WeightSystem system_of(std::size_t v, const std::vector<Index>& joints) const {
        const auto n = static_cast<Eigen::Index>(joints.size());
        WeightSystem system{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
        // Differences to the target keep digits: with the sum 1 they are the same problem.
        Eigen::Matrix3Xd columns(3, n);
        for (std::size_t p = 0; p < poses_.size(); ++p) {
            for (Eigen::Index k = 0; k < n; ++k) {
                const Index joint = joints[static_cast<std::size_t>(k)];
                columns.col(k) = fit_.motions[p][at(joint)](rest_[v]) - poses_[p][v];
            }
            system.gram += columns.transpose() * columns;
        }
        return system;
    }

    void fit_vertex(std::size_t v) {
        const std::vector<Index> joints = candidates(v);
        const WeightSystem system = system_of(v, joints);
        std::vector<Index> active(joints.size());
        std::iota(active.begin(), active.end(), 0);
        Eigen::VectorXd weights;
        active = positive_joints(system, active, at(options_.influences), weights);
        const std::size_t row = v * at(options_.influences);
        for (std::size_t k = 0; k < at(options_.influences); ++k) {
            const bool is_used = k < active.size();
            fit_.joints[row + k] = is_used ? joints[at(active[k])] : 0;
            fit_.weights[row + k] = is_used ? weights[static_cast<Eigen::Index>(k)] : 0.0;
        }
    }

    struct Follower {
        std::size_t vertex;
        double weight;
    };

    std::vector<std::vector<Follower>> followers() const {
        std::vector<std::vector<Follower>> result(at(joint_count_));
        for (std::size_t i = 0; i < fit_.joints.size(); ++i) {
            if (fit_.weights[i] == 0.0) continue;
            result[at(fit_.joints[i])].push_back({i / at(options_.influences), fit_.weights[i]});
        }
        return result;
    }

    // Each joint in turn moves to leave the least residual, given the others.
    void fit_motions() {
        const std::vector<std::vector<Follower>> all = followers();
        context_.parallel_for(0, count_of(poses_), 1, [&](Index begin, Index end) {
            for (Index p = begin; p < end; ++p) fit_pose(p, all);
        });
    }

    void fit_pose(Index p, const std::vector<std::vector<Follower>>& all) {
        std::vector<Affine>& motions = fit_.motions[at(p)];
        std::vector<Vec3> residual(rest_.size());
        for (std::size_t v = 0; v < rest_.size(); ++v) {
            residual[v] = poses_[at(p)][v] - fit_.position(index_of(v), rest_[v], p);
        }
        for (Index joint = first_moving_; joint < joint_count_; ++joint) {
            Affine& motion = motions[at(joint)];
            const std::vector<Follower>& own = all[at(joint)];
            if (own.empty()) continue;
            MotionSums sums;
            for (const auto& [v, w] : own) {
                // The vertex shall be where its own part of the motion and the residual put it.
                sums.add(w * w, rest_[v], motion(rest_[v]) + residual[v] / w);
            }
            const Affine moved = sums.motion();
            for (const auto& [v, w] : own) {
                residual[v] -= w * (moved(rest_[v]) - motion(rest_[v]));
            }
            motion = moved;
        }
    }

    void find_centers() {
        const std::vector<std::vector<Follower>> all = followers();
        for (const std::vector<Follower>& own : all) {
            Vec3 sum = Vec3::Zero();
            double weight = 0.0;
            for (const auto& [v, w] : own) {
                sum += w * rest_[v];
                weight += w;
            }
            fit_.centers.push_back(weight > 0.0 ? Vec3(sum / weight) : rest_[0]);
        }
    }

    void measure() {
        double sum = 0.0;
        for (std::size_t p = 0; p < poses_.size(); ++p) {
            for (std::size_t v = 0; v < rest_.size(); ++v) {
                const double d =
                    (fit_.position(index_of(v), rest_[v], index_of(p)) - poses_[p][v]).norm();
                fit_.max_error = std::max(fit_.max_error, d);
                sum += d * d;
            }
        }
        fit_.rms_error = std::sqrt(sum / static_cast<double>(poses_.size() * rest_.size()));
    }

    std::span<const Vec3> rest_;
    const Poses& poses_;
    Index first_moving_;
    SkinOptions options_;
    const Context& context_;
    Index joint_count_;
    SkinFit fit_;
    std::vector<Index> part_;
};

}  // namespace

Vec3 SkinFit::position(Index vertex, const Vec3& rest, Index pose) const {
    Vec3 sum = Vec3::Zero();
    const std::size_t row = at(vertex) * at(influences);
    for (std::size_t k = row; k < row + at(influences); ++k) {
        if (weights[k] == 0.0) continue;
        sum += weights[k] * motions[at(pose)][at(joints[k])](rest);
    }
    return sum;
}

SkinFit fit_skin(std::span<const Vec3> rest, const std::vector<std::vector<Vec3>>& poses,
                 bool still, const SkinOptions& options, const Context& context) {
    require_skin(rest, poses, options);
    return SkinFitter(rest, poses, still, options, context).fit();
}

}  // namespace lissom
