/// The verb `lissom render`.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::cli {

int render(Program& program, const std::vector<std::string>& words);

}  // namespace lissom::cli
