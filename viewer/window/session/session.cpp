#include "viewer/window/session/session.h"

#include <utility>

#include "bindings/cli/terminal/interrupt.h"

namespace lissom::window {
namespace {

// Seconds after which a tool is stopped if its file changes.
constexpr double kLongWork = 1.0;

// Seconds after which a stroke that a slow tool follows is shown as far as it has come.
constexpr double kLongStroke = 0.05;

}  // namespace

Session::Session(cli::Program& program, std::function<void()> wake, SessionOptions options)
    : news_(std::move(wake)),
      control_(program),
      scene_({program, news_, control_, names_, playing_}, std::move(options)),
      play_(scene_, {program, news_, control_, names_, playing_}),
      opener_(scene_, play_, {program, news_, control_, names_, playing_}),
      console_(scene_, {program, news_, control_, names_, playing_}),
      saver_(scene_, {program, news_, control_, names_, playing_}),
      queue_([this] { take_inputs(); }) {
    program.log_filter = [this, &program](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning || program.debug) {
            news_.tell(level == LogLevel::warning ? LineKind::warning : LineKind::message,
                       std::string(text));
        }
        return false;
    };
    program.progress_listener = [this](std::string_view label, double fraction) {
        control_.note(label, fraction);
    };
}

Session::~Session() {
    finish(1.0);
    // The Lua state ends on the thread that it lived on.
    queue_.post_only([this] { scene_.close(); });
    queue_.wait_idle(1.0);
}

// ---- Requests of the window's thread

// Running work is given up for the job.
void Session::post_only(Worker::Job job) {
    control_.give_up(busy());
    queue_.post_only(std::move(job));
}

void Session::open(const std::vector<std::string>& words) {
    const std::uint64_t number = names_.ask(words);
    post_only([this, words, number] {
        opener_.run(words, true);
        names_.answer(number);
    });
}

void Session::find_tools(const std::vector<std::string>& scripts) {
    queue_.post([this, scripts] { opener_.find_tools(scripts); });
}

void Session::run_again(const std::vector<std::string>& words) {
    if (is_opening() || !names_.change_words(words)) return;
    post_only([this] { opener_.run(names_.words(), false); });
}

void Session::evaluate(const std::string& line) {
    news_.tell(LineKind::input, line);
    queue_.post([this, line] { console_.evaluate(line); });
}

void Session::complete(const std::string& text) {
    queue_.post([this, text] { console_.complete(text); });
}

void Session::cancel() {
    control_.cancel(busy());
}

void Session::use_tool(const std::string& word) {
    queue_.post([this, word] {
        control_.begin();
        scene_.use_tool(word);
        scene_.show(true);
    });
}

// Work that runs for long may be the tool that never returns, and was mended for that reason.
void Session::read_tool_again() {
    if (busy() && control_.seconds() > kLongWork) cancel();
    queue_.post([this] {
        control_.begin();
        scene_.use_tool_again();
        scene_.show(true);
    });
}

void Session::post(ToolInput input) {
    queue_.post(std::move(input));
}

void Session::show_object(const std::string& name, bool visible) {
    queue_.post([this, name, visible] {
        if (!scene_.has_scene()) return;
        control_.begin();
        scene_.succeeds(scene_.bench().show(name, visible));
        scene_.show(true);
    });
}

void Session::save_scene(const std::string& path, std::uint64_t scene, std::uint64_t change) {
    queue_.post([this, path, scene, change] { saver_.save(path, scene, change); }, true);
}

void Session::export_object(const std::string& path) {
    queue_.post([this, path] { saver_.export_object(path); }, true);
}

void Session::copy_scene(const std::string& path, const std::string& journal) {
    queue_.post([this, path, journal] { saver_.copy(path, journal); });
}

void Session::set_tool_parameter(const std::string& name, const lua::ParameterValue& value) {
    queue_.post({name, value}, [this](const RequestQueue::Setting& setting) {
        if (!scene_.has_scene()) return;
        control_.begin();
        scene_.succeeds(scene_.bench().set(setting.first, setting.second));
        scene_.show(true);
    });
}

void Session::stop_playing() {
    if (!playing_.goes_on.exchange(false)) return;
    cancel();
    ToolInput stop;
    stop.kind = ToolInput::Kind::stop;
    post(std::move(stop));
}

bool Session::finish(double seconds) {
    if (!busy()) return true;
    cli::Interrupt::press();
    return queue_.wait_idle(seconds);
}

// ---- Input on the session's thread

void Session::take_inputs() {
    const std::vector<ToolInput> inputs = queue_.next_inputs();
    if (inputs.empty()) return;
    control_.begin();
    bool only_looks = true;
    auto seen = Clock::now();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ToolInput& input = inputs[i];
        if (input.kind == ToolInput::Kind::look) scene_.look(input);
        if (!scene_.has_scene()) continue;
        const bool is_hover = input.kind == ToolInput::Kind::move && !scene_.bench().is_held();
        const bool is_late = is_followed(inputs, i);
        if (is_hover && is_late) continue;
        only_looks = only_looks && (is_hover || input.kind == ToolInput::Kind::look);
        take_input(input, is_late);
        if (seconds_since(seen) < kLongStroke || i + 1 == inputs.size()) continue;
        scene_.show(!std::exchange(only_looks, true));
        seen = Clock::now();
    }
    scene_.show(!only_looks);
}

void Session::take_input(const ToolInput& input, bool is_late) {
    if (input.kind == ToolInput::Kind::play) {
        play_.play(input.event);
    } else if (input.kind == ToolInput::Kind::stop) {
        scene_.let_go();
    } else {
        scene_.succeeds(scene_.bench().take(input, is_late));
    }
}

}  // namespace lissom::window
