/// Tables of comma-separated values, as programs of spreadsheets write them.
#pragma once

#include <filesystem>

#include "bindings/cli/batch/plan/axis.h"

namespace lissom::cli {

/// Reads a table: names in its first line, a row in each other. The names are separated by commas,
/// or if there is none by semicolons or tabs, and so are all values. Spaces around a value do not
/// belong to it; a value in double quotes may hold separators, spaces, lines and doubled quotes.
/// Empty rows, and columns without a name and values, are left out. Errors: as `read_file`;
/// invalid_argument with the line for a row that has too few or too many values, and for a table
/// that is not in UTF-8.
Axis table_axis(const std::filesystem::path& file);

}  // namespace lissom::cli
