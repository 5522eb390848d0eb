/// Loop: an open boundary of a mesh as merging sees it, with its arc length, frames and moments;
/// private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Measure of a loop: a jagged one counts as the smooth line along it, and its normals
/// are those on the boundary itself; or as it is (the thesis).
enum class LoopMeasure { robust, raw };

/// A closed curve through vertices of a mesh, taken at the mesh's present shape.
class Loop {
  public:
    /// Takes the vertices in the given order.
    /// Errors: boundary_conflict if the loop has fewer than 3 vertices or no length.
    Loop(const Mesh& mesh, std::vector<Index> vertices, LoopMeasure measure = LoopMeasure::robust,
         const Context& context = {});

    /// The same loop with other ids of its vertices, in their order, as a part of the mesh has
    /// them.
    Loop renumbered(std::vector<Index> vertices) const;

    Index size() const { return count_of(vertices_); }
    const std::vector<Index>& vertices() const { return vertices_; }
    const std::vector<Vec3>& points() const { return points_; }
    double length() const { return length_; }

    /// Returns the parameter of each vertex along the loop, 0 to 1 and ascending from 0: arc length
    /// of the curve smoothed by sigma .03 of its length, so that a jagged loop is not longer than a
    /// smooth one; of a raw loop its own arc length.
    const std::vector<double>& parameters() const { return parameters_; }
    /// The parameter of a place, and the place at a parameter; any real number counts modulo 1.
    double parameter_of(const LoopPoint& place) const;
    LoopPoint place_at(double parameter) const;
    /// The place nearest to a point, and how far it is.
    LoopPoint nearest(const Vec3& point, double& distance) const;

    /// Frames (tangent, normal, binormal) in columns at every vertex: tangents of the loop and
    /// normals of the surface on its one side, weighted by angle and, but for a raw loop, continued
    /// to the boundary; both smoothed along the loop by `sigma` of its length; 0 takes them as they
    /// are.
    std::vector<Mat3> frames(double sigma) const;
    /// Length of the tangent at every vertex: the mean of the two edges there.
    std::vector<double> tangent_lengths() const;

    /// Mean of the curve by arc length, and RMS distance of the curve to it.
    const Vec3& center() const { return center_; }
    double radius() const { return radius_; }
    /// Returns the unit vector of the area that the curve encloses; zero for an area of zero.
    Vec3 axis() const;
    /// Mean angle, in radians, between an edge and the next.
    double mean_turn() const;

  private:
    std::vector<Vec3> smoothed(std::span<const Vec3> values, double sigma) const;
    void find_moments();
    void find_parameters(LoopMeasure measure);
    double edge(Index k) const { return edges_[at(k)]; }

    std::vector<Index> vertices_;
    std::vector<Vec3> points_, normals_;
    /// Lengths of edges and true arc length up to each vertex.
    std::vector<double> edges_, arc_, parameters_;
    double length_ = 0.0, radius_ = 0.0;
    Vec3 center_ = Vec3::Zero();
};

/// Returns the value at a place between the vertices of a loop.
template <typename T>
T interpolated(const std::vector<T>& values, const LoopPoint& place) {
    const auto k = at(place.segment);
    return (1.0 - place.t) * values[k] + place.t * values[(k + 1) % values.size()];
}

}  // namespace lissom
