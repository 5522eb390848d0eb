/// Prompt: the line of the console that a person writes, with its history and completions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "viewer/window/panel/panel_content.h"

struct ImGuiInputTextCallbackData;

namespace lissom::window {

class Prompt {
  public:
    /// Draws the line, and leaves room `beside` it.
    void draw(PanelContent& content, PanelAnswers& answers, float beside);
    /// Draws the words that may follow, above a place of the window.
    void draw_candidates(float left, float bottom, float width);
    bool has_candidates() const { return !candidates_.empty(); }

  private:
    struct Frame;
    void recall(ImGuiInputTextCallbackData& data);
    void continue_line(ImGuiInputTextCallbackData& data, PanelContent& content);
    void take_candidate(const std::string& word);

    std::string line_;
    // Words that may follow at the completed place, and the line up to there.
    std::vector<std::string> candidates_;
    std::string completed_text_;
    // The line was changed from outside: the cursor goes to its end.
    bool goes_to_end_ = false;
    // Lines that were entered, and which of them the arrows have come to.
    std::vector<std::string> entered_;
    std::size_t recalled_ = 0;
};

}  // namespace lissom::window
