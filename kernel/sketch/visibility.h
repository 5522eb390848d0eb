/// Visibility: occlusion by the surfaces of a scene in a view; private to kernel/sketch.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/sketch/cursor_frame.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/view.h"

namespace lissom {

class Visibility {
  public:
    /// `back_faces`: whether faces that are seen from behind hide the points beyond them.
    Visibility(const PickScene& scene, const View& view, bool back_faces);

    /// Returns whether a surface hides a point of an object, given in the object's frame, and more
    /// than `slack` (in the world) in front of it.
    bool is_hidden(Index object, const Vec3& local, double slack = 0.0) const;
    /// Returns whether the camera stands in front of a triangle of a face of a surface that has all
    /// of these vertices.
    bool faces_eye(Index object, Index face, std::span<const Index> vertices = {}) const;
    /// Returns whether it stands in front of one of the triangles around a vertex.
    bool vertex_faces_eye(Index object, Index v) const;

  private:
    const PickScene& scene_;
    const View& view_;
    bool back_faces_;
    std::vector<CursorFrame> frames_;
};

/// Returns the triangles of a face that have all of these vertices.
std::vector<Triangle> triangles_with(const SpatialTree& surface, Index face,
                                     std::span<const Index> vertices);

/// Returns the normal of a face, as long as its area.
Vec3 face_vector(const SpatialTree& surface, Index face);

}  // namespace lissom
