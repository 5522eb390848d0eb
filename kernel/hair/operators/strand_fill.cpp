#include "kernel/hair/operators/strand_fill.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kCopyStream = 41;
constexpr Index kFillGrain = 64;
constexpr std::size_t kCopyStep = 4096;
// Metres: nearer guides weigh no more.
constexpr double kNearRoot = 5e-4;

bool is_hair(const Strands& strands, Index s) {
    const StrandView strand = strands.strand(s);
    return strands.point_count(s) > 1 && strand.allFinite() && length(strand) > 0.0;
}

// The courses of guides from their roots, at equal steps.
class GuideCourses {
  public:
    GuideCourses(const Strands& strands, std::vector<Index> guides, Index points,
                 const Context& context)
        : guides_(std::move(guides)), points_(points) {
        const Strands even = resample(select(strands, guides_), {.count = points}, context);
        for (Index g = 0; g < even.size(); ++g) {
            const StrandView strand = even.strand(g);
            roots_.push_back(point_of(strand, 0));
            for (Index k = 0; k < points; ++k) {
                offsets_.push_back(point_of(strand, k) - roots_.back());
            }
        }
    }

    Index size() const { return count_of(guides_); }
    Index strand_of(Index guide) const { return guides_[at(guide)]; }

    struct Share {
        Index guide;
        double weight;
    };

    // The nearest guides of a root, by their distance, without those of another side.
    void find(const Vec3& root, Index near, double min_cosine, std::vector<Share>& shares) const {
        shares.clear();
        for (Index g = 0; g < size(); ++g) {
            const double d = (roots_[at(g)] - root).squaredNorm();
            if (count_of(shares) == near && d >= shares.back().weight) continue;
            const auto place =
                std::upper_bound(shares.begin(), shares.end(), d,
                                 [](double x, const Share& s) { return x < s.weight; });
            shares.insert(place, {g, d});
            if (count_of(shares) > near) shares.pop_back();
        }
        const Vec3 side = middle(shares.front().guide);
        double sum = 0.0;
        for (Share& share : shares) {
            const bool same = middle(share.guide).dot(side) >= min_cosine;
            share.weight = same ? 1.0 / (share.weight + kNearRoot * kNearRoot) : 0.0;
            sum += share.weight;
        }
        for (Share& share : shares) share.weight /= sum;
    }

    // Offset from the root at a part of the length, 0 to 1.
    Vec3 offset(const std::vector<Share>& shares, double t) const {
        const double place = t * (points_ - 1);
        const auto below = std::min(static_cast<Index>(place), points_ - 2);
        const double part = place - below;
        Vec3 sum = Vec3::Zero();
        for (const Share& share : shares) {
            const Vec3* const p = &offsets_[at(share.guide) * at(points_) + at(below)];
            sum += share.weight * (p[0] + part * (p[1] - p[0]));
        }
        return sum;
    }

  private:
    Vec3 middle(Index guide) const {
        return offsets_[at(guide) * at(points_) + at(points_ / 2)].normalized();
    }

    std::vector<Index> guides_;
    Index points_;
    std::vector<Vec3> roots_, offsets_;
};

std::vector<Index> all_hair(const Strands& strands) {
    std::vector<Index> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (is_hair(strands, s)) list.push_back(s);
    }
    return list;
}

StrandRoots roots_of(std::span<const Root> roots) {
    StrandRoots result;
    for (const Root& root : roots) {
        result.faces.push_back(root.face);
        result.barycentrics.push_back(root.barycentric.cast<float>());
        result.triangles.push_back(root.triangle);
    }
    return result;
}

}  // namespace

Strands interpolate(const Strands& guides, std::span<const Root> roots,
                    const InterpolateOptions& options, const Context& context) {
    require(options.near >= 1, "strands must be between at least one guide");
    require(options.points >= 2, "strands need at least two points");
    require(options.apart > 0.0, "the angle apart must be positive");
    std::vector<Index> usable = all_hair(guides);
    require(!usable.empty(), "there are no guides: no strand is finite and has a length");
    const GuideCourses courses(guides, std::move(usable), options.points, context);
    const Index count = count_of(roots), points = options.points;
    require(count <= std::numeric_limits<Index>::max() / points,
            "there are more points than can be numbered; ask for fewer strands or points");
    const std::size_t numbers = at(count) * at(points) * 3;
    MemoryCharge charge = context.charge(numbers * sizeof(float), "points of strands");
    std::vector<float> made(numbers);
    std::vector<Index> offsets(at(count) + 1), nearest(at(count), kNoIndex);
    for (Index s = 0; s <= count; ++s) offsets[at(s)] = s * points;
    Progress progress(context, "interpolate strands");
    const double min_cosine = std::cos(std::min(options.apart, kPi));
    context.parallel_for(0, count, kFillGrain, [&](Index begin, Index end) {
        std::vector<GuideCourses::Share> shares;
        for (Index s = begin; s < end; ++s) {
            // A strand among very many guides takes long.
            context.checkpoint();
            const Vec3& root = roots[at(s)].position;
            courses.find(root, options.near, min_cosine, shares);
            nearest[at(s)] = courses.strand_of(shares.front().guide);
            for (Index k = 0; k < points; ++k) {
                const Vec3 p = root + courses.offset(shares, double(k) / (points - 1));
                for (Index i = 0; i < 3; ++i) {
                    made[3 * (at(s) * at(points) + at(k)) + at(i)] = static_cast<float>(p[i]);
                }
            }
        }
    });
    charge = {};
    Strands strands(std::move(made), std::move(offsets), guides.account());
    strands.set_roots(roots_of(roots));
    StrandWidths widths;
    widths.common = guides.widths().common;
    widths.profile = guides.widths().profile;
    strands.set_widths(std::move(widths));
    if (!guides.groups().empty()) {
        std::vector<Index> groups;
        for (const Index guide : nearest) groups.push_back(guides.group(guide));
        strands.set_groups(std::move(groups), guides.group_names());
    }
    return strands;
}

