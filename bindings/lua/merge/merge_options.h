/// The options of lissom.merge and lissom.merger: each is one row of a table, which describes it
/// and reads it into a field of MergeOptions.
#pragma once

#include <vector>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/parameter.h"
#include "kernel/merge/merge.h"

namespace lissom::lua {

/// Returns the descriptions; checks that take long are made by default if `slow`.
std::vector<Parameter> described_merge_options(bool slow);

/// Rejects a direction of one model without its partner of the other. Raises a Lua error.
void check_directions(const Call& call);

/// Returns the options of a call. Errors: those of a region of another version of its mesh.
MergeOptions merge_options(const Call& call);

/// Throws invalid_argument for options that do not apply to boundaries of one mesh.
void require_bridge_options(const Call& call);

}  // namespace lissom::lua
