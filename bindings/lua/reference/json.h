/// The reference as JSON, for programs that call functions by name.
#pragma once

#include <string>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// Returns {"functions": [...]}, one object a line: "name" as lissom_call takes it, "call",
/// "summary", "arguments", "options", "results" and "errors". Arguments and options have "name",
/// "type", "required", "help", and if they apply "default", "min", "max", "above_min", "unit",
/// "choices", "fields" and "alternatives".
std::string reference_json(const Registry& registry);

}  // namespace lissom::lua
