#include "kernel/deform/boundary/common_gradients.h"

#include <Eigen/Cholesky>
#include <utility>

#include "kernel/core/extended.h"

namespace lissom {
namespace {

constexpr int kParameters = 4;

}  // namespace

CommonGradients::CommonGradients(const WorkingPatch& work, std::vector<std::vector<Index>> features,
                                 const GradientSystem& first, const GradientResidual& energy,
                                 const RotationSystem& second)
    : work_(work),
      features_(std::move(features)),
      first_(first),
      energy_(energy),
      second_(second),
      feature_of_(at(work.patch.vertex_count), kNoIndex) {
    for (const std::vector<Index>& feature : features_) {
        Vec3 center = Vec3::Zero();
        for (const Index v : feature) {
            feature_of_[v] = count_of(center_);
            center += work.patch.rest[v] / count_of(feature);
        }
        center_.push_back(center);
    }
}

Vec3 CommonGradients::arm(Index v) const {
    return work_.patch.rest[v] - center_[feature_of_[v]];
}

void CommonGradients::prepare(const Context& context) {
    if (size() == 0) return;
    prepare_first();
    context.checkpoint();
    prepare_second(context);
}

std::vector<CommonGradients::Pull> CommonGradients::pulls(const std::vector<Vec3>& x,
                                                          const std::vector<Mat3>& m) const {
    std::vector<Mat3> by_gradient;
    const std::vector<Vec3> by_position = energy_.find(x, m, &by_gradient);
    std::vector<Pull> result(features_.size());
    for (Index f = 0; f < size(); ++f) {
        for (const Index v : vertices(f)) {
            result[f].translation += by_position[v];
            result[f].linear += by_position[v] * arm(v).transpose() + by_gradient[v];
        }
    }
    return result;
}

// One coordinate of all positions, with that of the feature 1, or that of an arm.
CommonGradients::Responses CommonGradients::first_responses(Index feature) const {
    const std::vector<Index>& free = first_.free_vertices();
    const std::size_t rows = free.size();
    const auto inside = [&](Index v) { return feature_of_[v] == feature; };
    const auto place = [&](Index v, int k) {
        if (!inside(v)) return 0.0;
        return k == 0 ? 1.0 : arm(v)[k - 1];
    };
    std::vector<Extended> right(kParameters * rows);
    for (int k = 0; k < kParameters && rows > 0; ++k) {
        const auto gradient = [&](Index v) {
            return k > 0 && inside(v) ? Vec3(Vec3::Unit(k - 1)) : Vec3(Vec3::Zero());
        };
        first_.right_hand_side([&](Index v) { return place(v, k); }, gradient,
                               right.data() + at(k) * rows);
    }
    std::vector<double> columns;
    if (rows > 0) columns = first_.solve(right, kParameters);
    Responses responses;
    for (int k = 0; k < kParameters; ++k) {
        std::vector<double>& field = responses[at(k)];
        field.assign(feature_of_.size(), 0.0);
        for (const Index v : vertices(feature)) field[v] = place(v, k);
        for (std::size_t r = 0; r < rows; ++r) field[free[r]] = columns[at(k) * rows + r];
    }
    return responses;
}

// The forces that the responses in the coordinates of `x` make, each for one parameter of the
// feature; none for a parameter of -1.
void CommonGradients::add_columns(Index feature, const std::vector<Vec3>& x,
                                  const std::vector<Mat3>& m, std::array<int, 3> parameter) {
    const std::vector<Pull> forces = pulls(x, m);
    for (int d = 0; d < 3; ++d) {
        if (parameter[at(d)] < 0) continue;
        const Index column = kParameters * feature + parameter[at(d)];
        for (Index g = 0; g < size(); ++g) {
            stiffness_(kParameters * g, column) = -forces[g].translation[d];
            for (int k = 0; k < 3; ++k) {
                stiffness_(kParameters * g + 1 + k, column) = -forces[g].linear(d, k);
            }
        }
    }
}

void CommonGradients::prepare_first() {
    const Eigen::Index n = kParameters * size();
    stiffness_.setZero(n, n);
    for (Index f = 0; f < size(); ++f) {
        response_.push_back(first_responses(f));
        const Responses& fields = response_.back();
        std::vector<Vec3> translated, turned;
        std::vector<Mat3> m(feature_of_.size(), Mat3::Zero());
        for (std::size_t v = 0; v < feature_of_.size(); ++v) {
            translated.emplace_back(fields[0][v], 0.0, 0.0);
            turned.emplace_back(fields[1][v], fields[2][v], fields[3][v]);
        }
        add_columns(f, translated, m, {0, -1, -1});
        for (const Index v : vertices(f)) m[v].setIdentity();
        add_columns(f, turned, m, {1, 2, 3});
    }
    stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
}

void CommonGradients::release_first(std::vector<Vec3>& x, std::vector<Mat3>& m) const {
    if (size() == 0) return;
    const std::vector<Pull> forces = pulls(x, m);
    Eigen::MatrixX3d right(kParameters * size(), 3);
    for (Index f = 0; f < size(); ++f) {
        right.row(kParameters * f) = forces[f].translation.transpose();
        right.middleRows<3>(kParameters * f + 1) = forces[f].linear.transpose();
    }
    const Eigen::MatrixX3d parameters = stiffness_.ldlt().solve(right);
    for (Index f = 0; f < size(); ++f) {
        for (std::size_t v = 0; v < x.size(); ++v) {
            for (int k = 0; k < kParameters; ++k) {
                x[v] += response_[f][at(k)][v] * parameters.row(kParameters * f + k).transpose();
            }
        }
        for (const Index v : vertices(f)) {
            m[v] += parameters.middleRows<3>(kParameters * f + 1).transpose();
        }
    }
}

void CommonGradients::prepare_second(const Context& context) {
    const Index count = size();
    second_stiffness_.setZero(count, count);
    RotationSystem::Scratch scratch;
    for (Index f = 0; f < count; ++f) {
        std::vector<Vec4>& x = answer_.emplace_back(feature_of_.size(), Vec4::Zero());
        for (const Index v : vertices(f)) x[v] = padded(Vec3::Ones());
        if (!second_.free_vertices().empty()) second_.solve({}, x, false, scratch, context);
        for (Index g = 0; g < count; ++g) {
            second_stiffness_(g, f) = -second_.force(nullptr, x, vertices(g), scratch, context).x();
        }
    }
    second_stiffness_ = (0.5 * (second_stiffness_ + second_stiffness_.transpose())).eval();
}

void CommonGradients::release_second(const std::vector<PaddedMat3>& turns, std::vector<Vec4>& x,
                                     const Context& context) const {
    if (size() == 0) return;
    RotationSystem::Scratch scratch;
    Eigen::MatrixX3d right(size(), 3);
    for (Index f = 0; f < size(); ++f) {
        right.row(f) = second_.force(turns.data(), x, vertices(f), scratch, context).transpose();
    }
    const Eigen::MatrixX3d moves = second_stiffness_.ldlt().solve(right);
    for (Index f = 0; f < size(); ++f) {
        for (std::size_t v = 0; v < x.size(); ++v) {
            x[v].head<3>() += answer_[f][v].x() * moves.row(f).transpose();
        }
    }
}

}  // namespace lissom
