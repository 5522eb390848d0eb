/// Features of a surface whose Laplacian coordinates share one deformation gradient, which is an
/// unknown of both systems (thesis section 3.5); private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/gradient_residual.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/rotation_system.h"

namespace lissom {

/// Both systems know the positions and gradients of the features' vertices. An affine map of a
/// feature has twelve parameters: it moves the solution by as many responses, four fields for all
/// coordinates, found once. The minimum of the total energy follows from the forces on the
/// features, by a dense system of four unknowns a feature.
class CommonGradients {
  public:
    /// `features` are local vertices. The arguments must live as long.
    CommonGradients(const WorkingPatch& work, std::vector<std::vector<Index>> features,
                    const GradientSystem& first, const GradientResidual& energy,
                    const RotationSystem& second);

    Index size() const { return count_of(features_); }
    const std::vector<Index>& vertices(Index feature) const { return features_[at(feature)]; }
    /// The feature of a local vertex, or kNoIndex.
    Index feature_of(Index v) const { return feature_of_[at(v)]; }
    /// Returns the offset of a vertex of a feature from the feature's middle.
    Vec3 arm(Index v) const;

    /// Finds the responses. Both systems are factored, and the second is finished.
    void prepare(const Context& context);

    /// From a solution of the first system (positions and known gradients, both deviations from an
    /// affine map) in which the features stay to the one in which each has the affine map of least
    /// energy.
    void release_first(std::vector<Vec3>& x, std::vector<Mat3>& m) const;
    /// Goes from a solution of the second system to the one in which each feature has moved,
    /// without turning, to a position free of force.
    void release_second(const std::vector<PaddedMat3>& turns, std::vector<Vec4>& x,
                        const Context& context) const;

  private:
    /// Half the downward gradient of the energy by a feature's translation and linear part.
    struct Pull {
        Vec3 translation = Vec3::Zero();
        Mat3 linear = Mat3::Zero();
    };
    using Responses = std::array<std::vector<double>, 4>;

    std::vector<Pull> pulls(const std::vector<Vec3>& x, const std::vector<Mat3>& m) const;
    Responses first_responses(Index feature) const;
    void prepare_first();
    void add_columns(Index feature, const std::vector<Vec3>& x, const std::vector<Mat3>& m,
                     std::array<int, 3> parameter);
    void prepare_second(const Context& context);

    const WorkingPatch& work_;
    std::vector<std::vector<Index>> features_;
    const GradientSystem& first_;
    const GradientResidual& energy_;
    const RotationSystem& second_;
    std::vector<Index> feature_of_;
    std::vector<Vec3> center_;
    std::vector<Responses> response_;
    std::vector<std::vector<Vec4>> answer_;
    Eigen::MatrixXd stiffness_, second_stiffness_;
};

}  // namespace lissom
