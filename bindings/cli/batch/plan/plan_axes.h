/// Values that the words of a batch give to the parameters of its script.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/batch/plan/axis.h"
#include "bindings/cli/batch/plan/output_name.h"
#include "bindings/cli/batch/plan/plan.h"
#include "bindings/lua/core/script_parameters.h"

namespace lissom::cli {

/// Throws the error of a plan: invalid_argument.
[[noreturn]] void refuse_plan(const std::string& message);

/// Returns the parameter of a name, in which "-" is "_"; or null.
const lua::ScriptParameter* find_parameter(const lua::ParameterSet& parameters,
                                           const std::string& name);
/// Splits "NAME=REST" if NAME is a parameter; otherwise null and the whole word.
std::pair<const lua::ScriptParameter*, std::string> named_parameter(
    const lua::ParameterSet& parameters, const std::string& word);

struct Axes {
    std::vector<Axis> list;
    /// Values that all jobs have.
    std::map<std::string, std::string> fixed;
};

/// Reads the axes of --over, --sweep and --set; "*" stands for all choices of a parameter that has
/// some. `out` is the parameter of the output, which none of
/// them gives. Errors: invalid_argument, file_not_found.
Axes read_axes(const lua::ParameterSet& parameters, const lua::ScriptParameter& out,
               const BatchWords& words);

/// Checks that each placeholder has a value, and that each column is a parameter or a placeholder.
/// `out` is the parameter of the output.
/// Errors: invalid_argument.
void require_known_names(const lua::ParameterSet& parameters, const lua::ScriptParameter& out,
                         const Axes& axes, const OutputName& output);

/// Returns the number of jobs, a million at most. Errors: invalid_argument.
std::size_t job_count(const Axes& axes);

using Values = std::map<std::string, std::string>;

/// Values of one job by name.
struct JobValues {
    /// Values of parameters, and values of files that fill outputs only.
    Values given, of_files;
};

/// Returns the values of a job, from 0: the last axis varies fastest.
JobValues values_of(const Axes& axes, std::size_t index);

/// Returns the place of a job, from 0, for messages: "job 3 (table.csv:4)".
std::string job_place(const Axes& axes, std::size_t index);

}  // namespace lissom::cli
