/// The guides of strands as curves, taken before an operator moves them; private to kernel/hair.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

class GuideTable {
  public:
    explicit GuideTable(const Strands& strands);

    /// Returns the guide of a strand, or kNoIndex.
    Index guide_of(Index strand) const { return guide_of_[at(strand)]; }
    /// Whether a strand follows another one.
    bool follows(Index strand) const {
        return guide_of_[at(strand)] != kNoIndex && guide_of_[at(strand)] != strand;
    }
    double length(Index guide) const { return arcs_[at(end(guide)) - 1]; }
    /// Returns the guide's point at an arc, at most that of its tip; `below` grows with the arc and
    /// begins as 0.
    Vec3 at_arc(Index guide, double arc, Index& below) const {
        const std::size_t first = at(begin(guide));
        const Index last = count_[at(guide)] - 1;
        while (below + 1 < last && arcs_[first + at(below) + 1] < arc) ++below;
        const std::size_t k = first + at(below);
        const double u = std::clamp((arc - arcs_[k]) * parts_[k], 0.0, 1.0);
        return points_[k] + u * (points_[k + 1] - points_[k]);
    }
    /// Unit tangent there, of the segment found last.
    const Vec3& tangent(Index guide, Index below) const {
        return tangents_[at(begin(guide) + below)];
    }

  private:
    // Those of the last guide, once its points stand.
    void add_segments(Eigen::Index count);
    Index begin(Index guide) const { return first_[at(guide)]; }
    Index end(Index guide) const { return first_[at(guide)] + count_[at(guide)]; }

    // Strands that are no guides have no points.
    std::vector<Index> guide_of_, first_, count_;
    // Of a guide's points, and of the segments after them: tangents, and what a metre is of each.
    std::vector<Vec3> points_, tangents_;
    std::vector<double> arcs_, parts_;
};

/// Assigns `guides` guides, or if that is 0 and strands have none, the usual number.
void ensure_guides(Strands& strands, Index guides, const Context& context);

}  // namespace lissom
