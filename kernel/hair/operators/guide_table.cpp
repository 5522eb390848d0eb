#include "kernel/hair/operators/guide_table.h"

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
        add_segments(strand.cols());
    }
    for (Index& guide : guide_of_) {
        if (guide != kNoIndex && count_[at(guide)] == 0) guide = kNoIndex;
    }
}

void GuideTable::add_segments(Eigen::Index count) {
    for (std::size_t k = points_.size() - at(index_of(count)); k < points_.size(); ++k) {
        const Vec3 along =
            k + 1 < points_.size() ? Vec3(points_[k + 1] - points_[k]) : Vec3::Zero();
        const double size = along.norm();
        tangents_.push_back(size > 0.0 ? Vec3(along / size) : Vec3::Zero());
        parts_.push_back(size > 0.0 ? 1.0 / size : 0.0);
    }
}

void ensure_guides(Strands& strands, Index guides, const Context& context) {
    require(guides >= 0, "the number of guides must not be negative");
    if (guides == 0 && !strands.guides().ids.empty()) return;
    GuideOptions options;
    options.count = guides == 0 ? kUsualGuides : guides;
    assign_guides(strands, options, context);
}

}  // namespace lissom
