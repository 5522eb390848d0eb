#include "viewer/window/app/scene_autosave.h"

#include <algorithm>
#include <iostream>
#include <system_error>
#include <utility>

namespace lissom::window {
namespace {

// Seconds between two copies of a scene.
constexpr double kCopyEvery = 1.0;

}  // namespace

void SceneAutosave::begin(const std::string& first) {
    first_ = first;
    saved_path_.clear();
    opened_ = first_ == asked_ ? asked_ : std::filesystem::path();
    if (!opened_.empty()) std::erase(state_.content.left, opened_);
    asked_.clear();
}

void SceneAutosave::copy() {
    if (change_ == copied_ || seconds_since(last_copy_) < kCopyEvery) return;
    if (state_.session.busy()) return;
    copied_ = change_;
    last_copy_ = Clock::now();
    state_.session.copy_scene(recovery_.file().string(), recovery_.journal().string());
}

std::optional<std::string> SceneAutosave::answer(const PanelAnswers& answers) {
    auto& all = state_.content.left;
    if (all.empty() || !(answers.open_left || answers.forget_left)) return std::nullopt;
    const std::filesystem::path left = all.front();
    state_.changes.owe_frames();
    if (answers.forget_left) {
        all.erase(all.begin());
        Recovery::remove(left);
        return std::nullopt;
    }
    // It is offered until it was opened.
    asked_ = left;
    return left.string();
}

void SceneAutosave::forget_opened() {
    if (!opened_.empty()) Recovery::remove(std::exchange(opened_, {}));
}

// A free name here: the scene of armadillo.obj is armadillo.lissom; that of a copy, which may go at
// any time, is recovered.lissom.
std::string SceneAutosave::scene_path() const {
    const bool is_copy = first_.parent_path() == state_folder();
    if (first_.extension() == ".lissom" && !is_copy) return first_.string();
    const std::string stem = is_copy ? "recovered" : first_.stem().string();
    std::error_code error;
    for (int number = 1;; ++number) {
        std::string path = stem + (number > 1 ? "-" + std::to_string(number) : "") + ".lissom";
        if (!std::filesystem::exists(path, error)) return path;
    }
}

void SceneAutosave::save() {
    if (saved_path_.empty()) saved_path_ = scene_path();
    state_.session.save_scene(saved_path_, state_.content.tool.scene, change_);
}

void SceneAutosave::take_saved(std::uint64_t change) {
    saved_ = std::max(saved_, change);
    if (saved_ != change_) return;
    copied_ = change_;
    Recovery::remove(recovery_.file());
    forget_opened();
}

void SceneAutosave::keep_unsaved() {
    if (saved_ == change_) return;
    const std::filesystem::path kept = recovery_.keep();
    if (kept.empty()) return;
    forget_opened();
    std::cerr << "lissom: the scene was not saved; lissom view " << kept.string() << " opens it"
              << std::endl;
}

void SceneAutosave::replace() {
    const std::filesystem::path kept = saved_ == change_ ? "" : recovery_.keep();
    saved_ = copied_ = ++change_;
    if (kept.empty()) return;
    std::string text = "the scene before was not saved; lissom view " + kept.string() + " opens it";
    state_.tell("line " + text);
    state_.add_line(LineKind::warning, std::move(text));
}

void SceneAutosave::offer() {
    const auto& all = state_.content.left = Recovery::left_in(state_folder());
    if (all.empty()) return;
    const std::filesystem::path& left = all.front();
    std::string text =
        "A scene of another window was not saved. lissom view " + left.string() + " opens it";
    const std::filesystem::path journal = Recovery::journal_of(left);
    if (!journal.empty())
        text += "; lissom run " + journal.string() + " does it again without a window";
    if (all.size() > 1) text += "; there are " + std::to_string(all.size() - 1) + " more beside it";
    // The panel has a line for it.
    state_.tell("line " + text);
}

}  // namespace lissom::window
