#include "bindings/cli/batch/plan/plan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/plan/plan_axes.h"
#include "bindings/cli/json.h"
#include "bindings/cli/script.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using lua::ParameterSet;
using lua::ParameterType;
using lua::ScriptParameter;

bool is_numeric(const ScriptParameter& p) {
    return p.type == ParameterType::number || p.type == ParameterType::integer;
}

// Advice on a value that seems to be several values, or a number of another country.
std::string value_advice(const ScriptParameter& p, const std::string& text) {
    if (!is_numeric(p)) return {};
    const bool seems_several =
        text.find_first_of(":[]{}") != std::string::npos || text.find("..") != std::string::npos;
    if (seems_several) return "; --sweep takes a,b,c, FROM:TO:STEP and FROM:TO/COUNT";
    return text.find(',') != std::string::npos ? "; decimals stand behind a point" : "";
}

std::string text_of(const lua::ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
    return std::get<std::string>(value);
}

std::string default_text(const ScriptParameter& p) {
    return p.default_value ? text_of(*p.default_value) : std::string();
}

bool takes_paths(const ScriptParameter& p) {
    return p.type == ParameterType::file || p.type == ParameterType::folder ||
           p.type == ParameterType::string;
}

[[noreturn]] void refuse_script_without_output(const ParameterSet& parameters) {
    std::string names;
    for (const ScriptParameter& p : parameters.list) {
        if (takes_paths(p)) names += (names.empty() ? "" : ", ") + p.name;
    }
    refuse_plan("--out: the script has no parameter 'out' for the file that it writes: declare " +
                std::string("out = { type = \"file\", default = \"out.obj\" } and write to it") +
                (names.empty() ? "" : ", or name another (" + names + "): --out NAME=TEMPLATE"));
}

const ScriptParameter& out_parameter(const ParameterSet& parameters, const ScriptParameter* given) {
    const ScriptParameter* p = given ? given : find_parameter(parameters, "out");
    if (!p) p = find_parameter(parameters, "output");
    if (!p) refuse_script_without_output(parameters);
    if (!takes_paths(*p)) refuse_plan("--out: parameter '" + p->name + "' takes no path");
    return *p;
}

class JobMaker {
  public:
    JobMaker(const ParameterSet& parameters, const ScriptParameter& out, const Axes& axes,
             const OutputName& output)
        : parameters_(parameters), out_(out), axes_(axes), output_(output) {}

    BatchJob make(std::size_t index) {
        BatchJob job;
        job.number = index + 1;
        JobValues values = values_of(axes_, index);
        for (const ScriptParameter& p : parameters_.list) take(p, index, values.given, job);
        values.of_files.emplace("n", std::to_string(job.number));
        job.output = output_.fill([&](const std::string& name) {
            for (const Values* known : {&values.given, &values.of_files}) {
                if (const auto found = known->find(name); found != known->end()) {
                    return found->second;
                }
            }
            return default_text(*find_parameter(parameters_, name));
        });
        return job;
    }

  private:
    void take(const ScriptParameter& p, std::size_t index, Values& values, BatchJob& job) {
        if (&p == &out_) return;
        if (!values.contains(p.name)) {
            if (!p.default_value) {
                refuse_plan("parameter '" + p.name +
                            "' has no default: give it by --over, --sweep or " + "--set");
            }
            return;
        }
        std::string& value = values[p.name];
        value = canonical_text(p, value, index);
        if (p.type == ParameterType::file && !value.empty()) {
            require_input(p, value, index);
            job.inputs.emplace_back(value);
        }
        job.arguments.emplace_back(p.name, value);
    }

    void require_input(const ScriptParameter& p, const std::string& file, std::size_t index) {
        if (!seen_.insert(file).second) return;
        std::error_code error;
        if (fs::is_regular_file(file, error)) return;
        throw Error(ErrorCode::file_not_found, job_place(axes_, index) + ": parameter '" + p.name +
                                                   "': " + file + ": " + missing_file_text(file));
    }

