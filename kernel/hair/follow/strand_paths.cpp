#include "kernel/hair/follow/strand_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

// Metres between knots along a strand, and that strands of a group are apart at most.
constexpr float kKnotStep = 0.025f, kGroupRadius = 0.008f;
constexpr std::size_t kMostKnots = 64, kMostInGroup = 32;
constexpr Index kPathGrain = 256;
// Cells of the order of roots, along each axis.
constexpr double kOrderCells = 1024.0;
// Parts of segments' lengths that tips may have at least before all segments shrink alike.
constexpr float kLeastTip = 0.25f, kMostTip = 4.0f;

std::uint32_t with_gaps(std::uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

// Cells along the curve of Morton, on which neighbours are mostly near each other.
std::uint32_t cell_of(const Vec3& p, const Box& box, double size) {
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = (p[axis] - box.min[axis]) / size * kOrderCells;
        const double inside = std::clamp(cell, 0.0, kOrderCells - 1.0);
        code |= with_gaps(static_cast<std::uint32_t>(inside)) << axis;
    }
    return code;
}

// Makes room; what is there already keeps its place.
template <typename List>
void make_room(List& list, std::size_t count) {
    if (list.size() < count) list.resize(count);
}

}  // namespace

StrandPaths::StrandPaths(const Strands& strands, std::span<const Triangle> roots, double ramp,
                         const HeadMotion& head, const Context& context)
    : ramp_(static_cast<float>(ramp)) {
    sort(strands);
    copy(strands, context);
    root(strands, roots, head);
    divide();
    charge_ = context.charge(memory_bytes(), "hair that follows");
}

void StrandPaths::sort(const Strands& strands) {
    const Box box = bounds(strands);
    const double size = box.empty() ? 1.0 : std::max(1e-9, (box.max - box.min).maxCoeff());
    std::vector<std::pair<std::uint32_t, Index>> keys;
    for (Index s = 0; s < strands.size(); ++s) {
        keys.emplace_back(cell_of(strands.root(s).cast<double>(), box, size), s);
    }
    std::sort(keys.begin(), keys.end());
    first_.push_back(0);
    for (const auto& [cell, s] : keys) {
        order_.push_back(s);
        made_.push_back(3 * at(strands.first_point(s)));
        first_.push_back(first_.back() + at(strands.point_count(s)));
    }
}

// The points in the order of places, and lengths along them.
void StrandPaths::copy(const Strands& strands, const Context& context) {
    points_.resize(strands.points().size());
    arcs_.resize(at(strands.point_count()));
    context.parallel_for(0, strands.size(), kPathGrain, [&](Index begin, Index end) {
        for (std::size_t i = at(begin); i < at(end); ++i) {
            const StrandView strand = strands.strand(order_[i]);
            std::copy_n(strand.data(), strand.size(), points_.data() + 3 * first_[i]);
            float* const arcs = arcs_.data() + first_[i];
            const Index last = index_of(strand.cols()) - 1;
            arcs[0] = 0.0f;
            for (Index k = 1; k <= last; ++k) {
                arcs[k] = arcs[k - 1] + (strand.col(k) - strand.col(k - 1)).norm();
            }
            if (!std::isfinite(arcs[last]) || !strand.allFinite()) arcs[last] = 0.0f;
        }
    });
}

void StrandPaths::root(const Strands& strands, std::span<const Triangle> roots,
                       const HeadMotion& head) {
    for (const Index s : order_) {
        RootPlace root;
        root.vertices = roots[at(s)];
        if (root.vertices[0] != kNoIndex) {
            root.weights = strands.roots().barycentrics[at(s)];
            Vec3 offset = strands.root(s).cast<double>();
            for (int c = 0; c < 3; ++c) {
                offset -= double{root.weights[c]} * head.rest()[at(root.vertices[at(c)])];
            }
            root.offset = offset.cast<float>();
        }
        roots_.push_back(root);
    }
}

