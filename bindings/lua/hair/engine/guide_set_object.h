/// The guide sets of a script, and methods of strands that make what engines take; private to the
/// binding.
#pragma once

#include <utility>
#include <vector>

#include "bindings/lua/core/registry.h"
#include "kernel/core/memory_hold.h"
#include "kernel/hair/guides/guide_set.h"

namespace lissom::lua {

struct GuideSetObject {
    static constexpr const char* kTypeName = "lissom.GuideSet";

    explicit GuideSetObject(GuideSet content) : set(std::move(content)) {}

    GuideSet set;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const {
        return set.strands.size() * sizeof(Index) + set.guided.size() * sizeof(GuidedStrand) +
               set.curves.size() * sizeof(Eigen::Vector3f) +
               set.details.size() * sizeof(std::int16_t);
    }
};

/// guide_set.cpp.
Function guide_set_method();
/// dynamics.cpp: dynamics, a method of guide sets.
Function dynamics_method();

/// Returns strands of points, `each` of them a strand.
Strands even_strands(const std::vector<Eigen::Vector3f>& points, Index each,
                     const Context& context);
/// Returns the strands of a set with its guides as `options` has them, with their ids and widths.
Strands rebuilt_strands(const GuideSet& set, const RebuildOptions& options, const Context& context);

}  // namespace lissom::lua
