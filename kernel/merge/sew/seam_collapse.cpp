// Collapse of short edges on the boundary of a patch.

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>

#include "kernel/merge/sew/seam_patch.h"

namespace lissom {
namespace {

const SeamCorner& corner_of(const SeamFace& face, Index v) {
    return *std::find_if(face.corners.begin(), face.corners.end(),
                         [&](const SeamCorner& corner) { return corner.vertex == v; });
}

}  // namespace

// The link condition (Dey et al. 1999) at a boundary edge, and no face that turns over.
bool SeamPatch::can_collapse(Index face, Index gone, Index kept) const {
    const std::vector<Index> a = neighbors(gone), b = neighbors(kept);
    std::vector<Index> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    const bool is_triangle = faces_[face].corners.size() == 3;
    if (common.size() != (is_triangle ? 1U : 0U)) return false;
    for (const Index apex : common) {
        for (const Index v : {gone, kept}) {
            if (left_of(apex, v) == kNoIndex || left_of(v, apex) == kNoIndex) return false;
        }
    }
    for (const Index f : faces_at_.at(gone)) {
        if (f == face) continue;
        SeamFace moved = faces_[f];
        for (SeamCorner& corner : moved.corners) {
            if (corner.vertex == gone) corner.vertex = kept;
        }
        if (!(area_vector(moved).dot(area_vector(faces_[f])) > 0.0)) return false;
    }
    return true;
}

bool SeamPatch::collapse(Index gone, Index kept) {
    const Index along = left_of(gone, kept), against = left_of(kept, gone);
    if ((along == kNoIndex) == (against == kNoIndex)) return false;
    const Index face = along == kNoIndex ? against : along;
    if (!can_collapse(face, gone, kept)) return false;
    const SeamCorner gone_corner = corner_of(faces_[face], gone);
    const SeamCorner kept_corner = corner_of(faces_[face], kept);
    for (const Index f : std::vector<Index>(faces_at_[gone])) {
        std::vector<SeamCorner> corners = faces_[f].corners;
        if (f == face) {
            std::erase_if(corners, [&](const SeamCorner& c) { return c.vertex == gone; });
            if (corners.size() < 3) corners.clear();
        }
        // Where the chart goes on across the collapsed face, its values at `kept` hold.
        for (SeamCorner& corner : corners) {
            if (corner.vertex != gone) continue;
            if (same_values(corner, gone_corner)) corner = kept_corner;
            corner.vertex = kept;
        }
        replace(f, std::move(corners));
    }
    faces_at_.erase(gone);
    return true;
}

}  // namespace lissom
