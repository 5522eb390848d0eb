#include "viewer/window/panel/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/window/panel/boundary_pick.h"
#include "viewer/window/panel/console_view.h"
#include "viewer/window/panel/panel_input.h"
#include "viewer/window/panel/panel_style.h"
#include "viewer/window/panel/side_view.h"

namespace lissom::window {
namespace {

constexpr double kWidth = 290.0;

}  // namespace

struct Panel::State {
    explicit State(PanelHost given)
        : host(std::move(given)), scale(host.scale), console(host.scale) {}

    PanelHost host;
    double scale;
    DrawnLists lists;
    PanelInput input;
    SideView side;
    ConsoleView console;
    bool is_dark = true;
    // Something of the panel lies over the picture, or is dragged there.
    bool is_over_picture = false;
};

Panel::Panel(PanelHost host) : state_(std::make_unique<State>(std::move(host))) {
    const double scale = state_->scale;
    require(!ImGui::GetCurrentContext(), "there is a panel already");
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
    io.ClipboardUserData = &state_->host;
    io.SetClipboardTextFn = [](void* from, const char* text) {
        const auto& set = static_cast<PanelHost*>(from)->set_clipboard;
        if (set) set(text);
    };
    // ImGui reads the text before it asks again.
    io.GetClipboardTextFn = [](void* from) {
        const auto& get = static_cast<PanelHost*>(from)->clipboard;
        return get ? get() : "";
    };
    load_font(scale);
    set_sizes(scale);
    set_colors(true);
    enter_context();
}

Panel::~Panel() {
    leave_context();
    ImGui::DestroyContext();
}

void Panel::enter_context() {
    ImGui_ImplOpenGL3_Init("#version 330");
}

// Between contexts there is nothing to leave.
void Panel::leave_context() {
    if (ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
}

void Panel::feed(const Input& input) {
    state_->input.feed(input);
}

bool Panel::owes_frame() const {
    return state_->input.owes_frame();
}

// Only lists over the picture, and a slider being dragged, depend on the place of the mouse in the
// last frame.
bool Panel::wants_mouse(const Vec2& at, gl::Extent window) const {
    const Canvas beside = canvas(window);
    const bool inside = at.x() >= beside.x && at.y() < beside.y + beside.height;
    return !inside || (state_->is_over_picture && ImGui::GetIO().WantCaptureMouse);
}

bool Panel::wants_keys() const {
    return ImGui::GetIO().WantTextInput;
}

Canvas Panel::canvas(gl::Extent window) const {
    const int left = static_cast<int>(kWidth * state_->scale);
    const int below = state_->console.height(window);
    return {left, 0, std::max(window.width - left, 1), std::max(window.height - below, 1)};
}

PanelAnswers Panel::make(PanelContent& content, DisplaySettings& settings, gl::Extent window,
                         double seconds) {
    PanelAnswers answers;
    if (state_->is_dark != settings.dark) set_colors(settings.dark);
    state_->is_dark = settings.dark;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(window.width), static_cast<float>(window.height));
    io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.1));
    state_->input.take();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    state_->side.draw(content, settings, answers, window, canvas(window).x);
    state_->console.draw(content, answers, window, canvas(window), state_->is_dark, state_->input);
    const Canvas beside = canvas(window);
    draw_marks(content.tool, {content.camera, content.picture_size, beside, state_->scale});
    draw_boundary_pick(content, answers, beside, state_->scale);
    state_->is_over_picture =
        state_->console.is_over_picture() || ImGui::IsAnyMouseDown() ||
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    ImGui::Render();
    state_->lists.see(*ImGui::GetDrawData(), beside);
    return answers;
}

const DrawnLists& Panel::lists() const {
    return state_->lists;
}

void Panel::draw(PanelPart part) const {
    ImDrawData data = *ImGui::GetDrawData();
    std::vector<ImDrawList*> over = state_->lists.over();
    if (part == PanelPart::over_picture) {
        data.CmdLists = over.data();
        data.CmdListsCount = count_of(over);
    }
    ImGui_ImplOpenGL3_RenderDrawData(&data);
}

}  // namespace lissom::window
