/// Springs across the inside of a solid, which keep its thickness and with it its volume: the
/// energy of a surface alone knows no inside, so that twisted parts get a waist. Private to
/// kernel/deform.
///
/// Pairs of opposite points (thickness.h) with target vectors T_i, turned by the mean rotation of
/// both ends, are taken together in overlapping patches: row r of B asks that the mean over its
/// pairs of x_i - x_o(i) be that of T_i, with stiffness k_r. As the rows are few, the systems of
/// the surface keep their factor K, and a frame is corrected by
///     x += U (B U + 1 / k)^-1 (T - B x),  U = K^-1 B^T.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/deform/volume/thickness.h"

namespace lissom {

class VolumeSprings {
  public:
    /// Buffers of corrections, and the factor for the last share, 0 if there is none that is of
    /// these springs; kept by the caller.
    struct Scratch {
        std::vector<Vec4> error;
        Eigen::MatrixX3d answer;
        Eigen::LLT<Eigen::MatrixXd> factor;
        double factored_for = 0.0;
    };

    /// The present shape of a frame, relative to a base whose rotation is `base`: S_i less `base`,
    /// and positions less those of the base.
    struct Shape {
        const Mat3& base;
        std::span<const PaddedMat3> rotations;
        /// The logarithm of the greatest stretch that handles ask for near each vertex; empty
        /// without any. The springs fade as it grows.
        std::span<const Vec4> strain;
    };

    /// Errors: memory_limit; cancelled.
    VolumeSprings(const Thickness& thickness, const WorkingPatch& work, const KnownMask& known,
                  const RotationSystem& second, const Context& context);

    /// Whether there is no inside to keep.
    bool empty() const { return rows_.empty(); }
    /// Corrects positions `x` of all local vertices, a solution of the second system, for a volume
    /// kept by `share`, above 0 and at most 1. The caller sets `factored_for` of scratch from other
    /// springs to 0.
    void correct(const Shape& shape, double share, std::span<Vec4> x, Scratch& scratch,
                 const Context& context) const;

  private:
    /// A mean of pairs: their numbers and coefficients, which add up to 1.
    struct Row {
        std::vector<std::pair<Index, double>> pairs;
        double stiffness = 0.0;
    };

    void gather_rows(const WorkingPatch& work);
    void find_responses(Index vertices, const RotationSystem& second, const Context& context);
    /// Returns x_i - x_o(i), and the mean of a row.
    static Vec3 across(const ThicknessPair& pair, std::span<const Vec4> x);
    Vec3 mean_across(const Row& row, std::span<const Vec4> x) const;
    static double say_of(const ThicknessPair& pair, std::span<const Vec4> strain);
    void find_errors(const Shape& shape, std::span<const Vec4> x, std::vector<Vec4>& error,
                     const Context& context) const;
    void factor(double share, Scratch& scratch) const;

    std::vector<ThicknessPair> pairs_;
    std::vector<Row> rows_;
    std::vector<Index> free_;
    /// U, a row of `rows_.size()` numbers for each free vertex, and B U.
    std::vector<float> response_;
    Eigen::MatrixXd compliance_;
    MemoryCharge charge_;
};

}  // namespace lissom