void StrandPaths::divide() {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        if (!groups_.empty() && joins(i, groups_.back())) {
            ++groups_.back().count;
        } else {
            add_group(i);
        }
    }
}

void StrandPaths::add_group(std::size_t first) {
    Group group{.first = first, .count = 1, .first_knot = knots_.size()};
    const float length = arcs(first).back();
    group.knots =
        std::clamp(static_cast<std::size_t>(length / kKnotStep) + 2, std::size_t{2}, kMostKnots);
    const float step = length / static_cast<float>(group.knots - 1);
    group.per_metre = step > 0.0f ? 1.0f / step : 0.0f;
    for (std::size_t j = 0; j < group.knots; ++j) {
        knots_.push_back(at_arc(first, static_cast<float>(j) * step));
    }
    groups_.push_back(group);
}

// Whether a strand lies beside the first of a group all along.
bool StrandPaths::joins(std::size_t place, const Group& group) const {
    const std::size_t leader = group.first;
    const auto is_rooted = [&](std::size_t i) { return roots_[i].vertices[0] != kNoIndex; };
    if (group.count >= kMostInGroup || is_rooted(place) != is_rooted(leader) || !is_whole(place) ||
        !is_whole(leader)) {
        return false;
    }
    if (std::abs(arcs(place).back() - arcs(leader).back()) > kKnotStep) return false;
    for (std::size_t j = 0; j < group.knots; ++j) {
        const Eigen::Vector3f& knot = knots_[group.first_knot + j];
        const Eigen::Vector3f own = at_arc(place, static_cast<float>(j) / group.per_metre);
        if (!((own - knot).norm() < kGroupRadius)) return false;
    }
    return true;
}

// The point at a length from the root; the tip beyond it.
Eigen::Vector3f StrandPaths::at_arc(std::size_t place, float arc) const {
    const StrandView points = rest(place);
    const auto lengths = arcs(place);
    const auto above = std::upper_bound(lengths.begin(), lengths.end(), arc);
    if (above == lengths.begin()) return points.col(0);
    if (above == lengths.end()) return points.col(points.cols() - 1);
    const auto k = index_of(above - lengths.begin());
    const float u = (arc - above[-1]) / (above[0] - above[-1]);
    return points.col(k - 1) + u * (points.col(k) - points.col(k - 1));
}

Eigen::Matrix3f StrandPaths::turn_of(std::size_t place, const HeadMotion& head) const {
    const RootPlace& root = roots_[place];
    if (root.vertices[0] == kNoIndex) return Eigen::Matrix3f::Identity();
    const auto rotation = [&](std::size_t c) { return head.rotations()[at(root.vertices[c])]; };
    const Eigen::Quaterniond turn =
        mean_rotation(rotation(0), rotation(1), rotation(2), root.weights.cast<double>());
    return (head.scale() * turn.toRotationMatrix()).cast<float>();
}

// `around`: the place to which the motion around the strand takes its root.
Eigen::Vector3f StrandPaths::moved_root(std::size_t place, const Eigen::Matrix3f& turn,
                                        const HeadMotion& head,
                                        const Eigen::Array4f& around) const {
    const RootPlace& root = roots_[place];
    if (root.vertices[0] == kNoIndex) return around.head<3>().matrix();
    Vec3 moved = (turn * root.offset).cast<double>();
    for (int c = 0; c < 3; ++c) {
        moved += double{root.weights[c]} * head.places()[at(root.vertices[at(c)])];
    }
    return moved.cast<float>();
}

