#include "kernel/hair/follow/head_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr Index kMotionGrain = 512;
// Edges that the factor of lengths is found from.
constexpr std::size_t kComparedEdges = 1024;
// Edges whose ratios agree to this part share one; a quarter of all must, or the median counts, as
// 1 unless it differs by more than a tenth.
constexpr double kSharedRatio = 0.005, kSharedPart = 0.25, kLeastScaled = 0.1;
// Ratios so near to 1 are rounding.
constexpr double kSameLength = 1e-6;
// A surface with less volume, for its area, has no inside.
constexpr double kLeastVolume = 0.02;
constexpr int kMostPasses = 60;

// The least rotation from one unit vector to another.
Eigen::Quaterniond least_rotation(const Vec3& from, const Vec3& to) {
    const double w = 1.0 + from.dot(to);
    if (w < 1e-12) {
        const Vec3 axis = from.unitOrthogonal();
        return {0.0, axis.x(), axis.y(), axis.z()};
    }
    const Vec3 axis = from.cross(to);
    return Eigen::Quaterniond(w, axis.x(), axis.y(), axis.z()).normalized();
}

// The turn about a unit axis by the angle with this cosine and sine, both of any common size.
Eigen::Quaterniond turn_about(const Vec3& axis, double cosine, double sine) {
    const double w = std::hypot(cosine, sine) + cosine;
    if (!(w > 1e-12 * std::abs(sine))) return {0.0, axis.x(), axis.y(), axis.z()};
    const Vec3 v = sine * axis;
    return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized();
}

Vec4 aligned(const Vec4& q, const Vec4& with) {
    return q.dot(with) < 0.0 ? Vec4(-q) : q;
}

// The middle of the shortest run of sorted numbers that holds a share of them.
std::pair<double, double> shortest_run(std::span<const double> sorted, double share) {
    const auto count = std::max<std::size_t>(
        1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())));
    std::size_t best = 0;
    const auto width = [&](std::size_t i) { return sorted[i + count - 1] - sorted[i]; };
    for (std::size_t i = 1; i + count <= sorted.size(); ++i) {
        if (width(i) < width(best)) best = i;
    }
    return {sorted[best + count / 2], width(best)};
}

}  // namespace

HeadMotion::HeadMotion(std::vector<Vec3> rest, std::shared_ptr<const Topology> topology,
                       std::vector<Index> active, double smoothing)
    : rest_(std::move(rest)),
      places_(rest_),
      rest_normals_(rest_.size(), Vec3::Zero()),
      topology_(std::move(topology)),
      active_(std::move(active)),
      is_active_(rest_.size(), 0),
      rotations_(rest_.size(), Vec4::Zero()),
      smoothed_(rotations_),
      skin_(rest_.size()) {
    double sum = 0.0;
    Index count = 0;
    for (const Index v : active_) {
        is_active_[at(v)] = 1;
        rest_normals_[at(v)] = normal_at(rest_, v);
        for (const Index n : topology_->neighbors(v)) {
            sum += (rest_[at(n)] - rest_[at(v)]).norm();
            ++count;
        }
    }
    normals_ = rest_normals_;
    // Half of each pass stays, so that so many spread by their root times half an edge.
    const double edge = count > 0 ? sum / count : 0.0, reach = edge > 0.0 ? smoothing / edge : 0.0;
    passes_ = static_cast<int>(std::clamp(2.0 * reach * reach, 1.0, double(kMostPasses)));
    const auto edges = at(topology_->edge_count());
    const std::size_t stride = std::max<std::size_t>(1, edges / kComparedEdges);
    for (std::size_t e = 0; e < edges; e += stride) {
        const auto [a, b] = topology_->edge(index_of(e));
        if ((rest_[at(a)] - rest_[at(b)]).norm() > 0.0) edges_.push_back(index_of(e));
    }
    rest_volume_ = volume_of(rest_);
}

Vec3 HeadMotion::normal_at(const std::vector<Vec3>& places, Index v) const {
    const auto ring = topology_->neighbors(v);
    if (ring.size() < 2) return Vec3::Zero();
    const Vec3& center = places[at(v)];
    Vec3 sum = Vec3::Zero();
    // At a boundary the fan ends with the last neighbour.
    const std::size_t faces = topology_->is_boundary(v) ? ring.size() - 1 : ring.size();
    for (std::size_t i = 0; i < faces; ++i) {
        const Vec3 a = places[at(ring[i])] - center;
        sum += a.cross(places[at(ring[(i + 1) % ring.size()])] - center);
    }
    const double size = sum.norm();
    return size > 0.0 ? Vec3(sum / size) : Vec3::Zero();
}

