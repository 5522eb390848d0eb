#include "kernel/hair/strands/strand_guides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_frames.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr int kAxes = 6;
constexpr Index kGuideGrain = 256;

Vec3 point_at(const StrandView& strand, const StrandPlace& place) {
    const Vec3 a = strand.col(place.below).cast<double>();
    if (place.u == 0.0f) return a;
    return a + place.u * (strand.col(place.below + 1).cast<double>() - a);
}

// The tangent at each point: the direction from the point before to the one after.
std::vector<Vec3> tangents_of(const std::vector<Vec3>& points) {
    std::vector<Vec3> tangents;
    Vec3 tangent = Vec3::UnitY();
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 along = points[std::min(k + 1, points.size() - 1)] - points[k == 0 ? 0 : k - 1];
        if (along.norm() > 0.0) tangent = along.normalized();
        tangents.push_back(tangent);
    }
    return tangents;
}

Mat3 frame_of(const Vec3& normal, const Vec3& tangent) {
    Mat3 frame;
    const Vec3 across = (normal - normal.dot(tangent) * tangent).normalized();
    frame << across, tangent.cross(across), tangent;
    return frame;
}

void require_guides(const GuideOptions& options) {
    require(options.count >= 1, "there must be at least one guide");
    require(options.apart >= 0.0 && std::isfinite(options.apart),
            "'apart' of guides must be finite and not negative");
    require(options.radius > 0.0, "the radius around guides must be positive");
}

// The usable strands of the lowest ids, in the order of their ids.
std::vector<Index> guide_strands(const Strands& strands, Index count) {
    std::vector<Index> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (strands.point_count(s) > 1 && strands.strand(s).allFinite()) list.push_back(s);
    }
    const auto lower = [&](Index a, Index b) {
        return std::pair(strands.id(a), a) < std::pair(strands.id(b), b);
    };
    const auto last = list.begin() + std::min(count, count_of(list));
    std::partial_sort(list.begin(), last, list.end(), lower);
    list.erase(last, list.end());
    return list;
}

Index family_of(const Strands& strands, Index s, const GuideOptions& options) {
    return options.within_groups ? strands.group(s) : kNoIndex;
}

// The guides of one group.
struct Family {
    std::vector<Index> strands;
    GuideTree tree{{}};
};

std::map<Index, Family> families_of(const Strands& strands, const GuideOptions& options) {
    std::map<Index, Family> families;
    for (const Index s : guide_strands(strands, options.count)) {
        families[family_of(strands, s, options)].strands.push_back(s);
    }
    for (auto& entry : families) {
        std::vector<GuideKey> keys;
        for (const Index s : entry.second.strands) {
            keys.push_back(guide_key(strands.strand(s), options.apart));
        }
        entry.second.tree = GuideTree(std::move(keys));
    }
    return families;
}

}  // namespace

GuideKey guide_key(const StrandView& strand, double apart) {
    const Vec3 root = strand.col(0).cast<double>();
    Vec3 middle = root;
    if (strand.cols() > 1) {
        std::vector<double> t;
        arc_fractions(strand, t);
        middle = point_at(strand, place_at(t, 0.5));
    }
    GuideKey key;
    key << root, apart * (middle - root);
    return key;
}

GuideTree::GuideTree(std::vector<GuideKey> keys) : keys_(std::move(keys)), order_(keys_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    build(0, count_of(order_), 0);
}

void GuideTree::build(Index begin, Index end, int axis) {
    if (end - begin < 2) return;
    const Index middle = begin + (end - begin) / 2;
    const auto first = order_.begin();
    std::nth_element(first + begin, first + middle, first + end, [&](Index a, Index b) {
        return std::pair(keys_[at(a)][axis], a) < std::pair(keys_[at(b)][axis], b);
    });
    build(begin, middle, (axis + 1) % kAxes);
    build(middle + 1, end, (axis + 1) % kAxes);
}

