#include "viewer/window/panel/console_view.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "viewer/window/panel/panel_style.h"

namespace lissom::window {
namespace {

constexpr double kHeight = 118.0, kMinHeight = 60.0;
// The last lines of the console are drawn.
constexpr std::size_t kShownLines = 2000;

// Draws it in the console, so that it moves no button.
void draw_left(const PanelContent& content, PanelAnswers& answers) {
    const std::vector<std::filesystem::path>& left = content.left;
    if (left.empty() || content.playing) return;
    if (ImGui::Button("open it")) answers.open_left = true;
    ImGui::SameLine();
    if (ImGui::Button("forget it")) answers.forget_left = true;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", left.front().string().c_str());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(left.size() > 1 ? "the last of some scenes that were not saved"
                                           : "the scene of another window that was not saved");
}

void draw_line(const ConsoleLine& one, const std::optional<SourcePlace>& place,
               PanelAnswers& answers, bool is_dark) {
    push_line_color(one.kind, is_dark);
    ImGui::PushTextWrapPos(0.0f);
    const std::string times =
        one.times > 1 ? "  (" + std::to_string(one.times) + " times)" : std::string();
    const std::string shown = (one.kind == LineKind::input ? "> " : "") + one.text + times;
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    if (!place || !ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("click: line %d of %s in your editor", place->line, place->file.c_str());
    if (ImGui::IsItemClicked()) answers.place = place;
}

}  // namespace

ConsoleView::ConsoleView(double scale) : scale_(scale), height_(kHeight) {}

int ConsoleView::height(gl::Extent window) const {
    const bool is_usual = height_ == kHeight;
    const int most = is_usual ? 2 * window.height / 5 : 4 * window.height / 5;
    return std::min(static_cast<int>(height_ * scale_), most);
}

// Those of lines that are new; a file that appears later is not looked for again.
void ConsoleView::find_places(const std::vector<ConsoleLine>& lines) {
    const auto exists = [](const std::string& name) {
        std::error_code error;
        return std::filesystem::is_regular_file(name, error);
    };
    for (std::size_t i = places_.size(); i < lines.size(); ++i) {
        places_.push_back(find_place(lines[i].text, exists));
    }
}

// The upper edge of the console, which makes it larger or smaller.
void ConsoleView::drag_edge(const Canvas& above, gl::Extent window) {
    constexpr float kEdge = 7.0f;
    const ImVec2 begin = ImGui::GetCursorPos();
    ImGui::SetCursorPos(ImVec2(0.0f, 0.0f));
    ImGui::InvisibleButton(
        "edge", ImVec2(static_cast<float>(above.width), kEdge * static_cast<float>(scale_)));
    const bool is_held = ImGui::IsItemActive();
    if (is_held || ImGui::IsItemHovered()) {
        const ImVec2 corner = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(
            corner, ImVec2(end.x, corner.y + 2.0f * static_cast<float>(scale_)),
            ImGui::GetColorU32(ImGuiCol_ButtonActive));
    }
    ImGui::SetCursorPos(begin);
    if (!is_held) return;
    const double wanted = (window.height - ImGui::GetIO().MousePos.y) / scale_;
    height_ = std::clamp(wanted, kMinHeight, std::max(kMinHeight, 0.8 * window.height / scale_));
}

void ConsoleView::clear(PanelContent& content) {
    content.lines.clear();
    places_.clear();
    lines_drawn_ = 0;
}

void ConsoleView::draw_lines(const std::vector<ConsoleLine>& lines, PanelAnswers& answers,
                             bool is_dark, PanelInput& input) {
    const std::size_t count = lines.size();
    find_places(lines);
    for (std::size_t i = count - std::min(count, kShownLines); i < count; ++i) {
        draw_line(lines[i], places_[i], answers, is_dark);
    }
    if (lines_drawn_ != count) {
        ImGui::SetScrollHereY(1.0f);
        input.owe();
    }
    lines_drawn_ = count;
}

void ConsoleView::draw(PanelContent& content, PanelAnswers& answers, gl::Extent window,
                       const Canvas& above, bool is_dark, PanelInput& input) {
    ImGui::SetNextWindowPos(ImVec2(static_cast<float>(above.x), static_cast<float>(above.height)));
    ImGui::SetNextWindowSize(
        ImVec2(static_cast<float>(above.width), static_cast<float>(window.height - above.height)));
    ImGui::Begin("console", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    drag_edge(above, window);
    draw_left(content, answers);
    const float room = ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("lines", ImVec2(0.0f, -room));
    draw_lines(content.lines, answers, is_dark, input);
    ImGui::EndChild();
    const float width = ImGui::CalcTextSize("clear").x + 2.0f * ImGui::GetStyle().FramePadding.x +
                        ImGui::GetStyle().ItemSpacing.x;
    prompt_.draw(content, answers, width);
    const ImVec2 corner = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
    ImGui::SameLine();
    if (ImGui::Button("clear")) clear(content);
    ImGui::End();
    prompt_.draw_candidates(corner.x, corner.y, end.x - corner.x);
}

}  // namespace lissom::window
