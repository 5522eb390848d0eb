/// Intrinsic Delaunay triangulation: the surface of a triangle mesh with other edges, straight in
/// the surface and given by their lengths only. Private to kernel/mesh.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Triangles glued along their sides. Side s of a triangle runs from its vertex s to vertex s + 1;
/// two corners of a triangle may be the same vertex. Cotangent weights are not negative, up to
/// rounding. Sharp and Crane, "A Laplacian for nonmanifold triangle meshes" (2020), sections 3.3
/// and 4.
class IntrinsicDelaunay {
  public:
    /// Lengths are mollified first: all grow by one amount, at most 1e-5 of their mean, so that
    /// every triangle has an area. Then edges are flipped until all are Delaunay.
    IntrinsicDelaunay(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                      const Context& context);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::array<double, 3>& lengths(std::size_t triangle) const { return lengths_[triangle]; }
    /// Corners laid out in the plane, counter-clockwise, the first at the origin.
    std::array<Vec2, 3> layout(std::size_t triangle) const;
    /// Area, and the cotangent at every corner.
    double area(std::size_t triangle) const;
    std::array<double, 3> cotangents(std::size_t triangle) const;
    double mean_length() const;

  private:
    void glue();
    void mollify();
    void flip_to_delaunay(const Context& context);
    bool is_delaunay(Index side) const;
    void flip(Index side);
    void set_triangle(Index triangle, const Triangle& vertices,
                      const std::array<double, 3>& lengths, const std::array<Index, 3>& twins);

    std::vector<Triangle> triangles_;
    std::vector<std::array<double, 3>> lengths_;
    // The side (3 * triangle + s) on the other side of each side, or kNoIndex.
    std::vector<Index> twin_;
};

}  // namespace lissom
