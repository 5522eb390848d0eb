#include "bindings/cli/batch/plan/plan_axes.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>

#include "bindings/cli/batch/plan/table.h"
#include "kernel/core/error.h"
#include "kernel/core/nearest.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using lua::ParameterSet;
using lua::ParameterType;
using lua::ScriptParameter;

constexpr std::size_t kMaxJobs = 1000000;

std::string plain_name(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

const ScriptParameter& require(const ParameterSet& parameters, const std::string& name,
                               const std::string& place) {
    if (const ScriptParameter* found = find_parameter(parameters, name)) return *found;
    refuse_plan(place + ": the script has no parameter '" + name + "'" +
                name_hint(name, parameters.names()));
}

std::string listed_names(const std::vector<const ScriptParameter*>& parameters) {
    std::string text;
    for (const ScriptParameter* p : parameters) text += (text.empty() ? "" : ", ") + p->name;
    return text;
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
    if (files.empty()) {
        refuse_plan("--over " + pattern +
                    ": the script has no parameter of type file; name the one that takes the "
                    "files: --over NAME=" +
                    pattern);
    }
    refuse_plan("--over " + pattern + ": the script has several parameters of type file (" +
                listed_names(files) + "); name one: --over " + files[0]->name + "=" + pattern);
}

bool is_table(const std::string& word) {
    std::string extension = fs::path(word).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".csv" || extension == ".tsv";
}

Axis over_axis(const ParameterSet& parameters, const ScriptParameter& out,
               const std::string& word) {
    const auto [given, pattern] = named_parameter(parameters, word);
    if (given) return files_axis(given->name, pattern);
    if (!is_table(pattern)) {
        return files_axis(input_parameter(parameters, out, pattern).name, pattern);
    }
    Axis axis = table_axis(pattern);
    for (std::string& name : axis.names) {
        if (const ScriptParameter* p = find_parameter(parameters, name)) name = p->name;
    }
    for (const std::string& name : axis.names) {
        const ScriptParameter* p = find_parameter(parameters, name);
        if (!p || p->type != ParameterType::file) continue;
        add_file_names(axis, p->name);
        break;
    }
    return axis;
}

constexpr std::string_view kAllValues = "*";

// A parameter with choices takes each of them for "*".
void list_choices(const ScriptParameter& parameter, Axis& axis) {
    const std::vector<std::string>& choices = parameter.choices;
    if (axis.rows.size() != 1 || axis.rows[0][0] != kAllValues) return;
    if (parameter.type != ParameterType::choice ||
        std::find(choices.begin(), choices.end(), kAllValues) != choices.end()) {
        return;
    }
    axis.rows.clear();
    for (const std::string& choice : choices) axis.rows.push_back({choice});
}

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

std::vector<std::string_view> placeholder_names(const ParameterSet& parameters, const Axes& axes,
                                                const ScriptParameter& out) {
    std::vector<std::string_view> names;
    const auto add = [&names](std::string_view name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const Axis& axis : axes.list) {
        for (const std::string& name : axis.names) add(name);
    }
    for (const ScriptParameter& p : parameters.list) {
        if (&p != &out) add(p.name);
    }
    add("n");
    return names;
}

}  // namespace

[[noreturn]] void refuse_plan(const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
}

const ScriptParameter* find_parameter(const ParameterSet& parameters, const std::string& name) {
    for (const ScriptParameter& p : parameters.list) {
        if (p.name == plain_name(name)) return &p;
    }
    return nullptr;
}

std::pair<const ScriptParameter*, std::string> named_parameter(const ParameterSet& parameters,
                                                               const std::string& word) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return {nullptr, word};
    const ScriptParameter* found = find_parameter(parameters, word.substr(0, equals));
    return found ? std::pair(found, word.substr(equals + 1)) : std::pair(found, word);
}

Axes read_axes(const ParameterSet& parameters, const ScriptParameter& out,
               const BatchWords& words) {
    Axes axes;
    for (const std::string& word : words.over) {
        axes.list.push_back(over_axis(parameters, out, word));
    }
    for (const std::string& word : words.sweep) {
        Axis axis = sweep_axis(word);
        const ScriptParameter& p = require(parameters, axis.names[0], "--sweep " + word);
        axis.names[0] = p.name;
        list_choices(p, axis);
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
void require_known_names(const ParameterSet& parameters, const ScriptParameter& out,
                         const Axes& axes, const OutputName& output) {
    const std::vector<std::string> used = output.placeholders();
    const std::vector<std::string_view> known = placeholder_names(parameters, axes, out);
    for (const std::string& name : used) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        refuse_plan("--out: there is no value for {" + name + "}" + name_hint(name, known));
    }
    for (const Axis& axis : axes.list) {
        for (std::size_t i = 0; i < axis.given; ++i) {
            const std::string& name = axis.names[i];
            if (find_parameter(parameters, name)) continue;
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
        if (count > kMaxJobs) refuse_plan("the batch has more than a million jobs");
    }
    return count;
}

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

std::string job_place(const Axes& axes, std::size_t index) {
    std::string place = "job " + std::to_string(index + 1);
    for (auto axis = axes.list.rbegin(); axis != axes.list.rend(); ++axis) {
        const std::size_t row = index % axis->rows.size();
        if (!axis->lines.empty()) {
            place += " (" + axis->table + ":" + std::to_string(axis->lines[row]) + ")";
        }
        index /= axis->rows.size();
    }
    return place;
}

}  // namespace lissom::cli
