#include "viewer/window/panel/side_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "viewer/window/panel/parameter_widgets.h"
#include "viewer/window/panel/text_history.h"

namespace lissom::window {
namespace {

constexpr std::size_t kLongestText = 1024;

void draw_objects(const std::vector<std::string>& objects, std::vector<bool>& hidden) {
    hidden.resize(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        bool visible = !hidden[i];
        if (ImGui::Checkbox(objects[i].c_str(), &visible)) hidden[i] = !visible;
        // A long name reaches beyond the panel.
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", objects[i].c_str());
        ImGui::PopID();
    }
}

constexpr const char* kKeys =
    "left drag: turn; with a tool: the right button, or alt\n"
    "shift and drag, or the middle button: move\n"
    "wheel: nearer, towards the cursor; with ctrl or in a tool's drag: the tool's\n"
    "Home: the selection, else all; with shift: all\n"
    "without a tool: 1 to 7: sides   O: perspective   F: as Home\n"
    "    W: wire   B: boundaries   U: z up or y up\n"
    "Ctrl-Z, Ctrl-Shift-Z: undo, redo\n"
    "Ctrl-S: save the scene   Ctrl-E: export a mesh or hair   F12: picture\n"
    "F5: run again   Esc: stop, or take back\n"
    "Ctrl-Q: end\n"
    "Files can be dropped on the window.";

void draw_played(const PlayedPart& part) {
    char text[64];
    std::snprintf(text, sizeof text, "%zu of %zu, %.3gx%s", part.done, part.count, part.speed,
                  part.is_paused ? ", paused" : "");
    const float fraction =
        static_cast<float>(part.done) / static_cast<float>(std::max<std::size_t>(part.count, 1));
    ImGui::ProgressBar(fraction, ImVec2(-1.0f, 0.0f), text);
    ImGui::TextWrapped("%s is played. Space: pause, . one event, + and -: speed, Esc: stop",
                       part.name.c_str());
}

void draw_colors(const PanelContent& content, PanelAnswers& answers) {
    if (content.colorings.size() < 2) return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("colours");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##colors", label_of(content.coloring).c_str())) {
        for (std::size_t i = 0; i < content.colorings.size(); ++i) {
            const Coloring& one = content.colorings[i];
            ImGui::PushID(static_cast<int>(i));
            const bool is_chosen = one == content.coloring;
            if (ImGui::Selectable(label_of(one).c_str(), is_chosen)) answers.coloring = one;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    if (!is_distortion(content.coloring)) return;
    if (ImGui::Button("compare with this shape", ImVec2(-1.0f, 0.0f))) {
        answers.compare_with_this = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Until then: the first that was shown.");
}

void draw_view(const PanelContent& content, DisplaySettings& settings, PanelAnswers& answers) {
    constexpr std::array<std::pair<const char*, StandardView>, 7> kViews{
        {{"front", StandardView::front},
         {"back", StandardView::back},
         {"left", StandardView::left},
         {"right", StandardView::right},
         {"top", StandardView::top},
         {"bottom", StandardView::bottom},
         {"3/4", StandardView::three_quarter}}};
    const float width =
        (ImGui::GetContentRegionAvail().x - 3.0f * ImGui::GetStyle().ItemSpacing.x) / 4.0f;
    for (std::size_t i = 0; i < kViews.size(); ++i) {
        if (i % 4 != 0) ImGui::SameLine();
        if (ImGui::Button(kViews[i].first, ImVec2(width, 0.0f))) answers.view = kViews[i].second;
    }
    ImGui::SameLine();
    if (ImGui::Button("all", ImVec2(width, 0.0f))) answers.frame_all = true;
    bool perspective = !content.is_ortho;
    if (ImGui::Checkbox("perspective", &perspective)) answers.toggle_ortho = true;
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("dark", &settings.dark);
    ImGui::Checkbox("wire", &settings.wire);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("flat", &settings.flat);
    ImGui::Checkbox("boundaries", &settings.boundaries);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("sharp", &settings.sharp);
    ImGui::Checkbox("normals", &settings.vertex_normals);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    ImGui::Checkbox("face normals", &settings.face_normals);
    ImGui::Checkbox("see through", &settings.see_through);
    ImGui::SameLine(0.5f * ImGui::GetWindowWidth());
    bool is_z_up = content.is_z_up;
    if (ImGui::Checkbox("z up", &is_z_up)) answers.toggle_up = true;
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("The view turns; meshes keep their coordinates, in files too.");
    }
    draw_colors(content, answers);
}

// A row of a list, for any characters of its text.
bool is_chosen_of_list(const std::string& text, bool is_present) {
    constexpr std::size_t kMost = 40;
    const ImVec2 begin = ImGui::GetCursorPos();
    const std::string shown = text.size() > kMost ? text.substr(0, kMost) + "..." : text;
    const ImVec2 size(ImGui::CalcTextSize(shown.c_str(), shown.c_str() + shown.size()).x, 0.0f);
    const bool chosen = ImGui::Selectable("##row", is_present, 0, size);
    ImGui::SetCursorPos(begin);
    ImGui::TextUnformatted(shown.c_str(), shown.c_str() + shown.size());
    return chosen;
}

// A name for the file, and the button that writes it.
void draw_export(PanelContent& content, PanelAnswers& answers) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float button = ImGui::CalcTextSize("export").x + 2.0f * style.FramePadding.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - style.ItemSpacing.x);
    std::array<char, kLongestText> name{};
    content.export_name.copy(name.data(), name.size() - 1);
    forget_unfit_history("##export", name.data());
    ImGui::InputTextWithHint("##export", "file: .obj .glb .ply .usda", name.data(), name.size());
    content.export_name = name.data();
    ImGui::SameLine();
    if (ImGui::Button("export")) answers.exports = true;
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip(
            "Ctrl-E: writes the mesh with a selection, else the only one to be seen;\n"
            "if the ending is one of hair (.usda .hair .data .rib), the hair");
    }
}

