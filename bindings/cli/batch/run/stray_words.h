/// Words of a command line that a batch does not take, as beginners give them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lissom::cli {

/// Returns the error of words that belong to no option, with the way to give what they seem to
/// mean: files of a pattern that the shell has replaced, files without --over, parameters of the
/// script as options. `options` are the names of all options, `gives_files` tells whether --over
/// is given.
std::string stray_words_error(const std::vector<std::string>& words,
                              const std::vector<std::string_view>& options, bool gives_files);

/// Returns the error of words that a verb for one file, or for many by --in, does not take.
std::string stray_files_error(const std::vector<std::string>& words,
                              const std::vector<std::string_view>& options);

}  // namespace lissom::cli
