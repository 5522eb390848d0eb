/// SceneAutosave: protects unsaved work: copies of the scene while it changes, saving, and the
/// scenes left by killed windows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/window/app/view_state.h"
#include "viewer/window/session/recovery.h"

namespace lissom::window {

class SceneAutosave {
  public:
    /// `state` must outlive it.
    explicit SceneAutosave(ViewState& state) : state_(state) {}

    /// Something else is open: files, or a script.
    void begin(const std::string& first);
    /// The scene has changed.
    void add_change() { ++change_; }
    /// Another scene has taken its place.
    void replace();
    /// Copies the scene if it has changed since the last copy, at most once a second.
    void copy();
    /// Writes the scene to its file, which `take_saved` hears of.
    void save();
    /// The scene was saved as it was after this change: there is nothing to recover then.
    void take_saved(std::uint64_t change);
    /// At the start: offers unsaved scenes of other windows.
    void offer();
    /// At the end: keeps unsaved work, and reports it.
    void keep_unsaved();
    /// Returns the left scene to be opened now, if the panel's answers ask for it.
    std::optional<std::string> answer(const PanelAnswers& answers);

  private:
    std::string scene_path() const;
    void forget_opened();

    ViewState& state_;
    Recovery recovery_{state_folder()};
    std::filesystem::path first_ = "scene";
    // Numbers of the last change of the scene, of the one in the recovery, and of the saved one.
    std::uint64_t change_ = 0, copied_ = 0, saved_ = 0;
    Clock::time_point last_copy_ = Clock::now();
    std::string saved_path_;
    // The scene left by another window to be opened, or opened here: it goes when it is kept
    // elsewhere.
    std::filesystem::path asked_, opened_;
};

}  // namespace lissom::window