void draw_state(const PanelContent& content, PanelAnswers& answers) {
    if (content.playing) {
        draw_played(*content.playing);
    } else if (content.busy) {
        if (ImGui::Button("stop")) answers.cancel = true;
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(content.fraction), ImVec2(-1.0f, 0.0f),
                           content.stage.c_str());
    } else {
        if (ImGui::Button("run again")) answers.run_again = true;
        ImGui::SameLine();
        if (ImGui::Button("picture")) answers.screenshot = true;
        if (content.tool.has_scene) {
            ImGui::SameLine();
            if (ImGui::Button("save")) answers.save = true;
        }
        ImGui::SameLine();
        if (content.draws_picture) {
            ImGui::TextDisabled("drawing");
        } else {
            ImGui::TextDisabled("%.0f ms", content.milliseconds);
        }
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", content.driver.c_str());
        ImGui::SameLine();
        ImGui::TextDisabled("?");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", kKeys);
    }
}

void draw_tools_section(PanelContent& content, PanelAnswers& answers) {
    if (!content.tool.has_scene) return;
    if (ImGui::CollapsingHeader("Tools", ImGuiTreeNodeFlags_DefaultOpen)) {
        const ToolAnswers asked =
            draw_tools(content.tools, content.tool, {content.picks, content.picking, true});
        answers.tool.tool = asked.tool;
        answers.tool.parameter = asked.parameter;
    }
    if (ImGui::CollapsingHeader("History")) {
        const ToolAnswers asked = draw_history(content.tool);
        answers.tool.undo = asked.undo;
        answers.tool.redo = asked.redo;
    }
}

void draw_objects_section(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers) {
    if (!ImGui::CollapsingHeader("Objects", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (content.tool.has_scene) {
        draw_export(content, answers);
        answers.tool.object = draw_scene_objects(content.tool).object;
    } else {
        draw_objects(content.objects, settings.hidden);
    }
}

}  // namespace

// Draws a list of existing names, a name, and its actions.
void SideView::draw_presets(const std::vector<std::string>& presets, PanelAnswers& answers) {
    ImGui::PushID("presets");
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto width = [&](const char* label) {
        return ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x + style.ItemSpacing.x;
    };
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - width("save") - width("delete") -
                            ImGui::GetFrameHeight() - style.ItemSpacing.x);
    std::array<char, kLongestText> name{};
    preset_.copy(name.data(), name.size() - 1);
    forget_unfit_history("##preset_", name.data());
    ImGui::InputTextWithHint("##preset_", "preset_", name.data(), name.size());
    preset_ = name.data();
    ImGui::SameLine();
    if (ImGui::BeginCombo("##presets", "", ImGuiComboFlags_NoPreview)) {
        for (std::size_t i = 0; i < presets.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (is_chosen_of_list(presets[i], presets[i] == preset_)) {
                answers.load_preset = preset_ = presets[i];
            }
            ImGui::PopID();
        }
        if (presets.empty()) ImGui::TextDisabled("none yet: write a name and save");
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    const bool has_name = preset_.find_first_not_of(' ') != std::string::npos;
    ImGui::BeginDisabled(!has_name);
    if (ImGui::Button("save")) answers.save_preset = preset_;
    ImGui::SameLine();
    if (ImGui::Button("delete")) answers.remove_preset = std::exchange(preset_, {});
    ImGui::EndDisabled();
    ImGui::PopID();
}

void SideView::draw_parameters_section(PanelContent& content, PanelAnswers& answers) {
    if (content.parameters.empty() ||
        !ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    if (content.presets) draw_presets(*content.presets, answers);
    answers.parameters_changed =
        draw_parameters(content.parameters, {content.picks, content.picking}).has_value();
}

void SideView::draw(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
                    gl::Extent window, int width) {
    ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(width), static_cast<float>(window.height)));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    draw_state(content, answers);
    ImGui::Separator();
    ImGui::BeginDisabled(content.playing.has_value());
    if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) {
        draw_view(content, settings, answers);
    }
    draw_parameters_section(content, answers);
    draw_tools_section(content, answers);
    // Last, as it grows: no button moves then.
    draw_objects_section(content, settings, answers);
    ImGui::EndDisabled();
    ImGui::End();
}

}  // namespace lissom::window
