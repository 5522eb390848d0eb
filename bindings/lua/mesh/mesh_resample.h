/// Methods of lissom.Mesh that make other triangles for the same surface, and their records;
/// private to bindings/lua.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

std::vector<Function> resample_methods();
std::vector<Record> resample_records();

}  // namespace lissom::lua
