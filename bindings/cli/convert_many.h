/// The conversion of many mesh files.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/conversion.h"

namespace lissom::cli {

struct ManyFiles {
    /// Patterns, see `expand_pattern`.
    std::vector<std::string> in;
    std::string out_folder;
    /// Extension of the outputs; empty for each input's own.
    std::string to;
};

/// Converts all files that the patterns name, one after the other, and prints a table of their
/// outcomes. A failure does not stop it, Ctrl-C does. Outputs are below the output folder as inputs
/// are below the part of a pattern without wildcards. No output is written twice, and none replaces
/// an input unless the options allow it. If the output folder lies inside the pattern's, files
/// below it are no inputs. Returns the exit status.
int convert_many(Program& program, const ManyFiles& files, const ConversionOptions& options);

}  // namespace lissom::cli
