#include "viewer/window/panel/panel_style.h"

#include <imgui.h>

#include <array>
#include <filesystem>

namespace lissom::window {
namespace {

constexpr double kTextHeight = 15.0;

constexpr std::array kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                            "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                            "/usr/share/fonts/TTF/DejaVuSans.ttf"};

ImVec4 color_of(LineKind kind, bool dark) {
    switch (kind) {
        case LineKind::error:
            return dark ? ImVec4(1.0f, 0.48f, 0.42f, 1.0f) : ImVec4(0.75f, 0.1f, 0.05f, 1.0f);
        case LineKind::warning:
            return dark ? ImVec4(0.95f, 0.78f, 0.4f, 1.0f) : ImVec4(0.6f, 0.4f, 0.0f, 1.0f);
        case LineKind::input:
            return dark ? ImVec4(0.55f, 0.72f, 1.0f, 1.0f) : ImVec4(0.15f, 0.35f, 0.7f, 1.0f);
        default:
            return ImGui::GetStyle().Colors[ImGuiCol_Text];
    }
}

}  // namespace

void load_font(double scale) {
    ImGuiIO& io = ImGui::GetIO();
    std::error_code error;
    for (const char* path : kFonts) {
        if (!std::filesystem::exists(path, error)) continue;
        io.Fonts->AddFontFromFileTTF(path, static_cast<float>(kTextHeight * scale));
        return;
    }
    io.FontGlobalScale = static_cast<float>(scale);
}

void set_colors(bool dark) {
    ImGuiStyle& style = ImGui::GetStyle();
    if (dark) {
        ImGui::StyleColorsDark(&style);
    } else {
        ImGui::StyleColorsLight(&style);
    }
    const ImVec4 accent(0.36f, 0.52f, 0.78f, 1.0f);
    const auto faded = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    style.Colors[ImGuiCol_WindowBg] =
        dark ? ImVec4(0.125f, 0.13f, 0.145f, 1.0f) : ImVec4(0.97f, 0.97f, 0.975f, 1.0f);
    style.Colors[ImGuiCol_PopupBg] =
        dark ? ImVec4(0.16f, 0.165f, 0.185f, 1.0f) : ImVec4(1.0f, 1.0f, 1.0f, 1.0f);
    style.Colors[ImGuiCol_FrameBg] =
        dark ? ImVec4(0.21f, 0.22f, 0.245f, 1.0f) : ImVec4(0.88f, 0.885f, 0.9f, 1.0f);
    style.Colors[ImGuiCol_Header] = faded(0.30f);
    style.Colors[ImGuiCol_HeaderHovered] = faded(0.45f);
    style.Colors[ImGuiCol_HeaderActive] = faded(0.6f);
    style.Colors[ImGuiCol_Button] = faded(0.35f);
    style.Colors[ImGuiCol_ButtonHovered] = faded(0.6f);
    style.Colors[ImGuiCol_ButtonActive] = faded(0.8f);
    style.Colors[ImGuiCol_PlotHistogram] = faded(0.8f);
    style.Colors[ImGuiCol_SliderGrab] = faded(0.9f);
    style.Colors[ImGuiCol_SliderGrabActive] = accent;
    style.Colors[ImGuiCol_CheckMark] = dark ? ImVec4(0.55f, 0.72f, 1.0f, 1.0f) : accent;
}

void set_sizes(double scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.ItemSpacing = ImVec2(7.0f, 5.0f);
    style.WindowPadding = ImVec2(12.0f, 10.0f);
    style.ScaleAllSizes(static_cast<float>(scale));
}

void push_line_color(LineKind kind, bool dark) {
    ImGui::PushStyleColor(ImGuiCol_Text, color_of(kind, dark));
}

}  // namespace lissom::window
