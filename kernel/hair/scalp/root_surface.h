/// The triangles that roots may lie on, with their densities, and random points on them; private to
/// kernel/hair.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Random numbers that depend on the seed and a counter alone (Steele, Lea and Flood 2014).
class CountedRandom {
  public:
    CountedRandom(std::uint64_t seed, std::uint64_t counter)
        : state_(mixed(seed) ^ (counter * 0xd1342543de82ef95ULL)) {}

    std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15ULL;
        return mixed(state_);
    }
    /// In [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  private:
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

class RootSurface {
  public:
    /// Errors: as make_roots.
    RootSurface(const Mesh& head, const Scalp& scalp, const RootOptions& options);

    /// Integral of the density, at most 1, over the surface.
    double mass() const { return mass_; }

    /// A random point, even in area.
    struct Dart {
        /// Index into `triangles`.
        Index triangle = kNoIndex;
        Vec3 barycentric = Vec3::Zero();
    };
    Dart random_dart(CountedRandom& random) const;
    Index triangle_count() const { return count_of(triangles_.triangles); }
    Vec3 position(const Dart& dart) const;
    /// Relative to the largest, 0 to 1.
    double density(const Dart& dart) const;
    /// Without its normal.
    Root root(const Dart& dart) const;
    /// Returns the density at a point of a face; 0 if the face is no part of the scalp.
    double density_at(Index face, const Triangle& triangle, const Vec3& barycentric) const;

  private:
    Index random_triangle(CountedRandom& random) const;
    void build_alias_table(const std::vector<double>& areas);

    const Mesh& head_;
    const Scalp& scalp_;
    /// For every vertex, relative to the largest on the scalp.
    std::vector<double> density_;
    ScalpMask mask_;
    Triangulation triangles_;
    std::vector<char> on_scalp_;
    /// Walker's alias table of the triangles' areas.
    std::vector<double> keep_;
    std::vector<Index> alias_;
    double mass_ = 0.0;
};

}  // namespace lissom
