/// The tools that a window offers.
#pragma once

#include <string>
#include <vector>

namespace lissom::window {

/// Returns the names of the tools that ship, in their order.
std::vector<std::string> shipped_tools();
/// Returns the files of a person's own tools, in the order of their names: lissom/tools in
/// $XDG_DATA_HOME, else in ~/.local/share.
std::vector<std::string> own_tools();

}  // namespace lissom::window
