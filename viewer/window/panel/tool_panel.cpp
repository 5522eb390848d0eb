#include "viewer/window/panel/tool_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "viewer/window/panel/parameter_widgets.h"
#include "viewer/window/session/player.h"

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

// Draws a button strongly if it is `down`.
bool tool_button(const char* label, float width, bool down) {
    if (down) {
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    }
    const bool pressed = ImGui::Button(label, ImVec2(width, 0.0f));
    if (down) ImGui::PopStyleColor();
    return pressed;
}

// The arrow of a hand that is played; filled while a button is down.
void draw_arrow(ImDrawList& list, const ImVec2& tip, bool is_down) {
    constexpr std::array<std::pair<float, float>, 4> kCorners{
        {{0.0f, 0.0f}, {0.0f, 18.0f}, {5.0f, 13.5f}, {12.5f, 12.5f}}};
    std::array<ImVec2, kCorners.size()> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = ImVec2(tip.x + kCorners[i].first, tip.y + kCorners[i].second);
    }
    const ImU32 color = is_down ? IM_COL32(255, 160, 40, 255) : IM_COL32(255, 255, 255, 255);
    list.AddTriangleFilled(points[0], points[1], points[2], color);
    list.AddTriangleFilled(points[0], points[2], points[3], color);
    list.AddPolyline(points.data(), count_of(points), IM_COL32(0, 0, 0, 220), ImDrawFlags_Closed,
                     1.5f);
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

ToolButton button_of(const std::string& word) {
    return {word, std::filesystem::path(word).stem().string()};
}

void keep_button(std::vector<ToolButton>& buttons, const std::string& word,
                 const std::string& name) {
    const auto found = std::find_if(buttons.begin(), buttons.end(),
                                    [&](const ToolButton& one) { return one.word == word; });
    if (found != buttons.end()) {
        found->label = name;
    } else {
        buttons.push_back({word, name});
    }
}

void keep_button(std::vector<ToolButton>& buttons, const ToolState& state) {
    if (!state.word.empty()) keep_button(buttons, state.word, state.tool);
}

