#include "kernel/hair/follow/strand_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kernel/core/large_pages.h"
#include "kernel/hair/follow/skin_binding.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

// Metres between knots along a strand, and that strands of a group are apart at most.
constexpr float kKnotStep = 0.025f, kGroupRadius = 0.008f;
constexpr std::size_t kMostKnots = 64, kMostInGroup = 32;
constexpr Index kPathGrain = 256;
constexpr std::size_t kLanes = kPathLanes;
// Cells of the order of roots, along each axis.
constexpr double kOrderCells = 1024.0;

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
    reserve_rows();
    for (Group& group : groups_) {
        group.first_row = rows_.size();
        group.first_block = blocks_.size();
        if (!group.is_whole) continue;
        for (std::size_t i = 0; i < group.count; i += kLanes) {
            add_block(group.first + i, std::min(kLanes, group.count - i), group);
        }
    }
}

void StrandPaths::reserve_rows() {
    std::size_t count = 0;
    for (const Group& group : groups_) {
        for (std::size_t i = 0; i < group.count && group.is_whole; i += kLanes) {
            std::size_t rows = 0;
            for (std::size_t k = i; k < std::min(i + kLanes, group.count); ++k) {
                rows = std::max(rows, arcs(group.first + k).size());
            }
            count += rows;
        }
    }
    rows_.reserve(count);
    prefer_large_pages(rows_);
}

// Adds rows of points, the lanes without a strand as the first.
void StrandPaths::add_block(std::size_t first, std::size_t count, const Group& group) {
    PathStrands block;
    block.place = first;
    block.count = static_cast<int>(count);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t place = first + (lane < count ? lane : 0);
        block.points[lane] = static_cast<int>(arcs(place).size());
        block.total[lane] = arcs(place).back();
        block.made[lane] = made_[place];
        block.rows = std::max(block.rows, block.points[lane]);
    }
    blocks_.push_back(block);
    for (int k = 0; k < block.rows; ++k) {
        PathRow row;
        PathRange range{std::uint16_t(group.knots - 1), 0, false};
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t place = first + (lane < count ? lane : 0);
            const StrandView strand = rest(place);
            const Index point = std::min<Index>(k, index_of(strand.cols()) - 1);
            row.x[lane] = strand(0, point);
            row.y[lane] = strand(1, point);
            row.z[lane] = strand(2, point);
            const float arc = row.arc[lane] = arcs(place)[at(point)];
            const auto last = static_cast<float>(group.knots - 1);
            const float knot = std::min(arc * group.per_metre, last);
            range.low = std::min(range.low, static_cast<std::uint16_t>(knot));
            range.high = std::max(range.high, static_cast<std::uint16_t>(std::ceil(knot)));
            range.in_ramp = range.in_ramp || arc < ramp_;
        }
        range.in_ramp = range.in_ramp && roots_[first].vertices[0] != kNoIndex;
        rows_.push_back(row);
        ranges_.push_back(range);
    }
}

void StrandPaths::add_group(std::size_t first) {
    Group group{.first = first, .count = 1, .first_knot = knots_.size()};
    group.is_whole = is_whole(first);
    group.has_root = rest(first).col(0).allFinite();
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

Eigen::Vector3f StrandPaths::moved_root(std::size_t place, const Eigen::Matrix3f& turn,
                                        const HeadMotion& head, const MotionField& field,
                                        const Room& room) const {
    const RootPlace& root = roots_[place];
    if (root.vertices[0] == kNoIndex) {
        const float* const p = points_.data() + 3 * first_[place];
        return field.moved({p[0], p[1], p[2], 0.0f}, room.knots[0]).head<3>().matrix();
    }
    Vec3 moved = (turn * root.offset).cast<double>();
    for (int c = 0; c < 3; ++c) {
        moved += double{root.weights[c]} * head.places()[at(root.vertices[at(c)])];
    }
    return moved.cast<float>();
}

void StrandPaths::move(Index g, const HeadMotion& head, const MotionField& field,
                       const SkinBinding& binding, std::span<float> points, Room& room) const {
    const Group& group = groups_[at(g)];
    make_room(room.knots, group.knots);
    for (std::size_t j = 0; j < group.knots && group.has_root; ++j) {
        room.knots[j] = field.motion_at(knots_[group.first_knot + j].data());
    }
    const Eigen::Matrix3f turn = turn_of(group.first, head);
    if (group.is_whole) return move_whole(group, turn, head, field, binding, points, room);
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        move_broken(i, turn, head, field, points, room);
    }
}

void StrandPaths::move_whole(const Group& group, const Eigen::Matrix3f& turn,
                             const HeadMotion& head, const MotionField& field,
                             const SkinBinding& binding, std::span<float> points,
                             Room& room) const {
    PathBlock block;
    block.knots = room.knots.front().data();
    block.per_metre = group.per_metre;
    block.last_knot = static_cast<float>(group.knots - 1);
    block.per_ramp = 1.0f / ramp_;
    block.scale = static_cast<float>(head.scale());
    std::copy_n(field.origin().data(), 3, block.origin);
    std::copy_n(turn.data(), 9, block.turn);
    block.made = points.data();
    block.skin = head.skin().front().place.data();
    block.strands = &blocks_[group.first_block];
    block.rows = &rows_[group.first_row];
    block.ranges = &ranges_[group.first_row];
    for (std::size_t i = 0; i < group.count; i += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t place = group.first + std::min(i + lane, group.count - 1);
            const Eigen::Vector3f root = moved_root(place, turn, head, field, room);
            for (int c = 0; c < 3; ++c) block.roots[c][lane] = root[c];
        }
        const auto contacts = binding.of(at(index_of(block.strands - blocks_.data())));
        block.contacts = contacts.data();
        block.contact_count = count_of(contacts);
        make_room(room.steps, at(block.strands->rows));
        move_block(block, room.steps.data());
        block.rows += block.strands->rows;
        block.ranges += block.strands->rows;
        ++block.strands;
    }
}

void StrandPaths::move_broken(std::size_t place, const Eigen::Matrix3f& turn,
                              const HeadMotion& head, const MotionField& field,
                              std::span<float> points, const Room& room) const {
    const StrandView old = rest(place);
    Eigen::Map<Eigen::Matrix3Xf> shifted(points.data() + made_[place], 3, old.cols());
    shifted = old;
    if (!old.col(0).allFinite()) return;
    shifted.colwise() += moved_root(place, turn, head, field, room) - old.col(0);
}

std::size_t StrandPaths::memory_bytes() const {
    return roots_.size() * (sizeof(RootPlace) + sizeof(Index) + 2 * sizeof(std::size_t)) +
           (points_.size() + arcs_.size()) * sizeof(float) + groups_.size() * sizeof(Group) +
           knots_.size() * sizeof(Eigen::Vector3f) +
           rows_.size() * (sizeof(PathRow) + sizeof(PathRange)) +
           blocks_.size() * sizeof(PathStrands);
}

}  // namespace lissom
