/// The plan of a batch: all jobs, checked before the first one starts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/batch/plan/axis.h"
#include "bindings/cli/batch/plan/output_name.h"
#include "bindings/cli/program.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/core/error.h"

namespace lissom::cli {

/// The words of a command line that make a plan.
struct BatchWords {
    std::string script;
    /// Patterns of files, or tables; "NAME=" in front names the parameter.
    std::vector<std::string> over;
    /// "NAME=VALUES" and "NAME=VALUE".
    std::vector<std::string> sweep, set;
    /// Template of the outputs; "NAME=" in front names the parameter.
    std::string out;
};

/// One run of the script, or of a verb for one file.
struct BatchJob {
    /// Place in the plan, from 1.
    std::size_t number = 0;
    /// Parameters and values, by name; without that of the output.
    std::vector<std::pair<std::string, std::string>> arguments;
    /// Files among them.
    std::vector<std::filesystem::path> inputs;
    /// The file or folder that it makes.
    std::filesystem::path output;
    /// Reason not to start it: it fails by this error.
    std::optional<Error> refused;
};

struct BatchPlan {
    /// Script that the jobs run; empty if they run a verb.
    std::string script;
    /// The verb and its options, which are followed by the input of a job.
    std::vector<std::string> verb;
    /// Parameter or option that takes the output, and whether it takes a folder; empty for a verb
    /// that takes the output behind the input.
    std::string out_parameter;
    bool makes_folders = false;
    /// Folder of all outputs; the state of the batch and its summary are there too.
    std::filesystem::path folder;
    std::vector<BatchJob> jobs;

    /// Returns the file of the script, or "lissom VERB".
    std::string name() const { return verb.empty() ? script : "lissom " + verb[0]; }
};

/// Returns the parameters that a script declares by lissom.params, without running it further.
/// Errors: invalid_argument if it declares none or fails before.
lua::ParameterSet script_parameters(Program& program, const std::string& script);

/// Makes the plan of a script with these parameters. Errors: invalid_argument for unknown
/// parameters and placeholders, which names the nearest, for values that a parameter refuses,
/// parameters without value, and outputs of two jobs that are one file; file_not_found for a
/// pattern that matches nothing and for inputs that do not exist.
BatchPlan make_plan(const lua::ParameterSet& parameters, const BatchWords& words);

/// Refuses jobs with inputs or outputs whose names are no UTF-8: they could not be told to other
/// programs.
void refuse_strange_names(BatchPlan& plan);

/// Returns the words that run a job with `output` as its output: "--name=value" each for a script,
/// the words of a verb that answers by JSON.
std::vector<std::string> job_words(const BatchPlan& plan, const BatchJob& job,
                                   const std::filesystem::path& output);

}  // namespace lissom::cli
