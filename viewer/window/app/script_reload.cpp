#include "viewer/window/app/script_reload.h"

#include <cstdio>
#include <cstdlib>
#include <variant>

#include "kernel/core/error.h"

namespace lissom::window {
namespace {

// Seconds that a parameter stays as it is before the script runs again.
constexpr double kParameterRest = 0.08;

std::string text_of(const lua::ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.17g", std::get<double>(value));
    return buffer;
}

// Returns the command line that gives the script these values; defaults are left to the script,
// whose next version may have others.
std::vector<std::string> words_of(const std::vector<lua::ScriptParameter>& parameters) {
    std::vector<std::string> words;
    for (const lua::ScriptParameter& p : parameters) {
        if (p.value && p.value != p.default_value)
            words.push_back("--" + p.name + "=" + text_of(*p.value));
    }
    return words;
}

}  // namespace

void ScriptReload::begin(const std::string& first) {
    presets_ = Presets(is_script(first) ? first : "");
    list_presets();
}

void ScriptReload::run_again() {
    state_.session.run_again(words_of(state_.content.parameters));
}

void ScriptReload::look() {
    if (state_.session.is_opening()) return;
    if (!state_.session.busy()) watch();
    tool_watch_.set(state_.session.tool_files());
    if (tool_watch_.changed(Clock::now()) && !state_.plays) {
        state_.tell("tool changed");
        state_.session.read_tool_again();
    }
    if (watch_.changed(Clock::now())) {
        state_.tell("changed");
        run_again();
    }
    if (!parameters_changed_ || seconds_since(*parameters_changed_) < kParameterRest) return;
    parameters_changed_.reset();
    run_again();
}

void ScriptReload::answer(const PanelAnswers& answers) {
    if (answers.run_again) run_again();
    if (answers.parameters_changed) parameters_changed_ = Clock::now();
    if (answers.place) open_editor(*answers.place);
    answer_presets(answers);
}

void ScriptReload::take_failures() {
    for (const std::string& failure : programs_.failures()) {
        state_.add_line(LineKind::error, failure);
    }
}

// Without parameters in sight there is nothing to keep; a broken file is told when it is met.
void ScriptReload::list_presets() {
    auto& listed = state_.content.presets;
    listed.reset();
    if (presets_.file().empty()) return;
    listed.emplace();
    try {
        listed = presets_.names();
    } catch (const Error& error) {
        state_.add_line(LineKind::error, error.message());
    }
}

void ScriptReload::answer_presets(const PanelAnswers& answers) {
    if (!answers.load_preset && !answers.save_preset && !answers.remove_preset) return;
    auto& parameters = state_.content.parameters;
    try {
        if (answers.save_preset) presets_.save(*answers.save_preset, values_of(parameters));
        if (answers.remove_preset) presets_.remove(*answers.remove_preset);
        if (answers.load_preset) {
            for (const std::string& refused :
                 apply_preset(presets_.load(*answers.load_preset), parameters)) {
                state_.add_line(LineKind::warning, refused);
            }
            parameters_changed_ = Clock::now();
        }
    } catch (const Error& error) {
        state_.add_line(LineKind::error, error.message());
    }
    list_presets();
}

void ScriptReload::open_editor(const SourcePlace& place) {
    const EditorHost host{
        [](const char* name) { return std::getenv(name); },
        [this](const std::vector<std::string>& words) { return programs_.start(words); }};
    const std::string wrong = open_in_editor(place, host);
    if (!wrong.empty()) state_.add_line(LineKind::error, wrong);
    state_.tell(wrong.empty() ? "editor" : "error " + wrong);
}

}  // namespace lissom::window