namespace {

// Two directions across a strand at its root.
std::pair<Vec3, Vec3> copy_axes(const StrandView& strand) {
    Vec3 along = Vec3::UnitY();
    for (Index k = 1; k < strand.cols(); ++k) {
        const Vec3 step = point_of(strand, k) - point_of(strand, 0);
        if (step.norm() > 0.0) {
            along = step.normalized();
            break;
        }
    }
    const Vec3 side = along.unitOrthogonal();
    return {side, along.cross(side)};
}

// Moves a copy off its strand.
void move_copy(StrandEdit strand, const DuplicateOptions& options, std::uint64_t chance) {
    const double turn = 0.5 * (1.0 + signed_random(chance));
    const double reach = options.radius * std::sqrt(0.5 * (1.0 + signed_random(mixed(chance))));
    const auto [side, up] = copy_axes(StrandView(strand.data(), 3, strand.cols()));
    const Vec3 apart = reach * (cosine_of_turns(turn) * side + sine_of_turns(turn) * up);
    std::vector<double> t;
    arc_fractions(StrandView(strand.data(), 3, strand.cols()), t);
    for (Index k = 0; k < strand.cols(); ++k) {
        const Vec3 moved = (1.0 + t[at(k)] * (options.tip - 1.0)) * apart;
        strand.col(k) += moved.cast<float>();
    }
}

}  // namespace

void duplicate(Strands& strands, const DuplicateOptions& options, const Context& context) {
    require(options.copies >= 0, "the number of copies must not be negative");
    require(options.radius >= 0.0 && std::isfinite(options.radius) && options.tip >= 0.0 &&
                std::isfinite(options.tip),
            "the radius and the factor at the tip of copies must be finite and not negative");
    const std::vector<Index> hair = all_hair(strands);
    const Index before = strands.size();
    require(hair.empty() ||
                options.copies <= (std::numeric_limits<Index>::max() - before) / count_of(hair),
            "there are more strands than can be numbered; ask for fewer copies");
    if (hair.empty()) return;
    // Of the list, and of ids and guides in the making.
    const std::size_t after = at(before) + at(options.copies) * hair.size();
    const MemoryCharge charge = context.charge(16 * after, "copies of strands");
    std::vector<Index> list(at(before));
    list.reserve(after);
    std::iota(list.begin(), list.end(), 0);
    for (Index copy = 0; copy < options.copies; ++copy) {
        list.insert(list.end(), hair.begin(), hair.end());
    }
    Progress progress(context, "duplicate strands");
    Strands made = select(strands, list);
    std::vector<std::uint32_t> ids;
    for (Index s = 0; s < before; ++s) ids.push_back(strands.id(s));
    std::uint32_t next = 0;
    for (const std::uint32_t id : ids) next = std::max(next, id + 1);
    StrandGuides guides = made.guides();
    for (std::size_t i = at(before); i < list.size(); ++i) {
        if (i % kCopyStep == 0) context.checkpoint();
        const std::uint32_t original = strands.id(list[i]);
        const auto copy = (i - at(before)) / hair.size();
        ids.push_back(next++);
        move_copy(made.edit_strand(index_of(i)), options,
                  mixed(options.seed, original, kCopyStream + copy));
        if (!guides.ids.empty() && guides.ids[i] == kNoGuide) guides.ids[i] = original;
    }
    if (guides.ids.empty()) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            guides.ids.push_back(strands.id(list[i]));
            guides.arcs.push_back(static_cast<float>(length(strands.strand(list[i]))));
        }
    }
    made.set_ids(std::move(ids));
    made.set_guides(std::move(guides));
    strands = std::move(made);
}

void blend(Strands& strands, const BlendOptions& options, const Context& context) {
    require(options.guides >= 1 && options.near >= 1, "there must be at least one guide");
    require_operator(strands, options);
    std::vector<Index> guides = all_hair(strands);
    if (guides.empty()) return;
    const auto lower = [&](Index a, Index b) {
        return std::pair(strands.id(a), a) < std::pair(strands.id(b), b);
    };
    const auto last = guides.begin() + std::min(options.guides, count_of(guides));
    std::partial_sort(guides.begin(), last, guides.end(), lower);
    guides.erase(last, guides.end());
    const InterpolateOptions usual;
    const GuideCourses courses(strands, std::move(guides), usual.points, context);
    Progress progress(context, "blend strands");
    const auto change = [&](StrandWork& work) {
        std::vector<GuideCourses::Share> shares;
        context.checkpoint();
        const Vec3 root = work.old_point(0);
        courses.find(root, options.near, std::cos(usual.apart), shares);
        for (Index k = 1; k < work.count(); ++k) {
            work.set_point(k, root + courses.offset(shares, work.t(k)));
        }
        work.blend();
    };
    change_strands(strands, options, change, context);
}

}  // namespace lissom
