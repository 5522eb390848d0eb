/// lissom view: shows meshes and scripts in a window.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::cli {

int view(Program& program, const std::vector<std::string>& words);

}  // namespace lissom::cli
