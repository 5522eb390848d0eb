// SplitPatch of seam_patch.h: splits and collapses, before closing.
#include "kernel/merge/sew/seam_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>

namespace lissom {
namespace {

const SeamCorner& corner_of(const SeamFace& face, Index v) {
    return *std::find_if(face.corners.begin(), face.corners.end(),
                         [&](const SeamCorner& corner) { return corner.vertex == v; });
}

}  // namespace

// The link condition (Dey et al. 1999) at a boundary edge, and no face that turns over.
bool SplitPatch::can_collapse(Index face, Index gone, Index kept) const {
    const std::vector<Index> a = faces_.neighbors(gone), b = faces_.neighbors(kept);
    std::vector<Index> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    const bool is_triangle = faces_.faces()[face].corners.size() == 3;
    if (common.size() != (is_triangle ? 1U : 0U)) return false;
    for (const Index apex : common) {
        for (const Index v : {gone, kept}) {
            if (faces_.left_of(apex, v) == kNoIndex || faces_.left_of(v, apex) == kNoIndex)
                return false;
        }
    }
    for (const Index f : faces_.faces_at(gone)) {
        if (f == face) continue;
        SeamFace moved = faces_.faces()[f];
        for (SeamCorner& corner : moved.corners) {
            if (corner.vertex == gone) corner.vertex = kept;
        }
        if (!(faces_.area_vector(moved).dot(faces_.area_vector(faces_.faces()[f])) > 0.0))
            return false;
    }
    return true;
}

bool SplitPatch::collapse(Index gone, Index kept) {
    const Index along = faces_.left_of(gone, kept), against = faces_.left_of(kept, gone);
    if ((along == kNoIndex) == (against == kNoIndex)) return false;
    const Index face = along == kNoIndex ? against : along;
    if (!can_collapse(face, gone, kept)) return false;
    const SeamCorner gone_corner = corner_of(faces_.faces()[face], gone);
    const SeamCorner kept_corner = corner_of(faces_.faces()[face], kept);
    for (const Index f : faces_.faces_at(gone)) {
        std::vector<SeamCorner> corners = faces_.faces()[f].corners;
        if (f == face) {
            std::erase_if(corners, [&](const SeamCorner& c) { return c.vertex == gone; });
            if (corners.size() < 3) corners.clear();
        }
        // If the chart goes on across the collapsed face, its values at `kept` hold.
        for (SeamCorner& corner : corners) {
            if (corner.vertex != gone) continue;
            if (faces_.same_values(corner, gone_corner)) corner = kept_corner;
            corner.vertex = kept;
        }
        faces_.replace(f, std::move(corners));
    }
    faces_.forget(gone);
    return true;
}

void SplitPatch::split_edge(Index from, Index to, std::span<const Index> vertices,
                            std::span<const double> fractions) {
    // The other side may by now have an edge between the same two vertices, across a corner.
    const std::size_t side = faces_.side_of(from);
    faces_.triangulate(faces_.left_of(from, to, side));
    const Index face = faces_.left_of(from, to, side);
    const std::vector<SeamCorner> old = faces_.faces()[face].corners;
    std::size_t k = 0;
    while (old[k].vertex != from) ++k;
    const SeamCorner start = old[k], end = old[(k + 1) % 3], apex = old[(k + 2) % 3];
    SeamCorner last = start;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const SeamCorner next{vertices[i], start.first, end.first, fractions[i]};
        if (i == 0) {
            faces_.replace(face, {last, next, apex});
        } else {
            faces_.add({{last, next, apex}, faces_.faces()[face].origin});
        }
        last = next;
    }
    faces_.add({{last, end, apex}, faces_.faces()[face].origin});
}

void SplitPatch::remove(const std::set<Index>& origins) {
    for (std::size_t i = 0; i < faces_.faces().size(); ++i) {
        if (origins.contains(faces_.faces()[i].origin)) faces_.replace(index_of(i), {});
    }
}

void SplitPatch::merge_vertex(Index v, Index into) {
    for (const Index face : faces_.faces_at(v)) {
        std::vector<SeamCorner> corners = faces_.faces()[face].corners;
        for (SeamCorner& corner : corners) {
            if (corner.vertex == v) corner.vertex = into;
        }
        faces_.replace(face, std::move(corners));
    }
    faces_.forget(v);
}

}  // namespace lissom
