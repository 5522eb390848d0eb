/// Shares by which vertices of a surface follow a thinned one; private to kernel/deform.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/levels/thinned_surface.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Vertices of the thinned surface that a vertex follows, with shares that sum to 1. Unused entries
/// have a share of 0.
struct SurfaceFollow {
    static constexpr std::size_t kMost = 8;
    std::array<Index, kMost> vertex{};
    std::array<float, kMost> share{};
};

/// Returns for each vertex of `triangles` the vertices of its thinned surface that it follows: the
/// corners of the triangle nearest to it, blended with those of its neighbours so that the shares
/// have no kinks. Vertices without faces follow none. Errors: cancelled; memory_limit.
std::vector<SurfaceFollow> bind_surface(const Mesh& triangles, const ThinnedSurface& thinned,
                                        const Context& context);

/// Returns the motion of the surface around each vertex of the thinned one: p goes to
/// linear p + translation. The linear part is the rotation that fits the edges around it best; with
/// `scales`, times their mean change of length.
std::vector<Affine> surface_motions(const Mesh& thinned, std::span<const Vec3> moved, bool scales,
                                    const Context& context);

/// Returns the place of a vertex that rests at `p`.
inline Vec3 followed(const SurfaceFollow& follow, std::span<const Affine> motions, const Vec3& p) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < SurfaceFollow::kMost && follow.share[k] > 0.0F; ++k) {
        sum += double(follow.share[k]) * motions[at(follow.vertex[k])](p);
    }
    return sum;
}

/// Returns the linear part of the same motion.
inline Mat3 followed_linear(const SurfaceFollow& follow, std::span<const Affine> motions) {
    Mat3 sum = Mat3::Zero();
    for (std::size_t k = 0; k < SurfaceFollow::kMost && follow.share[k] > 0.0F; ++k) {
        sum += double(follow.share[k]) * motions[at(follow.vertex[k])].linear;
    }
    return sum;
}

}  // namespace lissom