ToolAnswers draw_tools(const std::vector<ToolButton>& buttons, ToolState& state,
                       const PickerContent& pickers) {
    ToolAnswers answers;
    const float width = width_of_button();
    if (tool_button("turn", width, state.tool.empty())) answers.tool = "";
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("No tool: the left button turns the picture");
    std::size_t place = 1;
    for (const ToolButton& button : buttons) {
        if (place++ % kColumns != 0) ImGui::SameLine();
        ImGui::PushID(button.word.c_str());
        if (tool_button(button.label.c_str(), width, button.word == state.word)) {
            answers.tool = button.word;
        }
        if (button.word.ends_with(".lua") && ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", button.word.c_str());
        }
        ImGui::PopID();
    }
    if (!state.prompt.empty()) ImGui::TextWrapped("%s", state.prompt.c_str());
    answers.parameter = draw_parameters(state.parameters, pickers);
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

// Returns a translucent colour.
ImU32 faint(const Color& color, double opacity) {
    return (packed(color) & ~IM_COL32_A_MASK) |
           (static_cast<ImU32>(255.0 * std::clamp(opacity, 0.0, 1.0)) << IM_COL32_A_SHIFT);
}

// Returns the start of a text of this extent so that all of it is in the picture, beside its place.
ImVec2 inside(const ImVec2& at, const ImVec2& extent, const ImVec2& corner, const ImVec2& end) {
    constexpr float kGap = 4.0f;
    const auto moved = [&](float from, float length, float low, float high) {
        return std::max(low + kGap, std::min(from, high - kGap - length));
    };
    return ImVec2(moved(at.x, extent.x, corner.x, end.x), moved(at.y, extent.y, corner.y, end.y));
}

// Widest line of a label: in heights of a line, and of the picture.
constexpr float kLabelWidth = 30.0f, kLabelShare = 0.5f;

// Draws a label beside a pixel, inside the picture between two corners; longer lines are wrapped.
void draw_label(const ToolLabel& label, const ImVec2& beside, const ImVec2& corner,
                const ImVec2& end, ImDrawList& list) {
    const float line = ImGui::GetFontSize();
    const float widest = std::min(kLabelWidth * line, kLabelShare * (end.x - corner.x));
    const char* const text = label.text.c_str();
    const ImVec2 extent = ImGui::CalcTextSize(text, nullptr, false, widest);
    const ImVec2 p = inside(beside, extent, corner, end);
    list.AddRectFilled(ImVec2(p.x - 4.0f, p.y - 2.0f),
                       ImVec2(p.x + extent.x + 4.0f, p.y + extent.y + 2.0f),
                       IM_COL32(24, 26, 30, 200), 3.0f);
    list.AddText(ImGui::GetFont(), line, p, packed(label.color), text, nullptr, widest);
}

// Quads are drawn without soft borders, which would show between them.
void draw_surface(const ToolSurface& surface, const Camera& camera, const PictureSize& size,
                  const ImVec2& corner, ImDrawList& list) {
    const auto seen = [&](const Vec3& point) {
        const Vec3 pixel = camera.project(point, size);
        return ImVec2(corner.x + static_cast<float>(pixel.x()),
                      corner.y + static_cast<float>(pixel.y()));
    };
    const auto in_front = [&](std::size_t i) {
        return camera.to_camera(surface.from[i]).z() > 0.0 &&
               camera.to_camera(surface.to[i]).z() > 0.0;
    };
    const ImU32 color = faint(surface.color, surface.opacity);
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (std::size_t i = 0; i + 1 < std::min(surface.from.size(), surface.to.size()); ++i) {
        if (!in_front(i) || !in_front(i + 1)) continue;
        list.AddQuadFilled(seen(surface.from[i]), seen(surface.from[i + 1]),
                           seen(surface.to[i + 1]), seen(surface.to[i]), color);
    }
    list.Flags = flags;
}

void draw_marks(const ToolState& state, const MarkedPicture& picture) {
    const auto& [camera, size, canvas, scale] = picture;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 corner(static_cast<float>(canvas.x), static_cast<float>(canvas.y));
    const ImVec2 end(corner.x + static_cast<float>(size.width),
                     corner.y + static_cast<float>(size.height));
    const auto place = [&](double x, double y) {
        return ImVec2(corner.x + static_cast<float>(x), corner.y + static_cast<float>(y));
    };
    PictureFit fit({size.width / scale, size.height / scale}, size);
    if (state.hand) {
        fit = PictureFit({1.0 * state.hand->size.width, 1.0 * state.hand->size.height}, size);
    }
    list->PushClipRect(corner, end);
    for (const ToolSurface& surface : state.marks.surfaces) {
        draw_surface(surface, camera, size, corner, *list);
    }
    for (const ToolOutline& outline : state.marks.outlines) {
        std::vector<ImVec2> points;
        for (const Vec2& pixel : outline.pixels) {
            const Vec2 p = fit(pixel);
            points.push_back(place(p.x(), p.y()));
        }
        list->AddPolyline(points.data(), count_of(points), faint(outline.color, outline.opacity),
                          outline.closed ? ImDrawFlags_Closed : ImDrawFlags_None,
                          static_cast<float>(scale * outline.width));
    }
    for (const ToolLabel& label : state.marks.labels) {
        const Vec3 at = camera.project(label.at, size);
        if (!(at.z() > 0.0) || !at.allFinite()) continue;
        draw_label(label, place(at.x() + 8.0, at.y() - 8.0), corner, end, *list);
    }
    if (state.hand) {
        const Vec2 p = fit(state.hand->at);
        draw_arrow(*list, place(p.x(), p.y()), state.hand->is_down);
    }
    list->PopClipRect();
}

}  // namespace lissom::window
