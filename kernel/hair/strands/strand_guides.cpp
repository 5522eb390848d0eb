#include "kernel/hair/strands/strand_guides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr int kAxes = 6;

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

// One step of double reflection (Wang et al. 2008, Computation of rotation minimizing frames).
Vec3 carried(const Vec3& normal, const Vec3& step, const Vec3& tangent, const Vec3& next) {
    const double c1 = step.squaredNorm();
    if (c1 == 0.0) return normal;
    const Vec3 reflected = normal - (2.0 / c1) * step.dot(normal) * step;
    const Vec3 tangent_reflected = tangent - (2.0 / c1) * step.dot(tangent) * step;
    const Vec3 turn = next - tangent_reflected;
    const double c2 = turn.squaredNorm();
    return c2 == 0.0 ? reflected : Vec3(reflected - (2.0 / c2) * turn.dot(reflected) * turn);
}

Mat3 frame_of(const Vec3& normal, const Vec3& tangent) {
    Mat3 frame;
    const Vec3 across = (normal - normal.dot(tangent) * tangent).normalized();
    frame << across, tangent.cross(across), tangent;
    return frame;
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

GuideCurve::GuideCurve(const StrandView& strand) {
    arc_fractions(strand, t_);
    for (Index k = 0; k < strand.cols(); ++k) points_.push_back(strand.col(k).cast<double>());
    const std::vector<Vec3> tangents = tangents_of(points_);
    Vec3 normal = tangents.front().unitOrthogonal();
    for (std::size_t k = 0; k < points_.size(); ++k) {
        if (k > 0) {
            normal = carried(normal, points_[k] - points_[k - 1], tangents[k - 1], tangents[k]);
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
    const Vec3 tangent = a.col(2) + place.u * (b.col(2) - a.col(2));
    if (tangent.norm() < 1e-6) return {position, a};
    const Vec3 normal = a.col(0) + place.u * (b.col(0) - a.col(0));
    return {position, frame_of(normal, tangent.normalized())};
}

}  // namespace lissom
