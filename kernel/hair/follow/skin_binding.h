/// Points of hair that stay over the places of the skin below them; private to kernel/hair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/follow/skin_contact.h"
#include "kernel/hair/follow/strand_paths.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Points that lie near the skin at rest, with the places of it below them, in the order of the
/// places that strands have among their paths.
class SkinBinding {
  public:
    struct Options {
        /// Metres over the skin within which points are bound.
        double reach = 0.0;
        /// Metres that points stay off the skin, as FollowOptions.
        double clearance = 0.0;
    };

    SkinBinding() = default;
    /// `skin` is at rest. Errors: memory_limit.
    SkinBinding(const Strands& strands, const StrandPaths& paths, const SkinSurface& skin,
                const HeadMotion& head, const Options& options, const Context& context);

    /// Moves points of the strand at a place that come too near to the skin out of it, as `head` is
    /// now, and what hangs on them: `made` has x y z of its `count` points. Lengths of segments
    /// stay.
    void lift(std::size_t place, float* made, Index count, const HeadMotion& head) const;

    std::size_t memory_bytes() const {
        return first_.size() * sizeof(std::size_t) + bound_.size() * sizeof(BoundPoint);
    }

  private:
    /// A point with the triangle below it, and the least height that it may have.
    struct BoundPoint {
        Index point = 0;
        std::uint32_t vertices[3] = {};
        float weights[3] = {};
        float floor = 0.0f;
    };
    /// Height over the skin and the unit normal there.
    struct Contact {
        float height = 0.0f;
        Eigen::Array4f normal = Eigen::Array4f::Zero();
    };

    void bind(const StrandView& strand, std::span<const float> arcs, const SkinSurface& skin,
              const HeadMotion& head, const Options& options, std::vector<BoundPoint>& list) const;
    static Contact contact(const BoundPoint& bound, const Eigen::Array4f& point,
                           const HeadMotion& head);
    static bool raise(const BoundPoint& bound, const Eigen::Array4f& before, const HeadMotion& head,
                      Eigen::Array4f& point);

    std::vector<std::size_t> first_;
    std::vector<BoundPoint> bound_;
    MemoryCharge charge_;
};

}  // namespace lissom
