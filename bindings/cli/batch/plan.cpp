#include "bindings/cli/batch/plan.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "bindings/cli/script.h"
#include "kernel/core/error.h"
#include "kernel/core/nearest.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using lua::ParameterSet;
using lua::ParameterType;
using lua::ScriptParameter;

constexpr std::size_t kMostJobs = 1000000;

[[noreturn]] void refuse_plan(const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
}

std::string plain_name(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

const ScriptParameter* find(const ParameterSet& parameters, const std::string& name) {
    for (const ScriptParameter& p : parameters.list) {
        if (p.name == plain_name(name)) return &p;
    }
    return nullptr;
}

const ScriptParameter& require(const ParameterSet& parameters, const std::string& name,
                               const std::string& place) {
    if (const ScriptParameter* found = find(parameters, name)) return *found;
    refuse_plan(place + ": the script has no parameter '" + name + "'" +
                name_hint(name, parameters.names()));
}

// "NAME=REST" where NAME is a parameter, else all of it as the rest.
std::pair<const ScriptParameter*, std::string> named(const ParameterSet& parameters,
                                                     const std::string& word) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return {nullptr, word};
    const ScriptParameter* found = find(parameters, word.substr(0, equals));
    return found ? std::pair(found, word.substr(equals + 1)) : std::pair(found, word);
}

std::string canonical_text(const ScriptParameter& p, const std::string& text,
                           const std::string& place) {
    try {
        const lua::ParameterValue value = p.from_text(text);
        if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
        if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
        return std::get<std::string>(value);
    } catch (const lua::ParameterError& error) {
        refuse_plan(place + ": " + error.message);
    }
}

std::string default_text(const ScriptParameter& p) {
    if (!p.default_value) return {};
    if (const auto* flag = std::get_if<bool>(&*p.default_value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&*p.default_value)) return number_text(*number);
    return std::get<std::string>(*p.default_value);
}

// ---- Parameters of inputs and outputs

std::string listed_names(const std::vector<const ScriptParameter*>& parameters) {
    std::string text;
    for (const ScriptParameter* p : parameters) text += (text.empty() ? "" : ", ") + p->name;
    return text;
}

const ScriptParameter& out_parameter(const ParameterSet& parameters, const ScriptParameter* given) {
    const ScriptParameter* p = given ? given : find(parameters, "out");
    if (!p) p = find(parameters, "output");
    if (!p) {
        refuse_plan(
            "--out: the script has no parameter 'out'; name the one that takes the output: "
            "--out NAME=TEMPLATE");
    }
    const bool takes_paths = p->type == ParameterType::file || p->type == ParameterType::folder ||
                             p->type == ParameterType::string;
    if (!takes_paths) refuse_plan("--out: parameter '" + p->name + "' takes no path");
    return *p;
}

// The parameter that takes the files of a pattern if none is named.
const ScriptParameter& input_parameter(const ParameterSet& parameters, const ScriptParameter& out,
                                       const std::string& pattern) {
    std::vector<const ScriptParameter*> files, required;
    for (const ScriptParameter& p : parameters.list) {
        if (p.type != ParameterType::file || &p == &out) continue;
        files.push_back(&p);
        if (!p.default_value) required.push_back(&p);
    }
    if (files.size() == 1) return *files[0];
    if (required.size() == 1) return *required[0];
    if (files.empty())
        refuse_plan("--over " + pattern + ": the script has no parameter of type file");
    refuse_plan("--over " + pattern + ": the script has several parameters of type file (" +
                listed_names(files) + "); name one: --over " + files[0]->name + "=" + pattern);
}

bool is_table(const std::string& word) {
    std::string extension = fs::path(word).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".csv";
}

Axis over_axis(const ParameterSet& parameters, const ScriptParameter& out,
               const std::string& word) {
    const auto [given, pattern] = named(parameters, word);
    if (given) return files_axis(given->name, pattern);
    if (!is_table(pattern)) {
        return files_axis(input_parameter(parameters, out, pattern).name, pattern);
    }
    Axis axis = table_axis(pattern);
    for (std::string& name : axis.names) {
        if (const ScriptParameter* p = find(parameters, name)) name = p->name;
    }
    for (const std::string& name : axis.names) {
        const ScriptParameter* p = find(parameters, name);
        if (!p || p->type != ParameterType::file) continue;
        add_file_names(axis, p->name);
        break;
    }
    return axis;
}

// ---- Axes

struct Axes {
    std::vector<Axis> list;
    // Values that all jobs have.
    std::map<std::string, std::string> fixed;
};

// Two axes may both be of files, but not give one name two values.
void require_given_once(const Axes& axes, const ScriptParameter& out) {
    std::set<std::string> given;
    const auto give = [&](const std::string& name) {
        if (!given.insert(name).second) refuse_plan("'" + name + "' is given twice");
        if (name == out.name) refuse_plan("'" + name + "' is given by --out");
    };
    for (const auto& [name, value] : axes.fixed) give(name);
    for (const Axis& axis : axes.list) {
        for (std::size_t i = 0; i < axis.given; ++i) give(axis.names[i]);
    }
}

Axes read_axes(const ParameterSet& parameters, const ScriptParameter& out,
               const BatchWords& words) {
    Axes axes;
    for (const std::string& word : words.over) {
        axes.list.push_back(over_axis(parameters, out, word));
    }
    for (const std::string& word : words.sweep) {
        Axis axis = sweep_axis(word);
        axis.names[0] = require(parameters, axis.names[0], "--sweep " + word).name;
        axes.list.push_back(std::move(axis));
    }
    for (const std::string& word : words.set) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) refuse_plan("--set " + word + ": write NAME=VALUE");
        const ScriptParameter& p = require(parameters, word.substr(0, equals), "--set " + word);
        if (!axes.fixed.emplace(p.name, word.substr(equals + 1)).second) {
            refuse_plan("parameter '" + p.name + "' is given twice");
        }
    }
    require_given_once(axes, out);
    return axes;
}