void GuideTree::search(const GuideKey& key, Index begin, Index end, int axis, Best& best) const {
    if (begin >= end) return;
    const Index middle = begin + (end - begin) / 2, guide = order_[at(middle)];
    const double distance = (keys_[at(guide)] - key).squaredNorm();
    if (std::pair(distance, guide) < std::pair(best.distance, best.guide)) best = {distance, guide};
    const double side = key[axis] - keys_[at(guide)][axis];
    const int next = (axis + 1) % kAxes;
    if (side < 0.0) {
        search(key, begin, middle, next, best);
        if (side * side <= best.distance) search(key, middle + 1, end, next, best);
    } else {
        search(key, middle + 1, end, next, best);
        if (side * side <= best.distance) search(key, begin, middle, next, best);
    }
}

Index GuideTree::nearest(const GuideKey& key) const {
    Best best{std::numeric_limits<double>::infinity(), kNoIndex};
    search(key, 0, count_of(order_), 0, best);
    return best.guide;
}

std::vector<Index> nearest_guides(const Strands& strands, const GuideOptions& options,
                                  const Context& context) {
    require_guides(options);
    const std::map<Index, Family> families = families_of(strands, options);
    std::vector<Index> guides(at(strands.size()), kNoIndex);
    context.parallel_for(0, strands.size(), kGuideGrain, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            const StrandView strand = strands.strand(s);
            const auto found = families.find(family_of(strands, s, options));
            if (!strand.allFinite() || found == families.end()) continue;
            const Family& family = found->second;
            const Index nearest = family.tree.nearest(guide_key(strand, options.apart));
            const Index guide = family.strands[at(nearest)];
            const auto distance = double((strands.root(guide) - strands.root(s)).norm());
            if (distance <= options.radius) guides[at(s)] = guide;
        }
    });
    return guides;
}

std::vector<Index> present_guides(const Strands& strands) {
    std::vector<Index> guides(at(strands.size()), kNoIndex);
    const std::vector<std::uint32_t>& ids = strands.guides().ids;
    if (ids.empty()) return guides;
    std::unordered_map<std::uint32_t, Index> numbers;
    for (Index s = 0; s < strands.size(); ++s) {
        if (ids[at(s)] == strands.id(s)) numbers.emplace(strands.id(s), s);
    }
    for (Index s = 0; s < strands.size(); ++s) {
        const auto found = numbers.find(ids[at(s)]);
        if (found != numbers.end()) guides[at(s)] = found->second;
    }
    return guides;
}

void assign_guides(Strands& strands, const GuideOptions& options, const Context& context) {
    const std::vector<Index> numbers = nearest_guides(strands, options, context);
    StrandGuides guides;
    for (Index s = 0; s < strands.size(); ++s) {
        const Index guide = numbers[at(s)];
        guides.ids.push_back(guide == kNoIndex ? kNoGuide : strands.id(guide));
        const double arc = guide == kNoIndex
                               ? 0.0
                               : std::min(length(strands.strand(s)), length(strands.strand(guide)));
        guides.arcs.push_back(std::isfinite(arc) ? static_cast<float>(arc) : 0.0f);
    }
    strands.set_guides(std::move(guides));
}

GuideCurve::GuideCurve(const StrandView& strand) {
    arc_fractions(strand, t_);
    for (Index k = 0; k < strand.cols(); ++k) points_.push_back(strand.col(k).cast<double>());
    const std::vector<Vec3> tangents = tangents_of(points_);
    Vec3 normal = tangents.front().unitOrthogonal();
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (k > 0) {
            normal =
                carried_normal(normal, points_[k] - points_[k - 1], tangents[k - 1], tangents[k]);
        }
        frames_.push_back(frame_of(normal, tangents[k]));
    }
}

GuideCurve::Point GuideCurve::at(double t) const {
    if (points_.size() == 1) return {points_.front(), frames_.front()};
    const StrandPlace place = place_at(t_, t);
    const std::size_t below = place.below;
    const Vec3& p = points_[below];
    const Vec3 position = p + place.u * (points_[below + 1] - p);
    const Mat3 &a = frames_[below], &b = frames_[below + 1];
    return {position, a + place.u * (b - a)};
}

}  // namespace lissom
