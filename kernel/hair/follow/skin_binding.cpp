#include "kernel/hair/follow/skin_binding.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "kernel/core/large_pages.h"
#include "kernel/hair/follow/strand_lift.h"

namespace lissom {
namespace {

constexpr Index kBindGrain = 4;

bool has_normals(const HeadMotion& head, const Triangle& triangle) {
    return std::none_of(triangle.begin(), triangle.end(),
                        [&](Index v) { return head.rest_normals()[at(v)].isZero(0.0); });
}

// Height over the place, whose normal is the mean of those of its corners.
double height_over(const SurfacePoint& foot, const Vec3& point, const HeadMotion& head) {
    Vec3 normal = Vec3::Zero();
    for (int c = 0; c < 3; ++c) {
        normal += foot.barycentric[c] * head.rest_normals()[at(foot.triangle[at(c)])];
    }
    const double size = normal.norm();
    return size > 0.0 ? head.outward() * normal.dot(point - foot.position) / size : 0.0;
}

// Binds the points of one block.
class BlockBinder {
  public:
    BlockBinder(const Strands& strands, const StrandPaths& paths, const SkinSurface& skin,
                const HeadMotion& head, const SkinBinding::Options& options)
        : strands_(strands), paths_(paths), skin_(skin), head_(head), options_(options) {}

    void bind(std::size_t block, std::vector<PathContact>& contacts) const {
        const auto [first, last] = paths_.block(block);
        const int rows = paths_.row_count(block);
        for (int k = 1; k < rows; ++k) {
            PathContact contact;
            contact.row = k;
            std::fill(std::begin(contact.floor), std::end(contact.floor),
                      -std::numeric_limits<float>::infinity());
            bool is_bound = false;
            for (std::size_t i = first; i < last; ++i) {
                is_bound = bind_point(i, k, static_cast<int>(i - first), contact) || is_bound;
            }
            if (is_bound) contacts.push_back(contact);
        }
    }

  private:
    bool bind_point(std::size_t place, Index k, int lane, PathContact& contact) const {
        const auto arcs = paths_.arcs(place);
        if (at(k) >= arcs.size()) return false;
        const Vec3 point = point_of(strands_.strand(paths_.strand(place)), k);
        const auto foot = skin_.nearest(point, options_.reach);
        if (!foot || !has_normals(head_, foot->triangle)) return false;
        for (std::size_t c = 0; c < 3; ++c) {
            contact.vertices[c][lane] = static_cast<std::uint32_t>(foot->triangle[c]);
            contact.weights[c][lane] = static_cast<float>(foot->barycentric[index_of(c)]);
        }
        contact.floor[lane] = static_cast<float>(std::min(
            height_over(*foot, point, head_), clearance_at(options_.clearance, arcs[at(k)])));
        return true;
    }

    const Strands& strands_;
    const StrandPaths& paths_;
    const SkinSurface& skin_;
    const HeadMotion& head_;
    const SkinBinding::Options& options_;
};

}  // namespace

SkinBinding::SkinBinding(const Strands& strands, const StrandPaths& paths, const SkinSurface& skin,
                         const HeadMotion& head, const Options& options, const Context& context) {
    const BlockBinder binder(strands, paths, skin, head, options);
    std::vector<std::vector<PathContact>> lists(paths.block_count());
    context.parallel_for(0, index_of(lists.size()), kBindGrain, [&](Index begin, Index end) {
        for (Index b = begin; b < end; ++b) binder.bind(at(b), lists[at(b)]);
    });
    first_.push_back(0);
    for (const auto& list : lists) first_.push_back(first_.back() + list.size());
    charge_ = context.charge(first_.back() * sizeof(PathContact), "hair near the skin");
    contacts_.reserve(first_.back());
    prefer_large_pages(contacts_);
    for (const auto& list : lists) contacts_.insert(contacts_.end(), list.begin(), list.end());
}

}  // namespace lissom
