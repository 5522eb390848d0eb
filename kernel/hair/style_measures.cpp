#include "kernel/hair/style_measures.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace lissom {
namespace {

constexpr Index kGrain = 256;

// Whether the strand goes through the surface that the normals of the line sweep.
bool crosses(const StrandView& strand, const DividingLine& line, double reach) {
    DividingPlace before = line.place(point_of(strand, 0));
    double grown = 0.0;
    for (Index i = 1; i < strand.cols() && grown < reach; ++i) {
        const Vec3 from = point_of(strand, i - 1), to = point_of(strand, i);
        const double length = (to - from).norm();
        const double part = length > 0.0 ? std::min(1.0, (reach - grown) / length) : 1.0;
        const DividingPlace here = line.place(from + part * (to - from));
        const bool beside = before.beyond == 0.0 && here.beyond == 0.0;
        if (beside && before.across * here.across < 0.0) return true;
        before = here;
        grown += length;
    }
    return false;
}

bool passes(const StrandView& strand, const PonytailSection& section) {
    const auto height = [&](const Vec3& p) { return (p - section.center).dot(section.direction); };
    for (Index i = 1; i < strand.cols(); ++i) {
        const Vec3 from = point_of(strand, i - 1), to = point_of(strand, i);
        const double below = height(from), above = height(to);
        if (!(below < 0.0 && above >= 0.0)) continue;
        const Vec3 at = from + below / (below - above) * (to - from);
        if ((at - section.center).norm() <= section.radius) return true;
    }
    return false;
}

// Counts strands; `judge` says whether a strand is looked at and whether it is found.
template <typename Judge>
StrandFraction count(const Strands& strands, const Context& context, const Judge& judge) {
    std::atomic<Index> looked_at = 0, found = 0;
    context.parallel_for(0, strands.size(), kGrain, [&](Index begin, Index end) {
        StrandFraction part;
        for (Index s = begin; s < end; ++s) judge(strands.strand(s), part);
        looked_at += part.strands;
        found += part.found;
    });
    return {looked_at, found};
}

}  // namespace

StrandFraction parting_crossings(const Strands& strands, const DividingLine& line,
                                 const CrossingOptions& options, const Context& context) {
    if (!(options.near >= 0.0) || !(options.reach >= 0.0)) {
        throw Error(ErrorCode::invalid_argument, "near and reach must be 0 or more");
    }
    return count(strands, context, [&](const StrandView& strand, StrandFraction& part) {
        if (line.skin_distance(point_of(strand, 0)) > options.near) return;
        ++part.strands;
        if (crosses(strand, line, options.reach)) ++part.found;
    });
}

StrandFraction section_passages(const Strands& strands, const PonytailSection& section,
                                const Context& context) {
    return count(strands, context, [&](const StrandView& strand, StrandFraction& part) {
        ++part.strands;
        if (passes(strand, section)) ++part.found;
    });
}

}  // namespace lissom
