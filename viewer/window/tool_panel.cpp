#include "viewer/window/tool_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/window/parameter_widgets.h"

namespace lissom::window {
namespace {

constexpr std::size_t kColumns = 3;
// Steps that are in sight at once.
constexpr float kHistoryLines = 5.0f;

ImU32 packed(const Color& color) {
    const auto byte = [](double value) {
        return static_cast<int>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
    };
    return IM_COL32(byte(color.r), byte(color.g), byte(color.b), 255);
}

float width_of_button() {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    return (ImGui::GetContentRegionAvail().x - (kColumns - 1.0f) * gap) / kColumns;
}

// A button that is drawn strongly where it is `down`.
bool tool_button(const char* label, float width, bool down) {
    if (down) {
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    }
    const bool pressed = ImGui::Button(label, ImVec2(width, 0.0f));
    if (down) ImGui::PopStyleColor();
    return pressed;
}

}  // namespace

ToolAnswers draw_scene_objects(const ToolState& state) {
    ToolAnswers answers;
    for (const ToolObject& object : state.objects) {
        bool visible = object.visible;
        ImGui::PushID(object.name.c_str());
        if (ImGui::Checkbox(object.label.c_str(), &visible)) {
            answers.object = ToolObject{object.name, object.label, visible};
        }
        // A long name reaches beyond the panel.
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", object.label.c_str());
        ImGui::PopID();
    }
    return answers;
}

ToolAnswers draw_tools(const std::vector<std::string>& names, ToolState& state) {
    ToolAnswers answers;
    const float width = width_of_button();
    if (tool_button("turn", width, state.tool.empty())) answers.tool = "";
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("No tool: the left button turns the picture");
    std::size_t place = 1;
    bool is_own = !state.tool.empty();
    for (const std::string& name : names) {
        if (place++ % kColumns != 0) ImGui::SameLine();
        is_own = is_own && name != state.tool;
        if (tool_button(name.c_str(), width, name == state.tool)) answers.tool = name;
    }
    if (is_own) {
        if (place % kColumns != 0) ImGui::SameLine();
        tool_button(state.tool.c_str(), width, true);
    }
    if (!state.prompt.empty()) ImGui::TextWrapped("%s", state.prompt.c_str());
    answers.parameter = draw_parameters(state.parameters);
    return answers;
}

ToolAnswers draw_history(const ToolState& state) {
    ToolAnswers answers;
    if (ImGui::Button("undo")) answers.undo = true;
    ImGui::SameLine();
    if (ImGui::Button("redo")) answers.redo = true;
    const float height = kHistoryLines * ImGui::GetTextLineHeightWithSpacing();
    ImGui::BeginChild("steps", ImVec2(0.0f, height));
    for (std::size_t i = 0; i < state.steps.size(); ++i) {
        if (i < state.place) {
            ImGui::TextUnformatted(state.steps[i].c_str());
        } else {
            ImGui::TextDisabled("%s", state.steps[i].c_str());
        }
        if (i + 1 == state.place) ImGui::SetScrollHereY(1.0f);
    }
    ImGui::EndChild();
    return answers;
}

void draw_marks(const ToolState& state, const Camera& camera, const PictureSize& size,
                const Canvas& canvas) {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 corner(static_cast<float>(canvas.x), static_cast<float>(canvas.y));
    const ImVec2 end(corner.x + static_cast<float>(size.width),
                     corner.y + static_cast<float>(size.height));
    const auto place = [&](double x, double y) {
        return ImVec2(corner.x + static_cast<float>(x), corner.y + static_cast<float>(y));
    };
    list->PushClipRect(corner, end);
    for (const ToolOutline& outline : state.marks.outlines) {
        std::vector<ImVec2> points;
        for (const Vec2& p : outline.pixels) points.push_back(place(p.x(), p.y()));
        list->AddPolyline(points.data(), count_of(points), packed(outline.color),
                          outline.closed ? ImDrawFlags_Closed : ImDrawFlags_None,
                          static_cast<float>(outline.width));
    }
    for (const ToolLabel& label : state.marks.labels) {
        const Vec3 at = camera.project(label.at, size);
        if (!(at.z() > 0.0) || !at.allFinite()) continue;
        const ImVec2 p = place(at.x() + 8.0, at.y() - 8.0);
        list->AddText(ImVec2(p.x + 1.0f, p.y + 1.0f), IM_COL32(0, 0, 0, 180), label.text.c_str());
        list->AddText(p, packed(label.color), label.text.c_str());
    }
    list->PopClipRect();
}

}  // namespace lissom::window