    std::string canonical_text(const ScriptParameter& p, const std::string& text,
                               std::size_t index) const {
        try {
            return text_of(p.from_text(text));
        } catch (const lua::ParameterError& error) {
            refuse_plan(job_place(axes_, index) + ": " + error.message + value_advice(p, text));
        }
    }

    const ParameterSet& parameters_;
    const ScriptParameter& out_;
    const Axes& axes_;
    const OutputName& output_;
    std::set<std::string> seen_;
};

// A path that ends with "/" is that of a folder.
void complete_output(const ScriptParameter& out, BatchJob& job) {
    if (job.output.has_filename()) return;
    if (out.type != ParameterType::folder) {
        refuse_plan("--out: " + job.output.string() +
                    " is a folder: add the name of the file, as " + job.output.string() +
                    "{name}.obj");
    }
    job.output = job.output.parent_path();
}

void require_inside(const fs::path& folder, const BatchJob& job) {
    const fs::path inside = job.output.lexically_relative(folder);
    if (!inside.empty() && *inside.begin() != ".." && inside != ".") return;
    refuse_plan("job " + std::to_string(job.number) + " would write " + job.output.string() +
                ", outside of " + folder.string());
}

fs::path normal_path(const fs::path& path) {
    return fs::absolute(path).lexically_normal();
}

bool is_within_folder(const std::string& file, const fs::path& folder) {
    return *normal_path(file).lexically_relative(normal_path(folder)).begin() != "..";
}

// Outputs that a batch has made in the folder.
std::set<fs::path> outputs_in(const fs::path& folder) {
    std::set<fs::path> outputs;
    const Ledger ledger(folder / kBatchFolder / "results");
    for (const auto& [name, record] : ledger.records()) {
        for (const FileStamp& stamp : record.outputs) outputs.insert(normal_path(stamp.path));
    }
    return outputs;
}

// A pattern may match what the same command has made before.
void leave_outputs_out(Axis& axis, const fs::path& folder) {
    const auto is_near = [&](const auto& row) { return is_within_folder(row[0], folder); };
    if (!axis.is_pattern || std::none_of(axis.rows.begin(), axis.rows.end(), is_near)) return;
    const std::set<fs::path> outputs = outputs_in(folder);
    std::erase_if(axis.rows,
                  [&](const auto& row) { return outputs.contains(normal_path(row[0])); });
    if (axis.rows.empty()) refuse_plan("all files of the pattern are outputs of this batch");
}

std::string argument_text(const BatchJob& job) {
    std::string text;
    for (const auto& [name, value] : job.arguments) text += " " + name + "=" + value;
    return "job " + std::to_string(job.number) + " (" + text.erase(0, text.empty() ? 0 : 1) + ")";
}

// "name" or "dir", by which the input `file` of a job differs from inputs of another.
std::optional<std::string> file_placeholder(const BatchJob& a, const BatchJob& b,
                                            const fs::path& file) {
    if (std::find(b.inputs.begin(), b.inputs.end(), file) == b.inputs.end()) return {};
    const auto has_its_name = [&](const fs::path& other) { return other.stem() == file.stem(); };
    const bool is_of_both = std::any_of(a.inputs.begin(), a.inputs.end(), has_its_name);
    return is_of_both ? "dir" : "name";
}

// ", as {angle}": a value in which the jobs differ.
std::string placeholder_advice(const BatchJob& a, const BatchJob& b) {
    std::vector<std::string> names;
    for (const auto& [name, value] : b.arguments) {
        const bool is_common = std::find(a.arguments.begin(), a.arguments.end(),
                                         std::pair(name, value)) != a.arguments.end();
        if (!is_common) names.push_back(file_placeholder(a, b, value).value_or(name));
    }
    return names.empty() ? "" : ", as {" + names[0] + "}";
}

