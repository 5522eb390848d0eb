#include "bindings/cli/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>
#include <thread>

#include "bindings/cli/json.h"
#include "bindings/cli/terminal/interrupt.h"
#include "bindings/cli/terminal/progress_bar.h"
#include "bindings/cli/terminal/terminal.h"
#include "kernel/core/build_info.h"
#include "kernel/core/nearest.h"
#include "kernel/core/version.h"

namespace lissom::cli {

namespace {

void fail_by_json(const Json& error, bool is_answer, const Program& program) {
    if (is_answer) return program.answer(json_text(error));
    std::cerr << json_text(error, -1) << std::endl;
}

}  // namespace

struct Program::Parts {
    ProgressBar bar{std::cerr};
    bool shows_progress = error_is_terminal();
    std::optional<Context> context;
    std::optional<Interrupt> interrupt;
};

Program::Program(const ProgramParts& parts) : parts_(parts), own_(std::make_unique<Parts>()) {}

Program::~Program() {
    clear_progress();
}

bool Program::parse(CLI::App& app, const std::vector<std::string>& words, int& status) {
    bool wants_json = false;
    app.add_flag("--json", wants_json, "Write the answer and errors as JSON");
    app.add_flag("--debug", debug, "Write all log messages, and the traceback of script errors");
    app.add_option("--threads", threads,
                   "Threads of the kernel's loops (default: one for each core)")
        ->check(CLI::Range(1, 1024))
        ->envname("LISSOM_THREADS");
    // CLI11 takes words from the end.
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    const bool asked = std::find(words.begin(), words.end(), "--json") != words.end();
    try {
        app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        (help_stream ? *help_stream : std::cout) << app.help();
        status = kSuccess;
        return false;
    } catch (const CLI::ParseError& error) {
        if (asked) output = Output::json;
        status = fail(app.get_name() + ": " + error.what() + " (see " + app.get_name() + " --help)",
                      kUsage);
        return false;
    }
    if (wants_json) output = Output::json;
    return true;
}

ContextOptions Program::context_options() {
    ContextOptions options;
    const unsigned cores = std::thread::hardware_concurrency();
    options.threads = threads > 0 ? threads : static_cast<int>(std::max(1u, cores));
    options.log = [this](LogLevel level, std::string_view message) {
        if (log_filter && !log_filter(level, message)) return;
        if (level != LogLevel::warning && !debug) return;
        clear_progress();
        std::cerr << (level == LogLevel::warning ? "warning: " : "") << message << std::endl;
    };
    if (progress_listener) {
        options.progress = progress_listener;
    } else if (own_->shows_progress) {
        options.progress = [this](std::string_view label, double fraction) {
            own_->bar.show(label, fraction);
        };
    }
    return options;
}

const Context& Program::context() {
    if (!own_->context) {
        own_->context.emplace(context_options());
        listen(*own_->context);
    }
    return *own_->context;
}

lua::HostOptions Program::host_options() {
    auto registry = std::make_shared<lua::Registry>();
    for (const auto& library : parts_.libraries) registry->add(library());
    lua::HostOptions options;
    options.context = context_options();
    options.registry = std::move(registry);
    options.operation_ended = [this] { clear_progress(); };
    options.check_file = file_used;
    return options;
}

void Program::listen(const Context& context) {
    own_->interrupt.emplace(context);
}

bool Program::interrupted() const {
    return own_->interrupt && own_->interrupt->pressed();
}

void Program::forget_interrupt() {
    if (own_->interrupt) own_->interrupt->clear();
}

void Program::wait_at_prompt(bool waits) {
    Interrupt::wait_at_prompt(waits);
}

void Program::show_progress(std::string_view label, double fraction) {
    if (own_->shows_progress) own_->bar.show(label, fraction);
}

void Program::clear_progress() {
    own_->bar.clear();
}

void Program::answer(const std::string& json) const {
    if (answer_listener) return answer_listener(json);
    std::cout << json << std::endl;
}

int Program::fail(const Error& error) {
    clear_progress();
    if (!json()) {
        std::cerr << "lissom: " << lua::lua_message(error) << " [" << code_name(error.code()) << "]"
                  << std::endl;
        return kFailure;
    }
    fail_by_json({{"error", error_json(error)}}, output == Output::json, *this);
    return kFailure;
}

int Program::fail(const std::string& message, int status) {
    clear_progress();
    if (!json()) {
        std::cerr << message << std::endl;
        return status;
    }
    const Json error = {{"message", message}, {"code", status == kUsage ? "usage" : "failure"}};
    fail_by_json({{"error", error}}, output == Output::json, *this);
    return status;
}

namespace {

void print_help(const ProgramParts& parts) {
    std::cout << "Lissom: modeling by few handles, scripted in Lua.\n\nUsage:\n";
    std::size_t width = 0;
    const auto call = [](const Verb& verb) { return "lissom " + verb.name + " " + verb.usage; };
    for (const Verb& verb : parts.verbs) width = std::max(width, call(verb).size());
    for (const Verb& verb : parts.verbs) {
        const std::string text = call(verb);
        std::cout << "  " << text << std::string(width - text.size() + 2, ' ') << verb.summary
                  << "\n";
    }
    std::cout
        << "\nlissom VERB --help lists the options of a verb; lissom --version lists the "
           "parts of this build.\nExit status: 0 done, 1 failed, 2 called wrongly, 130 stopped by "
           "Ctrl-C.\n";
}

int print_version(const ProgramParts& parts, bool json) {
    const BuildInfo build = build_info();
    if (json) {
        std::cout << json_text({{"name", "lissom"},
                                {"version", LISSOM_VERSION},
                                {"lua", LUA_RELEASE},
                                {"licence", build.licence},
                                {"gpl", build.gpl},
                                {"threads", build.tbb ? "oneTBB" : "none"},
                                {"details", parts.version_lines}})
                  << std::endl;
        return kSuccess;
    }
    std::cout << "lissom " LISSOM_VERSION ", licence of this build: " << build.licence
              << "\n" LUA_RELEASE << (build.tbb ? ", parallel loops: oneTBB\n" : "\n");
    for (const std::string& line : parts.version_lines) std::cout << line << "\n";
    return kSuccess;
}

const Verb* find_verb(const ProgramParts& parts, const std::string& name) {
    for (const Verb& verb : parts.verbs) {
        if (verb.name == name) return &verb;
    }
    return nullptr;
}

int refuse_verb(Program& program, const std::string& word) {
    std::vector<std::string_view> names;
    for (const Verb& verb : program.parts().verbs) names.push_back(verb.name);
    const bool is_script = word.size() > 4 && word.compare(word.size() - 4, 4, ".lua") == 0;
    const std::string hint =
        is_script ? "; to run a script: lissom run " + word : name_hint(word, names);
    return program.fail("lissom: no verb '" + word + "'" + hint, kUsage);
}

int run_words(Program& program, const ProgramParts& parts, const std::vector<std::string>& words) {
    if (words.empty()) {
        print_help(parts);
        return kUsage;
    }
    const std::string& first = words[0];
    const bool json = words.size() > 1 && words[1] == "--json";
    if (first == "--help" || first == "-h" || (first == "help" && words.size() == 1)) {
        print_help(parts);
        return kSuccess;
    }
    if (first == "--version") return print_version(parts, json);
    const int status = run_verb(program, words);
    return status != kSuccess && program.interrupted() ? kInterrupted : status;
}

// Both the program and Lua write to it. Some systems tell only in the end that a disk is full.
bool output_is_written() {
    std::cout << std::flush;
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
}

}  // namespace

int run_verb(Program& program, const std::vector<std::string>& words) {
    const Verb* verb = find_verb(program.parts(), words.at(0));
    if (!verb) return refuse_verb(program, words[0]);
    try {
        return verb->run(program, {words.begin() + 1, words.end()});
    } catch (const Error& error) {
        return program.fail(error);
    } catch (const std::bad_alloc&) {
        return program.fail("lissom: there is not enough memory");
    } catch (const std::exception& error) {
        return program.fail(std::string("lissom: ") + error.what());
    }
}

int run_program(int argc, char** argv, const ProgramParts& parts) {
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    Program program(parts);
    const int status = run_words(program, parts, words);
    if (output_is_written()) return status;
    std::cerr << "lissom: the standard output could not be written in full" << std::endl;
    return status == kSuccess ? kFailure : status;
}

}  // namespace lissom::cli
