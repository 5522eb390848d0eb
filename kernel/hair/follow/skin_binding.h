/// Points of hair that stay over the places of the skin below them; private to kernel/hair.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/follow/path_loops.h"
#include "kernel/hair/follow/skin_contact.h"
#include "kernel/hair/follow/strand_paths.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Points that lie near the skin at rest, with the places of it below them, by the blocks of their
/// paths.
class SkinBinding {
  public:
    struct Options {
        /// Metres over the skin within which points are bound.
        double reach = 0.0;
        /// Metres that points stay off the skin, as FollowOptions.
        double clearance = 0.0;
    };

    SkinBinding() = default;
    /// `skin` is at rest, and so is `head`. Errors: memory_limit.
    SkinBinding(const Strands& strands, const StrandPaths& paths, const SkinSurface& skin,
                const HeadMotion& head, const Options& options, const Context& context);

    /// Returns the contacts of a block, by their rows.
    std::span<const PathContact> of(std::size_t block) const {
        if (first_.empty()) return {};
        return std::span(contacts_).subspan(first_[block], first_[block + 1] - first_[block]);
    }
    std::size_t memory_bytes() const {
        return first_.size() * sizeof(std::size_t) + contacts_.size() * sizeof(PathContact);
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<PathContact> contacts_;
    MemoryCharge charge_;
};

}  // namespace lissom
