/// GrowthRoots: the data of roots that do not depend on the field; private to kernel/hair.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Strands that are grown together before they are put in order; within such a wave neighbours are
/// grown one after the other, so that they read the same part of the field.
inline constexpr Index kGrowthWave = 4096;

/// Random numbers of a strand.
struct StrandChance {
    /// In [-1, 1): of the length, of the layer, and of the cut.
    float length, layer, cut;
    /// In [0, 1): of the tail.
    float tail;
};

/// Inputs of the factors of lengths.
struct LengthFactors {
    /// For every vertex of the head; empty for none.
    std::vector<double> map;
    std::vector<MaskStroke> masks;

    bool operator==(const LengthFactors&) const = default;
};

/// All roots in the order of growth, which keeps the waves: entry i is root number[i].
class GrowthRoots {
  public:
    /// Errors: invalid_argument for roots that are not of `head`; not_finite; memory_limit;
    /// cancelled.
    GrowthRoots(const Mesh& head, std::span<const Root> roots, const Context& context);

    Index size() const { return count_of(numbers_); }
    Index number(Index i) const { return numbers_[at(i)]; }
    const Vec3& position(Index i) const { return positions_[at(i)]; }
    const Eigen::Vector3f& normal(Index i) const { return normals_[at(i)]; }
    const StrandChance& chance(Index i) const { return chances_[at(i)]; }
    /// Factor of the length.
    float factor(Index i) const { return factors_.empty() ? 1.0f : factors_[at(i)]; }
    /// In the order of the roots.
    const StrandRoots& strand_roots() const { return strand_roots_; }
    Index head_vertices() const { return head_vertices_; }

    /// Draws the random numbers, if the seed has changed.
    void set_seed(std::uint64_t seed, const Context& context);
    /// Computes the factors, if their inputs have changed.
    void set_factors(LengthFactors wanted, const Context& context);

  private:
    double mapped(Index i, const std::vector<double>& map) const;
    void put_in_order(std::span<const Root> roots, const Context& context);

    Index head_vertices_ = 0;
    MemoryCharge charge_;
    std::vector<Index> numbers_;
    std::vector<Vec3> positions_;
    std::vector<Eigen::Vector3f> normals_;
    std::vector<Triangle> triangles_;
    std::vector<Eigen::Vector3f> barycentrics_;
    StrandRoots strand_roots_;

    std::optional<std::uint64_t> seed_;
    std::vector<StrandChance> chances_;
    LengthFactors origin_;
    std::vector<float> factors_;
};

}  // namespace lissom
