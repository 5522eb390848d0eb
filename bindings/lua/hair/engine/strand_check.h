/// strands:check, strands:follow, strands:shell, strands:levels; private to the binding.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/registry.h"
#include "kernel/hair/levels/hair_silhouette.h"

namespace lissom::lua {

/// strand_check.cpp.
Function strand_check_method();
/// strand_follow.cpp: follow, follower, transfer.
std::vector<Function> strand_follow_methods();
/// levels.cpp: shell, silhouette_error.
std::vector<Function> strand_level_methods();
/// hair_levels.cpp: levels.
Function hair_levels_method();
std::vector<Record> hair_level_records();

/// Pushes a table with the fields of lissom.SilhouetteError.
int push_silhouette(const Call& call, const SilhouetteError& error);

/// Start of examples: a lock of 200 strands.
inline const std::string kLock = R"(local points, counts = {}, {}
for i = 0, 199 do
    local x, z = 0.002 * (i % 20), 0.002 * math.floor(i / 20)
    for k = 0, 5 do points[#points + 1] = { x, 0.02 * k, z } end
    counts[#counts + 1] = 6
end
local hair = lissom.strands{ points = points, counts = counts }
)";

}  // namespace lissom::lua
