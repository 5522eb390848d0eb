/// ScriptReload: work on files and scripts beside showing their results: runs them again when they
/// or their parameters change, keeps presets, opens an editor.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/window/app/view_state.h"
#include "viewer/window/session/file_watch.h"
#include "viewer/window/session/presets.h"
#include "viewer/window/session/source_place.h"

namespace lissom::window {

class ScriptReload {
  public:
    /// `state` must outlive it.
    explicit ScriptReload(ViewState& state) : state_(state) {}

    /// Something else is open: files, or a script.
    void begin(const std::string& first);
    /// Looks for changed files or parameters, and runs their scripts again.
    void look();
    /// The shown picture was read from other files now.
    void watch() { watch_.set(state_.session.files()); }
    void answer(const PanelAnswers& answers);
    /// Tells of editors that have failed.
    void take_failures();
    /// Returns whether parameters have changed that the script has not run with.
    bool waits() const { return parameters_changed_.has_value(); }

  private:
    void list_presets();
    void answer_presets(const PanelAnswers& answers);
    void open_editor(const SourcePlace& place);
    void run_again();

    ViewState& state_;
    FileWatch watch_, tool_watch_;
    Presets presets_;
    StartedPrograms programs_;
    std::optional<Clock::time_point> parameters_changed_;
};

}  // namespace lissom::window
