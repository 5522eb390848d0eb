/// OpenScene: the scene of a session with its script and the tool in hand. It lives on the
/// session's thread; results go to the board of news.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/script.h"
#include "viewer/window/document/news_board.h"
#include "viewer/window/document/open_names.h"
#include "viewer/window/document/playing.h"
#include "viewer/window/document/session_options.h"
#include "viewer/window/document/shown_pictures.h"
#include "viewer/window/document/work_control.h"
#include "viewer/window/session/record_files.h"
#include "viewer/window/tools/tool_bench.h"

namespace lissom::window {

/// Parts of a session that its threads share; they outlive all that refers to them.
struct SessionParts {
    cli::Program& program;
    NewsBoard& news;
    WorkControl& control;
    OpenNames& names;
    Playing& playing;
};

class OpenScene {
  public:
    OpenScene(SessionParts parts, SessionOptions options);
    OpenScene(const OpenScene&) = delete;
    OpenScene& operator=(const OpenScene&) = delete;

    // ---- States of Lua

    /// A state of Lua with the scene in it.
    struct State {
        std::unique_ptr<cli::Script> script;
        std::unique_ptr<ToolBench> bench;
        std::size_t pictures = 0;
        std::optional<Shown> shown;
    };
    /// Opens another state, whose prints and pictures come here.
    void open(const lua::ScriptArguments& arguments);
    /// Ends the state.
    void close();
    /// Returns the state, for `put_back`; there is none then.
    State put_aside();
    /// Restores a state after its replacement has failed.
    void put_back(State state);
    /// Shows the picture of a state that was put back, if something else was shown meanwhile.
    void show_again(const std::optional<Shown>& shown) { pictures_.show_again(shown); }

    bool has_script() const { return script_ != nullptr; }
    cli::Script& script() { return *script_; }
    ToolBench& bench() { return *bench_; }
    bool has_scene() const { return bench_ && bench_->has_scene(); }
    const SessionOptions& options() const { return options_; }
    const RecordFiles& records() const { return records_; }
    std::uint64_t number() const { return number_; }

    // ---- Results

    /// Tells an error, and recovers; returns false then.
    bool succeeds(const cli::ScriptResult& result);
    /// Tells if the file that failed last works again: red lines stay.
    void tell_whether_mended(const std::string& file, bool works);
    /// Returns whether the script has shown pictures.
    bool has_pictures() const { return pictures_shown_ > 0; }
    /// Returns whether the values on the stack can be seen; values that cannot be drawn are
    /// reported when shown.
    bool has_values();
    /// Shows the values on the stack; returns false if there is nothing to see.
    bool show_values();
    /// Shows the last picture anew.
    void show_last() { pictures_.show_last(); }
    /// Shows the scene with the tool's marks; unchanged ones only if `always`.
    void show(bool always);
    /// Shows the hand of a recording from now on, or no longer.
    void show_hand(bool shows) { shows_hand_ = shows; }

    // ---- Scene and tool

    /// A scene is there that was not before: it is seen and recorded as `open`, and the tool works
    /// on it unless a recording brings its own.
    void settle(const std::vector<std::string>& open, bool takes_tool = true);
    /// Keeps the selection and the state of the tool for the next scene.
    void keep_selection();
    void forget_selection() { kept_.clear(); }
    /// Takes a tool in hand, now and for the next scenes; returns whether it is in hand.
    bool use_tool(const std::string& word);
    /// Takes the tool in hand again.
    void use_tool_again() { settle_tool(options_.tool); }
    /// A recording has taken it in hand.
    void keep_tool(const std::string& word);
    /// Takes a tool in hand with the next scene.
    void set_next_tool(const std::string& word) { options_.tool = word; }
    /// The window looks at the scene so.
    void look(const ToolInput& input) { look_ = input; }
    /// Releases objects held by a gesture.
    void let_go();

  private:
    bool settle_tool(const std::string& word);
    bool show_changes(bool always);
    void publish(ToolState state);
    void draw_marks();
    void recover();
    static int print(lua_State* L);

    SessionParts parts_;
    SessionOptions options_;
    RecordFiles records_;
    ShownPictures pictures_;
    std::function<void(const Picture&)> listener_;
    std::unique_ptr<cli::Script> script_;
    std::unique_ptr<ToolBench> bench_;
    std::size_t pictures_shown_ = 0;
    // The view of the window.
    ToolInput look_;
    // The script or tool that failed last, and the last error of drawing.
    std::string broken_, draw_error_;
    // Selection and state of the tool, for a script that runs again.
    std::string kept_;
    std::uint64_t number_ = 0;
    bool shows_hand_ = false;
    ToolState last_state_;
};

}  // namespace lissom::window
