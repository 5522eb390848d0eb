#include "viewer/window/panel/prompt.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "viewer/window/panel/prompt_completion.h"
#include "viewer/window/panel/text_history.h"

namespace lissom::window {
namespace {

constexpr std::size_t kShownCandidates = 60, kLongestPrompt = 1024;

void replace_text(ImGuiInputTextCallbackData& data, const std::string& text, std::size_t cursor) {
    data.DeleteChars(0, data.BufTextLen);
    data.InsertChars(0, text.c_str());
    data.CursorPos = static_cast<int>(cursor);
    data.ClearSelection();
    forget_history_in_use();
}

}  // namespace

// The arrows recall earlier lines.
void Prompt::recall(ImGuiInputTextCallbackData& data) {
    const std::size_t count = entered_.size();
    if (data.EventKey == ImGuiKey_UpArrow && recalled_ > 0) --recalled_;
    if (data.EventKey == ImGuiKey_DownArrow && recalled_ < count) ++recalled_;
    const std::string text = recalled_ < count ? entered_[recalled_] : "";
    replace_text(data, text, text.size());
}

// Takes an answer to Tab, if the line_ is still the one that was asked about.
void Prompt::continue_line(ImGuiInputTextCallbackData& data, PanelContent& content) {
    if (std::exchange(goes_to_end_, false)) replace_text(data, data.Buf, data.BufTextLen);
    const std::string now(data.Buf, static_cast<std::size_t>(data.BufTextLen));
    const auto cursor = static_cast<std::size_t>(data.CursorPos);
    if (now.substr(0, cursor) != completed_text_) candidates_.clear();
    const auto answer = std::exchange(content.completion, std::nullopt);
    if (!answer || answer->text != now.substr(0, cursor)) return;
    const CompletedLine next =
        completed_line(now, cursor, answer->found.begin, answer->found.words);
    replace_text(data, next.line, next.cursor);
    candidates_ = next.candidates;
    completed_text_ = next.line.substr(0, next.cursor);
}

// In place of the beginning that all candidates_ have in common.
void Prompt::take_candidate(const std::string& word) {
    std::size_t common = std::min(word.size(), completed_text_.size());
    while (!completed_text_.ends_with(word.substr(0, common))) --common;
    line_.insert(completed_text_.size(), word.substr(common));
    candidates_.clear();
    goes_to_end_ = true;
}

void Prompt::draw_candidates(float left, float bottom, float width) {
    if (candidates_.empty()) return;
    ImGui::SetNextWindowPos(ImVec2(left, bottom), ImGuiCond_Always, ImVec2(0.0f, 1.0f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(width, 1e6f));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyle().Colors[ImGuiCol_PopupBg]);
    ImGui::Begin("candidates_", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_AlwaysAutoResize);
    const std::size_t count = std::min(candidates_.size(), kShownCandidates);
    const float gap = 2.0f * ImGui::GetStyle().ItemSpacing.x;
    float used = 0.0f;
    std::optional<std::string> taken;
    for (std::size_t i = 0; i < count; ++i) {
        const ImVec2 size = ImGui::CalcTextSize(candidates_[i].c_str());
        used += size.x + gap;
        if (i > 0 && used < 0.9f * width) ImGui::SameLine(0.0f, gap);
        if (used >= 0.9f * width) used = size.x + gap;
        if (ImGui::Selectable(candidates_[i].c_str(), false, 0, size)) taken = candidates_[i];
    }
    if (count < candidates_.size()) ImGui::TextDisabled("and %zu more", candidates_.size() - count);
    ImGui::End();
    ImGui::PopStyleColor();
    if (taken) take_candidate(*taken);
}

// Data of a frame for the prompt's callbacks.
struct Prompt::Frame {
    Prompt& prompt;
    PanelContent& content;
    PanelAnswers& answers;

    void take(ImGuiInputTextCallbackData& data) const {
        if (data.EventFlag == ImGuiInputTextFlags_CallbackHistory) prompt.recall(data);
        if (data.EventFlag == ImGuiInputTextFlags_CallbackAlways) {
            prompt.continue_line(data, content);
        }
        if (data.EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
            answers.complete.emplace(data.Buf, static_cast<std::size_t>(data.CursorPos));
        }
    }
};

void Prompt::draw(PanelContent& content, PanelAnswers& answers, float beside) {
    std::array<char, kLongestPrompt> text{};
    line_.copy(text.data(), text.size() - 1);
    ImGui::SetNextItemWidth(-beside);
    if (goes_to_end_) ImGui::SetKeyboardFocusHere();
    forget_unfit_history("##prompt", text.data());
    Frame frame{*this, content, answers};
    const auto callback = [](ImGuiInputTextCallbackData* data) {
        static_cast<Frame*>(data->UserData)->take(*data);
        return 0;
    };
    const bool ended = ImGui::InputTextWithHint(
        "##prompt", "Lua: Tab completes", text.data(), text.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory |
            ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackAlways,
        callback, &frame);
    line_ = text.data();
    if (!ended || line_.empty()) return;
    candidates_.clear();
    entered_.push_back(line_);
    recalled_ = entered_.size();
    answers.line = std::exchange(line_, {});
    ImGui::SetKeyboardFocusHere(-1);
}

}  // namespace lissom::window