void StrandPaths::move(Index g, const HeadMotion& head, const MotionField& field,
                       std::span<float> points, Room& room) const {
    const Group& group = groups_[at(g)];
    const bool whole = is_whole(group.first), placed = rest(group.first).col(0).allFinite();
    make_room(room.knots, group.knots);
    for (std::size_t j = 0; j < group.knots && placed; ++j) {
        room.knots[j] = field.motion_at(knots_[group.first_knot + j].data());
    }
    const Eigen::Matrix3f turn = turn_of(group.first, head);
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        const StrandView old = rest(i);
        const Eigen::Array4f first(old(0, 0), old(1, 0), old(2, 0), 0.0f);
        const Eigen::Vector3f root = moved_root(i, turn, head, field.moved(first, room.knots[0]));
        float* const made = points.data() + made_[i];
        if (whole) {
            move_strand(i, group, turn, root, field, static_cast<float>(head.scale()), made, room);
        } else {
            Eigen::Map<Eigen::Matrix3Xf> shifted(made, 3, old.cols());
            shifted = old;
            if (placed) shifted.colwise() += root - old.col(0);
        }
    }
}

// Segments change in parts that grow with the square of the place along the strand, so that it has
// its length and hair near the head stays where the head takes it.
void StrandPaths::move_strand(std::size_t place, const Group& group, const Eigen::Matrix3f& turn,
                              const Eigen::Vector3f& root, const MotionField& field, float scale,
                              float* made, Room& room) const {
    const StrandView rest = this->rest(place);
    const auto lengths = arcs(place);
    const std::size_t count = lengths.size();
    const float total = lengths.back(), per_total = 1.0f / total, per_ramp = 1.0f / ramp_;
    const bool has_root = roots_[place].vertices[0] != kNoIndex;
    make_room(room.steps, count);
    make_room(room.sizes, count);
    const Eigen::Array4f first(rest(0, 0), rest(1, 0), rest(2, 0), 0.0f);
    const Eigen::Array4f start(root[0], root[1], root[2], 0.0f);
    Eigen::Array4f before = start;
    float have = 0.0f, weighted = 0.0f;
    for (std::size_t k = 1; k < count; ++k) {
        const float* const p = rest.data() + 3 * k;
        const float knot = lengths[k] * group.per_metre;
        const auto j = std::min(static_cast<std::size_t>(knot), group.knots - 2);
        const float u = std::min(knot - static_cast<float>(j), 1.0f);
        const MotionField::Node& low = room.knots[j];
        const MotionField::Node motion = low + u * (room.knots[j + 1] - low);
        const Eigen::Array4f point(p[0], p[1], p[2], 0.0f);
        Eigen::Array4f target = field.moved(point, motion);
        if (has_root && lengths[k] < ramp_) {
            const float v = lengths[k] * per_ramp, w = 1.0f - v * v * (3.0f - 2.0f * v);
            const Eigen::Array4f along = point - first;
            Eigen::Array4f with_root = start;
            for (int c = 0; c < 3; ++c) {
                with_root.head<3>() += along[c] * turn.col(c).array();
            }
            target += w * (with_root - target);
        }
        const Eigen::Array4f step = target - before;
        before = target;
        const float size = std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
        const float t = lengths[k] * per_total;
        room.steps[k] = step;
        have += size;
        weighted += size * t * t;
    }
    const float want = scale * total;
    const float change = weighted > 0.0f ? (want - have) / weighted : 0.0f;
    const bool is_even = !(1.0f + change > kLeastTip && 1.0f + change < kMostTip);
    const float base = is_even && have > 0.0f ? want / have : 1.0f;
    const float slope = is_even ? 0.0f : change * per_total * per_total;
    Eigen::Array4f point = start;
    for (int c = 0; c < 3; ++c) made[c] = point[c];
    for (std::size_t k = 1; k < count; ++k) {
        point += (base + slope * lengths[k] * lengths[k]) * room.steps[k];
        float* const out = made + 3 * k;
        out[0] = point[0], out[1] = point[1], out[2] = point[2];
    }
}

std::size_t StrandPaths::memory_bytes() const {
    return roots_.size() * (sizeof(RootPlace) + sizeof(Index) + 2 * sizeof(std::size_t)) +
           (points_.size() + arcs_.size()) * sizeof(float) + groups_.size() * sizeof(Group) +
           knots_.size() * sizeof(Eigen::Vector3f);
}

}  // namespace lissom
