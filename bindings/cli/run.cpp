// lissom run FILE [--name value ...]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bindings/cli/json.h"
#include "bindings/cli/script.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/verbs.h"
#include "bindings/cli/wall/wall.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// Options before the file that take the next word.
bool takes_word(const std::string& word) {
    constexpr std::string_view kOptions[] = {"--threads", "--seconds", "--memory", "--output",
                                             "--read",    "--write",   "--wall"};
    return std::find(std::begin(kOptions), std::end(kOptions), word) != std::end(kOptions);
}

// Words up to the file are the program's, those after it the script's.
struct Words {
    std::vector<std::string> own;
    lua::ScriptArguments script;

    explicit Words(const std::vector<std::string>& words) {
        std::size_t i = 0;
        while (i < words.size() && words[i].size() > 1 && words[i][0] == '-') {
            own.push_back(words[i]);
            if (takes_word(words[i++]) && i < words.size()) own.push_back(words[i++]);
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

// Returns a message on the unused words of a script without parameters, or "".
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
int run_file(Program& program, const lua::ScriptArguments& arguments,
             const std::optional<lua::SandboxLimits>& limits) {
    const bool from_input = arguments.script == "-";
    const std::optional<std::string> text = script_text(arguments.script);
    const ScriptTraits traits = text ? script_traits(*text) : ScriptTraits{true, true};
    const bool only_help = lua::asks_for_help(arguments.words);
    const std::string unclaimed = only_help ? "" : unclaimed_text(arguments.words, traits);
    if (!unclaimed.empty() && !traits.may_declare) {
        return refuse_words(program, arguments.script, unclaimed);
    }
    Script script(program, arguments, limits);
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
    if (!ended_well) return report(program, result);
    if (text && is_recording(*text) && !program.json()) {
        std::cout << arguments.script << ": done again, and the scene is as it was recorded\n";
    }
    return kSuccess;
}

// Returns the error in a limit, or "".
std::string not_below_zero(std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_limit = end != text.c_str() && *end == '\0' && value >= 0.0 && value <= 1e12;
    return is_limit ? "" : text + " is no limit: give a number from 0 (no limit) to 1e12";
}

// The sandbox that the command line asks for.
class SandboxFlags {
  public:
    explicit SandboxFlags(CLI::App& app) {
        const auto add = [&](const char* name, auto& value, const std::string& help) {
            return app.add_option(name, value, help)
                ->check(CLI::Validator(not_below_zero, "NUMBER"));
        };
        app.add_flag("--sandbox", asked_,
                     "For a script that nobody vouches for: no system, no files but those allowed "
                     "here, and within limits (0: none)");
        given_ = {add("--seconds", limits_.seconds, "Time that it may take; 10"),
                  add("--memory", memory_, "MiB of Lua and the solvers; 256"),
                  add("--output", output_, "MiB that it may print and write; 64"),
                  app.add_option("--read", read_, "A folder whose files it may read; repeatable")
                      ->allow_extra_args(false),
                  app.add_option("--write", write_, "A folder whose files it may write; repeatable")
                      ->allow_extra_args(false),
                  app.add_option("--wall", wall_,
                                 "on: in a process of its own, which the system keeps from files, "
                                 "network and programs; off: within limits of Lua alone")
                      ->check(CLI::IsMember({"on", "off"}))};
    }

    bool has_wall() const { return asked_ && wall_ == "on"; }

    // Whether the limits are of a sandbox that was asked for.
    bool are_consistent() const {
        return asked_ || std::none_of(given_.begin(), given_.end(), [](const CLI::Option* option) {
                   return option->count() > 0;
               });
    }
    std::optional<lua::SandboxLimits> limits() const {
        if (!asked_) return {};
        constexpr double kMiB = 1 << 20;
        lua::SandboxLimits limits = limits_;
        limits.memory_bytes = static_cast<std::size_t>(memory_ * kMiB);
        limits.output_bytes = static_cast<std::size_t>(output_ * kMiB);
        limits.read_folders.assign(read_.begin(), read_.end());
        limits.write_folders.assign(write_.begin(), write_.end());
        return limits;
    }

  private:
    bool asked_ = false;
    lua::SandboxLimits limits_;
    double memory_ = 256.0, output_ = 64.0;
    std::vector<std::string> read_, write_;
    std::string wall_ = "on";
    std::vector<const CLI::Option*> given_;
};

fs::path folder_of_script(const std::string& script) {
    const fs::path folder = fs::path(script).parent_path();
    return folder.empty() ? "." : folder;
}

// A folder that is missing could not be named to the system.
void make_write_folders(const lua::SandboxLimits& limits) {
    std::error_code ignored;
    for (const fs::path& folder : limits.write_folders) fs::create_directories(folder, ignored);
}

WallRights wall_rights(const Program& program, const std::string& script,
                       const lua::SandboxLimits& limits) {
    WallRights rights;
    rights.seconds = limits.seconds;
    rights.memory_bytes = limits.memory_bytes;
    rights.output_bytes = limits.output_bytes;
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    rights.threads = program.threads > 0 ? program.threads : std::max(cores, 1);
    rights.read_folders = limits.read_folders;
    rights.read_folders.push_back(folder_of_script(script));
    const std::string shipped = Script::shipped_scripts();
    if (!shipped.empty()) rights.read_folders.emplace_back(shipped);
    rights.write_folders = limits.write_folders;
    return rights;
}

int report_end(Program& program, const std::string& script, const WallEnd& end,
               const lua::SandboxLimits& limits) {
    if (end.code.empty()) return end.status;
    for (const fs::path& folder : limits.write_folders) remove_left_overs(folder);
    ScriptResult result;
    result.status = end.status;
    result.code = end.code;
    result.message = script + ": " + end.message + " [" + end.code + "]";
    return report(program, result);
}

// Runs the script in a child process; the status is that of both.
int run_behind_wall(Program& program, const lua::ScriptArguments& arguments,
                    const lua::SandboxLimits& limits) {
    const std::string missing = missing_wall(wall_support());
    if (!missing.empty()) {
        return program.fail("this system lacks " + missing +
                                ", so that the sandbox is within limits of Lua alone; run the "
                                "script with --wall off if that is enough",
                            kFailure);
    }
    make_write_folders(limits);
    const std::optional<WallEnd> end =
        go_behind_wall(wall_rights(program, arguments.script, limits));
    if (end) return report_end(program, arguments.script, *end, limits);
    return run_file(program, arguments, limits);
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
    app.add_flag("--unsafe-debug", program.unsafe_debug,
                 "The whole of Lua's debug library, for debuggers and coverage: a script can crash "
                 "the program by it");
    const SandboxFlags sandbox(app);
    int status = kSuccess;
    if (!program.parse(app, split.own, status)) return status;
    if (program.json()) program.output = Output::json_errors;
    if (!sandbox.are_consistent()) {
        return program.fail(
            "--seconds, --memory, --output, --read, --write and --wall belong to --sandbox",
            kUsage);
    }
    const std::optional<lua::SandboxLimits> limits = sandbox.limits();
    if (limits && program.unsafe_debug) {
        return program.fail("--unsafe-debug is for scripts that are trusted, without --sandbox",
                            kUsage);
    }
    if (sandbox.has_wall()) return run_behind_wall(program, split.script, *limits);
    return run_file(program, split.script, limits);
}

}  // namespace lissom::cli
