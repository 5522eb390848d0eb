/// AttributeQuadrics: distances of values at a point from linear functions on triangles (Hoppe
/// 1999), for each sector of corners. Private to kernel/mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/resample/quadric.h"
#include "kernel/mesh/resample/triangle_editor.h"

namespace lissom {

/// Columns are the numbers of texture coordinates, colors, skin weights, displacements of morph
/// targets, and of attributes of real numbers without a meaning. A difference as great as the range
/// of a column counts as the distance `unit`. Sums are taken around `center`, for their digits.
class AttributeQuadrics {
  public:
    AttributeQuadrics(const Mesh& mesh, const TriangleEditor& editor, double unit,
                      const Vec3& center);

    bool empty() const { return columns_ == 0; }

    /// Returns the error at `p` with the best values there, once two sectors have merged.
    double best(Index sector, Index other, const Vec3& p) const;
    /// Returns the error at `p` with the values that `sector` has.
    double kept(Index sector, Index other, const Vec3& p) const;
    /// Merges `other` into `sector`, which keeps its values, or takes the best for `p`.
    void merge(Index sector, Index other);
    void merge_at(Index sector, Index other, const Vec3& p);

  private:
    // Of w (g p + d - s)^2: the sums of w g and w d.
    struct Linear {
        Vec3 gradient = Vec3::Zero();
        double constant = 0.0;
        double at(const Vec3& p) const { return gradient.dot(p) + constant; }
    };

    void read_column(const TriangleEditor& editor, const Attribute& attribute, Index k,
                     Index column, double unit);
    void add_triangles(const TriangleEditor& editor, Index column);
    std::size_t place(Index sector, Index column) const {
        return lissom::at(sector) * lissom::at(columns_) + lissom::at(column);
    }

    Vec3 center_;
    Index columns_ = 0;
    std::vector<double> values_;
    std::vector<Linear> linear_;
    std::vector<Quadric> quadrics_;
};

}  // namespace lissom
