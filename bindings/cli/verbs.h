/// The verbs of the kernel's program; each runs with the words that follow its name.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::cli {

int run_script(Program& program, const std::vector<std::string>& words);
int batch(Program& program, const std::vector<std::string>& words);
int run_tests(Program& program, const std::vector<std::string>& words);
int inspect(Program& program, const std::vector<std::string>& words);
int convert(Program& program, const std::vector<std::string>& words);
int repl(Program& program, const std::vector<std::string>& words);
int help(Program& program, const std::vector<std::string>& words);
int make_new(Program& program, const std::vector<std::string>& words);
int migrate_scripts(Program& program, const std::vector<std::string>& words);
int explain(Program& program, const std::vector<std::string>& words);

}  // namespace lissom::cli
