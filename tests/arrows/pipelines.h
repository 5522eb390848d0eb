/// The picture of the pipelines: rooms of deformation, merging and hair, and the modules below
/// them, drawn from the rules of include_rules.h and the table of rooms in the README.
#pragma once

#include <string>
#include <string_view>

namespace lissom::test {

/// An SVG file. `readme` is the text of README.md, whose table says what a room is for.
std::string pipelines_picture(std::string_view readme);

}  // namespace lissom::test