void require_own_outputs(const BatchPlan& plan) {
    std::unordered_map<std::string, const BatchJob*> jobs;
    std::set<std::string> inputs;
    for (const BatchJob& job : plan.jobs) {
        for (const fs::path& input : job.inputs)
            inputs.insert(fs::absolute(input).lexically_normal());
    }
    for (const BatchJob& job : plan.jobs) {
        const auto [other, is_new] = jobs.emplace(job.output.string(), &job);
        if (!is_new) {
            refuse_plan(argument_text(*other->second) + " and " + argument_text(job) +
                        " both write " + job.output.string() +
                        ": --out needs a placeholder that tells them apart" +
                        placeholder_advice(*other->second, job));
        }
        if (inputs.contains(fs::absolute(job.output).lexically_normal())) {
            refuse_plan(argument_text(job) + " would write over the input " + job.output.string());
        }
    }
}

}  // namespace

lua::ParameterSet script_parameters(Program& program, const std::string& path) {
    Script script(program, {path, {"--help"}});
    const ScriptResult result = script.run_file(path);
    if (result.status != kSuccess) refuse_plan(result.message);
    if (!script.state().parameters) {
        refuse_plan(path +
                    " declares no parameters: a batch gives values to those of lissom.params, as "
                    "local params = lissom.params{ mesh = { type = \"file\" }, out = { type = "
                    "\"file\" } }");
    }
    return *script.state().parameters;
}

BatchPlan make_plan(const lua::ParameterSet& parameters, const BatchWords& words) {
    const auto [given, text] = named_parameter(parameters, words.out);
    const ScriptParameter& out = out_parameter(parameters, given);
    const OutputName output(text);
    Axes axes = read_axes(parameters, out, words);
    for (Axis& axis : axes.list) leave_outputs_out(axis, output.base());
    require_known_names(parameters, out, axes, output);
    BatchPlan plan;
    plan.script = words.script;
    plan.out_parameter = out.name;
    plan.makes_folders = out.type == ParameterType::folder;
    plan.folder = output.base();
    const std::size_t count = job_count(axes);
    plan.jobs.reserve(count);
    JobMaker maker(parameters, out, axes, output);
    for (std::size_t i = 0; i < count; ++i) {
        plan.jobs.push_back(maker.make(i));
        complete_output(out, plan.jobs.back());
        require_inside(plan.folder, plan.jobs.back());
    }
    require_own_outputs(plan);
    refuse_strange_names(plan);
    return plan;
}

namespace {

std::vector<std::string> verb_words(const BatchPlan& plan, const BatchJob& job,
                                    const fs::path& output) {
    std::vector<std::string> words = plan.verb;
    words.emplace_back("--json");
    const bool is_option = !plan.out_parameter.empty();
    if (is_option) words.push_back("--" + plan.out_parameter + "=" + output.string());
    // A file's name may begin as an option does.
    words.emplace_back("--");
    for (const fs::path& input : job.inputs) words.push_back(input.string());
    if (!is_option) words.push_back(output.string());
    return words;
}

}  // namespace

void refuse_strange_names(BatchPlan& plan) {
    for (BatchJob& job : plan.jobs) {
        std::vector<fs::path> paths = job.inputs;
        paths.push_back(job.output);
        for (const fs::path& path : paths) {
            if (job.refused || is_utf8(path.string())) continue;
            job.refused = Error(ErrorCode::invalid_argument,
                                display_name(path) + ": the name is not in UTF-8; rename the file");
        }
    }
}

std::vector<std::string> job_words(const BatchPlan& plan, const BatchJob& job,
                                   const fs::path& output) {
    if (!plan.verb.empty()) return verb_words(plan, job, output);
    std::vector<std::string> words;
    for (const auto& [name, value] : job.arguments) words.push_back("--" + name + "=" + value);
    words.push_back("--" + plan.out_parameter + "=" + output.string());
    return words;
}

}  // namespace lissom::cli
