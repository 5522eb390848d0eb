/// Texts that the descriptions of Deformer and Handle share.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/error.h"

namespace lissom::lua {

/// Error codes of any call of a deformer or handle.
inline const std::vector<ErrorCode> kDeformerErrors = {ErrorCode::handle_removed,
                                                       ErrorCode::topology_mismatch};

/// The start of every example: a bar whose top bends over.
inline const std::string kBar = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
)";

}  // namespace lissom::lua