// Every value that parameters and axes have is a value for a placeholder; every column that is no
// parameter must be one.
void require_known_names(const ParameterSet& parameters, const Axes& axes,
                         const OutputName& output) {
    const std::vector<std::string> used = output.placeholders();
    std::vector<std::string_view> known = parameters.names();
    for (const Axis& axis : axes.list)
        known.insert(known.end(), axis.names.begin(), axis.names.end());
    known.emplace_back("n");
    for (const std::string& name : used) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        refuse_plan("--out: there is no value for {" + name + "}" + name_hint(name, known));
    }
    for (const Axis& axis : axes.list) {
        for (std::size_t i = 0; i < axis.given; ++i) {
            const std::string& name = axis.names[i];
            if (find(parameters, name)) continue;
            if (std::find(used.begin(), used.end(), name) != used.end()) continue;
            refuse_plan("column '" + name + "' of the table is no parameter of the script" +
                        name_hint(name, parameters.names()));
        }
    }
}

std::size_t job_count(const Axes& axes) {
    std::size_t count = 1;
    for (const Axis& axis : axes.list) {
        count *= axis.rows.size();
        if (count > kMostJobs) refuse_plan("the batch has more than a million jobs");
    }
    return count;
}

using Values = std::map<std::string, std::string>;

// Values of one job by name; those behind the given ones fill outputs only.
struct JobValues {
    Values given, of_files;
};

// The last axis varies fastest, and the first of two patterns names outputs.
JobValues values_of(const Axes& axes, std::size_t index) {
    JobValues values{axes.fixed, {}};
    for (auto axis = axes.list.rbegin(); axis != axes.list.rend(); ++axis) {
        const std::vector<std::string>& row = axis->rows[index % axis->rows.size()];
        for (std::size_t i = 0; i < row.size(); ++i) {
            (i < axis->given ? values.given : values.of_files)[axis->names[i]] = row[i];
        }
        index /= axis->rows.size();
    }
    return values;
}

// ---- Jobs

class JobMaker {
  public:
    JobMaker(const ParameterSet& parameters, const ScriptParameter& out, const Axes& axes,
             const OutputName& output)
        : parameters_(parameters), out_(out), axes_(axes), output_(output) {}

    BatchJob make(std::size_t index) {
        BatchJob job;
        job.number = index + 1;
        JobValues values = values_of(axes_, index);
        for (const ScriptParameter& p : parameters_.list) take(p, values.given, job);
        values.of_files.emplace("n", std::to_string(job.number));
        job.output = output_.fill([&](const std::string& name) {
            for (const Values* known : {&values.given, &values.of_files}) {
                if (const auto found = known->find(name); found != known->end()) {
                    return found->second;
                }
            }
            return default_text(*find(parameters_, name));
        });
        return job;
    }

  private:
    void take(const ScriptParameter& p, Values& values, BatchJob& job) {
        if (&p == &out_) return;
        if (!values.contains(p.name)) {
            if (!p.default_value) {
                refuse_plan("parameter '" + p.name +
                            "' has no default: give it by --over, --sweep or " + "--set");
            }
            return;
        }
        const std::string place = "job " + std::to_string(job.number) + ", " + p.name;
        std::string& value = values[p.name];
        value = canonical_text(p, value, place);
        if (p.type == ParameterType::file && !value.empty()) {
            require_input(value, place);
            job.inputs.emplace_back(value);
        }
        job.arguments.emplace_back(p.name, value);
    }

    void require_input(const std::string& file, const std::string& place) {
        if (!seen_.insert(file).second) return;
        std::error_code error;
        if (fs::is_regular_file(file, error)) return;
        throw Error(ErrorCode::file_not_found,
                    place + ": " + file + ": " + missing_file_text(file));
    }

    const ParameterSet& parameters_;
    const ScriptParameter& out_;
    const Axes& axes_;
    const OutputName& output_;
    std::set<std::string> seen_;
};

void require_inside(const fs::path& folder, const BatchJob& job) {
    const fs::path inside = job.output.lexically_relative(folder);
    if (!inside.empty() && *inside.begin() != ".." && inside != ".") return;
    refuse_plan("job " + std::to_string(job.number) + " would write " + job.output.string() +
                ", outside of " + folder.string());
}

std::string argument_text(const BatchJob& job) {
    std::string text;
    for (const auto& [name, value] : job.arguments) text += " " + name + "=" + value;
    return "job " + std::to_string(job.number) + " (" + text.erase(0, text.empty() ? 0 : 1) + ")";
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
                        ": --out needs a placeholder that tells them apart");
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
                    " declares no parameters: a batch gives values to those of lissom.params");
    }
    return *script.state().parameters;
}

BatchPlan make_plan(const lua::ParameterSet& parameters, const BatchWords& words) {
    const auto [given, text] = named(parameters, words.out);
    const ScriptParameter& out = out_parameter(parameters, given);
    const OutputName output(text);
    const Axes axes = read_axes(parameters, out, words);
    require_known_names(parameters, axes, output);
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
        require_inside(plan.folder, plan.jobs.back());
    }
    require_own_outputs(plan);
    return plan;
}

std::vector<std::string> script_words(const BatchPlan& plan, const BatchJob& job,
                                      const fs::path& output) {
    std::vector<std::string> words;
    for (const auto& [name, value] : job.arguments) words.push_back("--" + name + "=" + value);
    words.push_back("--" + plan.out_parameter + "=" + output.string());
    return words;
}

}  // namespace lissom::cli
