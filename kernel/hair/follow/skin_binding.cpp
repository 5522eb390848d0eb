#include "kernel/hair/follow/skin_binding.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "kernel/hair/follow/strand_lift.h"

namespace lissom {
namespace {

constexpr Index kBindGrain = 64;
constexpr int kBoundSteps = 3;
// Metres below their floor at which points begin to be moved.
constexpr float kBoundSlack = 1e-5f;

using Point4 = Eigen::Array4f;

Point4 point4_at(const float* p) {
    return {p[0], p[1], p[2], 0.0f};
}

float dot4(const Point4& a, const Point4& b) {
    return (a * b).sum();
}

void put_point4(const Point4& point, float* p) {
    for (int i = 0; i < 3; ++i) p[i] = point[i];
}

// A point whose points before were moved: it comes back to where the head takes it as far as the
// length of its segment lets it.
Point4 drawn_back(const Point4& before, const Point4& target, float size) {
    const Point4 along = target - before;
    const float length = std::sqrt(dot4(along, along));
    return length > 0.0f ? Point4(before + size / length * along) : target;
}

// A step of the same length that rises by `rise` more along a unit normal, as far as it can.
Point4 risen_step(const Point4& step, const Point4& normal, float rise) {
    const float along = dot4(normal, step), up = along + rise, square = dot4(step, step);
    const float beside = square - up * up;
    const Point4 level = step - along * normal;
    const float size = std::sqrt(dot4(level, level));
    if (!(beside > 0.0f) || !(size > 0.0f)) return std::sqrt(square) * normal;
    return up * normal + std::sqrt(beside) / size * level;
}

bool has_normals(const HeadMotion& head, const Triangle& triangle) {
    return std::none_of(triangle.begin(), triangle.end(),
                        [&](Index v) { return head.rest_normals()[at(v)].isZero(0.0); });
}

}  // namespace

SkinBinding::SkinBinding(const Strands& strands, const StrandPaths& paths, const SkinSurface& skin,
                         const HeadMotion& head, const Options& options, const Context& context) {
    std::vector<std::vector<BoundPoint>> lists(at(strands.size()));
    context.parallel_for(0, strands.size(), kBindGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const auto arcs = paths.arcs(at(i));
            if (!(arcs.back() > 0.0f)) continue;
            bind(strands.strand(paths.strand(at(i))), arcs, skin, head, options, lists[at(i)]);
        }
    });
    first_.push_back(0);
    for (const auto& list : lists) first_.push_back(first_.back() + list.size());
    charge_ = context.charge(first_.back() * sizeof(BoundPoint), "hair near the skin");
    bound_.reserve(first_.back());
    for (const auto& list : lists) bound_.insert(bound_.end(), list.begin(), list.end());
}

void SkinBinding::bind(const StrandView& strand, std::span<const float> arcs,
                       const SkinSurface& skin, const HeadMotion& head, const Options& options,
                       std::vector<BoundPoint>& list) const {
    for (Index k = 1; k < strand.cols(); ++k) {
        const Vec3 point = point_of(strand, k);
        const auto foot = point.allFinite() ? skin.nearest(point, options.reach) : std::nullopt;
        if (!foot || !has_normals(head, foot->triangle)) continue;
        BoundPoint bound{.point = k};
        for (std::size_t c = 0; c < 3; ++c) {
            bound.vertices[c] = static_cast<std::uint32_t>(foot->triangle[c]);
            bound.weights[c] = static_cast<float>(foot->barycentric[index_of(c)]);
        }
        const float height = contact(bound, point4_at(strand.col(k).data()), head).height;
        const auto off = static_cast<float>(clearance_at(options.clearance, arcs[at(k)]));
        bound.floor = std::min(height, off);
        list.push_back(bound);
    }
}

// Its place and normal on the skin are those of the corners, by their weights.
SkinBinding::Contact SkinBinding::contact(const BoundPoint& bound, const Point4& point,
                                          const HeadMotion& head) {
    Point4 away = point, normal = Point4::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
        const HeadMotion::SkinVertex& vertex = head.skin()[bound.vertices[c]];
        away -= bound.weights[c] * vertex.place;
        normal += bound.weights[c] * vertex.normal;
    }
    const float size = std::sqrt(dot4(normal, normal));
    if (!(size > 0.0f)) return {};
    normal *= 1.0f / size;
    return {dot4(normal, away), normal};
}

// Moves a point to its floor over the skin, as far from the point before it as it was.
bool SkinBinding::raise(const BoundPoint& bound, const Point4& before, const HeadMotion& head,
                        Point4& point) {
    const float floor = static_cast<float>(head.scale()) * bound.floor;
    bool moved = false;
    for (int step = 0; step < kBoundSteps; ++step) {
        const Contact over = contact(bound, point, head);
        if (!(over.height < floor - kBoundSlack)) break;
        moved = true;
        point = before + risen_step(point - before, over.normal, floor - over.height);
    }
    return moved;
}

void SkinBinding::lift(std::size_t place, float* made, Index count, const HeadMotion& head) const {
    if (first_.empty()) return;
    const auto scale = static_cast<float>(head.scale());
    const BoundPoint* next = bound_.data() + first_[place];
    const BoundPoint* const last = bound_.data() + first_[place + 1];
    next = std::find_if(next, last, [&](const BoundPoint& bound) {
        const Contact over = contact(bound, point4_at(made + 3 * at(bound.point)), head);
        return over.height < scale * bound.floor - kBoundSlack;
    });
    if (next == last) return;
    float* p = made + 3 * at(next->point);
    Point4 old = point4_at(p - 3), before = old;
    bool pushed = false;
    for (Index k = next->point; k < count; ++k, p += 3) {
        const bool is_bound = next != last && next->point == k;
        if (!is_bound && !pushed && next == last) return;
        const Point4 target = point4_at(p), step = target - old;
        Point4 point = pushed ? drawn_back(before, target, std::sqrt(dot4(step, step))) : target;
        const bool moved = is_bound && raise(*next++, before, head, point);
        old = target;
        before = point;
        if (moved || pushed) put_point4(point, p);
        const Point4 away = point - target;
        pushed = moved || (pushed && dot4(away, away) > kBoundSlack * kBoundSlack);
    }
}

}  // namespace lissom
