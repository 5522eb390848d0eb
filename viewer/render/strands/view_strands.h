/// Strands and surfaces of a picture, in view space: x right, y up, z towards the viewer.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "viewer/render/draw/snapshot.h"

namespace lissom {

/// The strands of a drawing that a picture shows.
struct ViewStrands {
    const Strands* strands = nullptr;
    const StrandStyle* style = nullptr;
    /// Number of strands that are drawn, the first ones.
    Index count = 0;
    /// Map from metres of the strands to view space.
    Eigen::Matrix3f linear = Eigen::Matrix3f::Identity();
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
    /// View units in a metre.
    float scale = 1.0f;
    /// Strands that each one stands for; it is so much wider.
    float stands_for = 1.0f;

    Eigen::Vector3f position(Index point) const {
        const float* const p = strands->points().data() + 3 * at(point);
        return linear * Eigen::Map<const Eigen::Vector3f>(p) + offset;
    }
    /// Returns the points of the strands that are drawn.
    Index point_count() const { return count == 0 ? 0 : strands->offsets()[count]; }
};

using ViewTriangle = std::array<Eigen::Vector3f, 3>;

/// Returns the strands of `snapshot`; `view` maps its world, moved so that `origin` is at zero, to
/// view space. Errors: out_of_range for a style; invalid_argument for a unit.
std::vector<ViewStrands> view_strands(const Snapshot& snapshot, const Mat4& view,
                                      const Vec3& origin);

/// Returns the triangles of its meshes.
std::vector<ViewTriangle> view_triangles(const Snapshot& snapshot, const Mat4& view,
                                         const Vec3& origin);

/// Linear colour of a point, without tones.
Eigen::Array3f strand_color(const ViewStrands& drawn, Index strand, Index point);

/// Returns how many strands a style draws of `size`; at least one if there are any.
Index drawn_count(const StrandStyle& style, Index size);

}  // namespace lissom
