/// JSON as the program writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/report.h"

namespace lissom::cli {

/// Keeps the order in which keys were added.
using Json = nlohmann::ordered_json;

/// Returns {"message": ..., "code": ..., "elements": {"kind": ..., "count": ..., "ids": [...]}};
/// ids from 1, pairs of vertices for edges.
Json error_json(const Error& error);

/// Returns a list of {"kind": "faces_flipped", "count", "element": "face" or null, "of": "file" or
/// "mesh", "ids", "message"}: the findings of loading a mesh. At most a hundred ids, from 1, pairs
/// of vertices for edges.
Json report_json(const Report& report);

/// Returns {"min": [x, y, z], "max": ..., "center": ..., "diagonal": ...}; null for an empty box.
Json bounds_json(const Box& box);

/// Returns whether a text is UTF-8, as JSON must be.
bool is_utf8(const std::string& text);

/// Returns the text of a value; bytes that are no UTF-8 (in names of files) are replaced.
std::string json_text(const Json& value, int indent = 2);

}  // namespace lissom::cli
