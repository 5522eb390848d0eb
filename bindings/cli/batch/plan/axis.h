/// Axes of a batch: the values that its jobs give to parameters of a script.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lissom::cli {

/// Rows of values for some names. Jobs take each row of an axis with each row of every other.
struct Axis {
    /// Parameters of the script, or names that only outputs use.
    std::vector<std::string> names;
    /// As many values as names in each row.
    std::vector<std::vector<std::string>> rows;
    /// Number of the names in front that are given; those behind come from the names of files, for
    /// outputs (see `kFileNames`).
    std::size_t given = 0;
    /// Its first names are those of files that a pattern has found.
    bool is_pattern = false;
    /// Table that it was read from, as messages name it, and the line of each row; or nothing.
    std::string table;
    std::vector<int> lines;
};

/// Names that an axis of files gives to outputs: the file's name without extension (also as
/// "stem"), its extension, and its folder below that of the pattern.
inline constexpr std::string_view kFileNames[] = {"name", "stem", "ext", "dir"};

/// Reads the values of one parameter: a list "a,b,c" ("\," for a comma within a value), numbers
/// from one to another by a step "0:90:15", or a count of numbers "0:90/7", both ends included.
/// Errors: invalid_argument.
std::vector<std::string> sweep_values(const std::string& text);

/// Makes the axis of "NAME=VALUES", see `sweep_values`. Errors: invalid_argument.
Axis sweep_axis(const std::string& text);

/// Makes the axis of the files that a pattern names, see `expand_pattern`: values of the parameter
/// `name` and of `kFileNames`. Errors: file_not_found if nothing matches.
Axis files_axis(const std::string& name, const std::string& pattern);

/// Adds the values of `kFileNames` that the axis lacks, from its column of files `name`.
void add_file_names(Axis& axis, const std::string& name);

/// Returns a number in its shortest form, whole numbers up to 1e15 without an exponent.
std::string number_text(double number);

}  // namespace lissom::cli
