#include "kernel/hair/strands/strand_selection.h"

#include <algorithm>
#include <cmath>

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"

namespace lissom {
namespace {

constexpr Index kSelectionGrain = 256;

// A curve to which distances of segments are asked for.
class Tube {
  public:
    Tube(std::span<const Vec3> curve, double radius)
        : curve_(without_repeated_points(curve)), radius_(radius) {
        for (const Vec3& p : curve_) box_.extend(p);
        box_.min.array() -= radius;
        box_.max.array() += radius;
    }

    bool meets(const StrandView& strand) const {
        if (strand.cols() == 1)
            return foot_on_curve(curve_, point_of(strand, 0)).distance < radius_;
        for (Index i = 1; i < strand.cols(); ++i) {
            if (meets(point_of(strand, i - 1), point_of(strand, i))) return true;
        }
        return false;
    }

  private:
    bool meets(const Vec3& from, const Vec3& to) const {
        if ((from.cwiseMin(to).array() > box_.max.array()).any()) return false;
        if ((from.cwiseMax(to).array() < box_.min.array()).any()) return false;
        for (std::size_t i = 0; i + 1 < curve_.size(); ++i) {
            if (segment_distance(from, to, curve_[i], curve_[i + 1]) < radius_) return true;
        }
        return false;
    }

    std::vector<Vec3> curve_;
    double radius_;
    Box box_;
};

std::vector<Index> marked(const std::vector<char>& marks) {
    std::vector<Index> list;
    for (std::size_t s = 0; s < marks.size(); ++s) {
        if (marks[s]) list.push_back(index_of(s));
    }
    return list;
}

}  // namespace

std::vector<Index> strands_rooted_in(const Strands& strands, const Region& region) {
    const std::vector<Index>& faces = strands.roots().faces;
    if (faces.empty() && !strands.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    "the roots of these strands are not known; grow them on a head");
    }
    std::vector<char> inside(region.topology()->face_count(), 0);
    for (const Index f : region.faces()) inside[f] = 1;
    std::vector<char> marks;
    for (const Index f : faces) {
        if (f >= region.topology()->face_count()) {
            throw Error(ErrorCode::invalid_argument,
                        "strands are rooted on a face that the region's mesh does not have; give a "
                        "region of the head that they grew on");
        }
        marks.push_back(f >= 0 ? inside[f] : 0);
    }
    return marked(marks);
}

std::vector<Index> strands_near_curve(const Strands& strands, std::span<const Vec3> curve,
                                      double radius, const Context& context) {
    require_curve(curve);
    if (!(radius >= 0.0) || !std::isfinite(radius)) {
        throw Error(ErrorCode::invalid_argument, "the radius around a curve must be 0 or more");
    }
    const Tube tube(curve, radius);
    std::vector<char> marks(strands.size(), 0);
    context.parallel_for(0, strands.size(), kSelectionGrain, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            marks[s] = tube.meets(strands.strand(s)) ? 1 : 0;
        }
    });
    return marked(marks);
}

}  // namespace lissom
