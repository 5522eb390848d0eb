/// The picture of the pipelines: rooms of deformation, merging and hair, and the modules below
/// them, drawn from the rules of include_rules.h and the table of rooms in CONTRIBUTING.md.
#pragma once

#include <string>
#include <string_view>

namespace lissom::test {

/// An SVG file. `rooms` is the text of CONTRIBUTING.md, whose table describes each room.
std::string pipelines_picture(std::string_view rooms);

}  // namespace lissom::test
