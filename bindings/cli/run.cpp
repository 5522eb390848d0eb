// lissom run FILE [--name value ...]
#include <CLI/CLI.hpp>
#include <iostream>

#include "bindings/cli/json.h"
#include "bindings/cli/script.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/verbs.h"
#include "bindings/lua/core/script_parameters.h"

namespace lissom::cli {
namespace {

// Words up to the file are the program's, those after it the script's.
struct Words {
    std::vector<std::string> own;
    lua::ScriptArguments script;

    explicit Words(const std::vector<std::string>& words) {
        std::size_t i = 0;
        while (i < words.size() && words[i].size() > 1 && words[i][0] == '-') {
            own.push_back(words[i]);
            if (words[i++] == "--threads" && i < words.size()) own.push_back(words[i++]);
        }
        if (i == words.size()) return;
        own.push_back(words[i]);
        script.script = words[i];
        script.words.assign(words.begin() + i + 1, words.end());
    }
};

Json value_json(const lua::ScriptParameter& p, const std::optional<lua::ParameterValue>& value) {
    if (!value) return nullptr;
    if (const auto* flag = std::get_if<bool>(&*value)) return *flag;
    if (const auto* text = std::get_if<std::string>(&*value)) return *text;
    const double number = std::get<double>(*value);
    if (p.type == lua::ParameterType::integer) return static_cast<long long>(number);
    return number;
}

Json parameter_json(const lua::ScriptParameter& p) {
    Json json = {{"name", p.name},
                 {"type", std::string(lua::type_name(p.type))},
                 {"default", value_json(p, p.default_value)}};
    if (std::isfinite(p.min)) json["min"] = p.min;
    if (std::isfinite(p.max)) json["max"] = p.max;
    if (p.step) json["step"] = *p.step;
    if (!p.choices.empty()) json["choices"] = p.choices;
    for (const auto& [key, text] :
         {std::pair("unit", &p.unit), std::pair("group", &p.group), std::pair("help", &p.help)}) {
        if (!text->empty()) json[key] = *text;
    }
    return json;
}

int print_parameters(const Program& program, const lua::State& state) {
    if (!program.json()) {
        const bool has_text = state.script_end == lua::ScriptEnd::help;
        std::cout << (has_text ? state.script_end_text
                               : "Usage: lissom run " + state.host.arguments.script +
                                     "\n\nThe script declares no parameters.\n");
        return kSuccess;
    }
    Json parameters = Json::array();
    if (state.parameters) {
        for (const lua::ScriptParameter& p : state.parameters->list) {
            parameters.push_back(parameter_json(p));
        }
    }
    std::cout << json_text({{"script", state.host.arguments.script}, {"parameters", parameters}})
              << std::endl;
    return kSuccess;
}

int report(Program& program, const ScriptResult& result) {
    if (!program.json()) return program.fail(result.message, result.status);
    Json error = {{"message", result.message}};
    error["code"] = result.status == kUsage ? "usage"
                    : result.code.empty()   ? "failure"
                                            : result.code;
    if (!result.file.empty()) {
        error["file"] = result.file;
        error["line"] = result.line;
    }
    std::cerr << json_text({{"error", error}}, -1) << std::endl;
    return result.status;
}

// A flag that nothing takes, or "".
std::string unclaimed_flag(const std::vector<std::string>& words, const ScriptTraits& traits) {
    return traits.reads_words ? "" : lua::first_flag(words);
}

// What nothing takes of the words of a script that declares no parameters, as a message, or "".
std::string unclaimed_text(const std::vector<std::string>& words, const ScriptTraits& traits) {
    const std::string flag = unclaimed_flag(words, traits);
    if (!flag.empty()) return lua::unknown_flag_text(flag, {});
    const bool is_stray = !traits.reads_words && !words.empty() && words.front() != "--";
    return is_stray ? lua::stray_word_text(words.front()) : "";
}

int refuse_words(Program& program, const std::string& script, const std::string& text) {
    return program.fail(script + ": " + text + " (see lissom run " + script + " --help)", kUsage);
}

// Runs the script, unless its text shows that it does not take a word of its command line.
int run_file(Program& program, const lua::ScriptArguments& arguments) {
    const bool from_input = arguments.script == "-";
    const std::optional<std::string> text = script_text(arguments.script);
    const ScriptTraits traits = text ? script_traits(*text) : ScriptTraits{true, true};
    const bool only_help = lua::asks_for_help(arguments.words);
    const std::string unclaimed = only_help ? "" : unclaimed_text(arguments.words, traits);
    if (!unclaimed.empty() && !traits.may_declare) {
        return refuse_words(program, arguments.script, unclaimed);
    }
    Script script(program, arguments);
    lua::set_reads_words(script.lua(), traits.reads_words);
    const lua::State& state = script.state();
    if (only_help && !traits.may_declare) return print_parameters(program, state);
    const ScriptResult result =
        from_input ? script.run_text(*text) : script.run_file(arguments.script);
    const bool ended_well = result.status == kSuccess;
    if (only_help && ended_well) return print_parameters(program, state);
    if (ended_well && !unclaimed.empty() && !state.parameters) {
        return refuse_words(program, arguments.script, unclaimed);
    }
    return ended_well ? kSuccess : report(program, result);
}

}  // namespace

int run_script(Program& program, const std::vector<std::string>& words) {
    const Words split(words);
    CLI::App app(
        "Runs a Lua script. Words after FILE are the script's; `lissom run FILE --help` lists "
        "its parameters and does not run it.",
        "lissom run");
    std::string file;
    app.add_option("FILE", file, "The script; - for the standard input")->required();
    int status = kSuccess;
    if (!program.parse(app, split.own, status)) return status;
    if (program.json()) program.output = Output::json_errors;
    return run_file(program, split.script);
}

}  // namespace lissom::cli