// The normals turn into each other by the least rotation, then the edges by the best turn about the
// new normal.
Vec4 HeadMotion::rotation_at(Index v) const {
    const Vec3 &before = rest_normals_[at(v)], &after = normals_[at(v)];
    if (before.isZero(0.0) || after.isZero(0.0)) return Vec4::Zero();
    const Eigen::Quaterniond tilt = least_rotation(before, after);
    const Mat3 turned = tilt.toRotationMatrix();
    double cosine = 0.0, sine = 0.0;
    for (const Index n : topology_->neighbors(v)) {
        const Vec3 old = rest_[at(n)] - rest_[at(v)], made = places_[at(n)] - places_[at(v)];
        const double size = old.norm();
        if (!(size > 0.0)) continue;
        const Vec3 a = turned * old / size;
        cosine += a.dot(made) - a.dot(after) * made.dot(after);
        sine += after.dot(a.cross(made));
    }
    if (!(std::hypot(cosine, sine) > 0.0)) return Vec4::Zero();
    return (turn_about(after, cosine, sine) * tilt).coeffs();
}

void HeadMotion::pack(Index v) {
    SkinVertex& vertex = skin_[at(v)];
    vertex.place.head<3>() = places_[at(v)].cast<float>().array();
    vertex.normal.head<3>() = (outward() * normals_[at(v)]).cast<float>().array();
}

void HeadMotion::smooth(const Context& context) {
    for (int pass = 0; pass < passes_; ++pass) {
        context.parallel_for(0, count_of(active_), kMotionGrain, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                const Index v = active_[at(i)];
                const Vec4& own = rotations_[at(v)];
                Vec4 sum = Vec4::Zero();
                double count = 0.0;
                for (const Index n : topology_->neighbors(v)) {
                    if (!is_active_[at(n)]) continue;
                    sum += aligned(rotations_[at(n)], own.isZero(0.0) ? sum : own);
                    count += 1.0;
                }
                sum += std::max(count, 1.0) * own;
                const double size = sum.norm();
                smoothed_[at(v)] = size > 1e-9 ? Vec4(sum / size) : own;
            }
        });
        rotations_.swap(smoothed_);
    }
}

double HeadMotion::volume_of(const std::vector<Vec3>& places) const {
    Vec3 center = Vec3::Zero();
    for (const Vec3& p : places) center += p / static_cast<double>(places.size());
    double sum = 0.0, area = 0.0;
    for (Index f = 0; f < topology_->face_count(); ++f) {
        const auto face = topology_->face(f);
        const Vec3 a = places[at(face[0])] - center;
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            const Vec3 b = places[at(face[i])] - center, c = places[at(face[i + 1])] - center;
            sum += a.dot(b.cross(c));
            area += 0.5 * (b - a).cross(c - a).norm();
        }
    }
    const double size = std::pow(area, 1.5);
    return size > 0.0 ? sum / 6.0 / size : 0.0;
}

double HeadMotion::found_scale() {
    ratios_.clear();
    for (const Index e : edges_) {
        const auto [a, b] = topology_->edge(e);
        const double size = (places_[at(a)] - places_[at(b)]).norm();
        if (size > 0.0) ratios_.push_back(std::log(size / (rest_[at(a)] - rest_[at(b)]).norm()));
    }
    require(!ratios_.empty(), "the head has no size: all its vertices lie on one place");
    std::sort(ratios_.begin(), ratios_.end());
    const auto [shared, width] = shortest_run(ratios_, kSharedPart);
    if (width < kSharedRatio) return std::abs(shared) < kSameLength ? 1.0 : std::exp(shared);
    const double median = ratios_[ratios_.size() / 2];
    return std::abs(median) < kLeastScaled ? 1.0 : std::exp(median);
}

void HeadMotion::move(std::span<const Vec3> positions, double unit, std::optional<double> scale,
                      const Context& context) {
    for (std::size_t v = 0; v < positions.size(); ++v) places_[v] = unit * positions[v];
    const double volume = std::abs(rest_volume_) < kLeastVolume ? 0.0 : volume_of(places_);
    require(rest_volume_ * volume >= 0.0,
            "the head is turned inside out: its faces look the other way than at rest; turn them "
            "round with mesh:flip(), or undo the mirroring");
    scale_ = scale ? *scale : found_scale();
    context.parallel_for(0, count_of(active_), kMotionGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Index v = active_[at(i)];
            normals_[at(v)] = normal_at(places_, v);
            rotations_[at(v)] = rotation_at(v);
            pack(v);
        }
    });
    smooth(context);
}

Eigen::Quaterniond mean_rotation(const Vec4& a, const Vec4& b, const Vec4& c, const Vec3& weights) {
    Vec4 sum = weights[0] * a;
    sum += weights[1] * aligned(b, sum);
    sum += weights[2] * aligned(c, sum);
    const double size = sum.norm();
    if (!(size > 1e-9)) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Vec4(sum / size));
}

}  // namespace lissom
