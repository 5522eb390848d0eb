#include "kernel/hair/operators/guide_table.h"

#include <algorithm>

#include "kernel/core/error.h"
#include "kernel/hair/operators/strand_gather.h"
#include "kernel/hair/strands/strand_guides.h"

namespace lissom {

GuideTable::GuideTable(const Strands& strands)
    : guide_of_(present_guides(strands)),
      first_(at(strands.size()), kNoIndex),
      count_(at(strands.size()), 0) {
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        if (guide_of_[at(s)] != s || strand.cols() < 2 || !strand.allFinite()) continue;
        first_[at(s)] = count_of(points_);
        count_[at(s)] = index_of(strand.cols());
        for (Index k = 0; k < strand.cols(); ++k) {
            const Vec3 p = point_of(strand, k);
            arcs_.push_back(k == 0 ? 0.0 : arcs_.back() + (p - points_.back()).norm());
            points_.push_back(p);
        }
    }
    for (Index& guide : guide_of_) {
        if (guide != kNoIndex && count_[at(guide)] == 0) guide = kNoIndex;
    }
}

Vec3 GuideTable::at_arc(Index guide, double arc, Index& below) const {
    const Index first = begin(guide), last = count_[at(guide)] - 1;
    while (below + 1 < last && arcs_[at(first + below + 1)] < arc) ++below;
    const double from = arcs_[at(first + below)], size = arcs_[at(first + below + 1)] - from;
    const double u = size > 0.0 ? std::clamp((arc - from) / size, 0.0, 1.0) : 0.0;
    const Vec3& a = points_[at(first + below)];
    return a + u * (points_[at(first + below + 1)] - a);
}

Vec3 GuideTable::tangent(Index guide, Index below) const {
    const Index first = begin(guide);
    const Vec3 along = points_[at(first + below + 1)] - points_[at(first + below)];
    const double size = along.norm();
    return size > 0.0 ? Vec3(along / size) : Vec3::Zero();
}

void ensure_guides(Strands& strands, Index guides, const Context& context) {
    require(guides >= 0, "the number of guides must not be negative");
    if (guides == 0 && !strands.guides().ids.empty()) return;
    GuideOptions options;
    options.count = guides == 0 ? kUsualGuides : guides;
    assign_guides(strands, options, context);
}

}  // namespace lissom
