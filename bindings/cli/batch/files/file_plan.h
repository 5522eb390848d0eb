/// The plan of a verb that makes a file of each of many files.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/batch/plan/plan.h"
#include "bindings/cli/file_patterns.h"

namespace lissom::cli {

/// Files that a verb reads, and names of those that it makes.
struct ManyFiles {
    /// Patterns, see `expand_pattern`.
    std::vector<std::string> in;
    std::string out_folder;
    /// Extension of the outputs, which takes the place of each input's or is added to its name;
    /// empty: as the input's.
    std::string extension;
    bool adds_extension = false;
    /// Kinds of files that folders and patterns name, and their words in an error.
    FileKinds kinds;
    std::string kinds_text;
    /// Let outputs replace files to read.
    bool force = false;
};

/// Makes the plan: a job for each file, with outputs below the output folder as inputs are below
/// the part of a pattern without wildcards. If the output folder lies inside the pattern's, files
/// below it are no inputs. A job is refused if its output is that of an earlier job, or one of the
/// inputs and `force` is not set; so is one job for each pattern that names no file, and for each
/// folder that cannot be listed. `verb` is the verb with its options, `out_option` the option that
/// takes the output; empty if it stands behind the input.
BatchPlan plan_files(const ManyFiles& files, std::vector<std::string> verb,
                     const std::string& out_option);

/// Returns whether names that differ in the case of letters are one file in a folder, which need
/// not exist.
bool ignores_case(const std::filesystem::path& folder);

/// Returns a text with the letters A to Z in lower case.
std::string lower_case(std::string text);

}  // namespace lissom::cli
