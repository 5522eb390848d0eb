#include "viewer/window/panel/panel_input.h"

#include <imgui.h>

#include <algorithm>

namespace lissom::window {
namespace {

constexpr int kFramesAfterInput = 2;

// The order of ImGui's own names of keys.
int imgui_key(Key key) {
    switch (key) {
        case Key::tab:
            return ImGuiKey_Tab;
        case Key::left:
            return ImGuiKey_LeftArrow;
        case Key::right:
            return ImGuiKey_RightArrow;
        case Key::up:
            return ImGuiKey_UpArrow;
        case Key::down:
            return ImGuiKey_DownArrow;
        case Key::page_up:
            return ImGuiKey_PageUp;
        case Key::page_down:
            return ImGuiKey_PageDown;
        case Key::home:
            return ImGuiKey_Home;
        case Key::end:
            return ImGuiKey_End;
        case Key::del:
            return ImGuiKey_Delete;
        case Key::backspace:
            return ImGuiKey_Backspace;
        case Key::space:
            return ImGuiKey_Space;
        case Key::enter:
            return ImGuiKey_Enter;
        case Key::escape:
            return ImGuiKey_Escape;
        default:
            return -1;
    }
}

// Letters that ImGui knows as shortcuts.
int imgui_letter(char32_t letter) {
    switch (letter) {
        case U'A':
            return ImGuiKey_A;
        case U'C':
            return ImGuiKey_C;
        case U'V':
            return ImGuiKey_V;
        case U'X':
            return ImGuiKey_X;
        case U'Y':
            return ImGuiKey_Y;
        case U'Z':
            return ImGuiKey_Z;
        default:
            return -1;
    }
}

// Whether the frame may take `input` too: no button or key changes twice in a frame.
bool applies(const Input& input, bool& has_changed) {
    ImGuiIO& io = ImGui::GetIO();
    const bool changes = input.kind != Input::Kind::move && input.kind != Input::Kind::text &&
                         input.kind != Input::Kind::scroll;
    if (changes && has_changed) return false;
    has_changed = has_changed || changes;
    io.KeyShift = input.modifiers.shift;
    io.KeyCtrl = input.modifiers.ctrl;
    io.KeyAlt = input.modifiers.alt;
    const int button = static_cast<int>(input.button);
    switch (input.kind) {
        case Input::Kind::press:
        case Input::Kind::release:
            io.MouseDown[button] = input.kind == Input::Kind::press;
            [[fallthrough]];
        case Input::Kind::move:
            io.MousePos =
                ImVec2(static_cast<float>(input.at.x()), static_cast<float>(input.at.y()));
            break;
        case Input::Kind::scroll:
            io.MouseWheel += static_cast<float>(input.scroll.y());
            io.MouseWheelH += static_cast<float>(input.scroll.x());
            break;
        case Input::Kind::text:
            io.AddInputCharacter(input.character);
            break;
        case Input::Kind::key_down:
        case Input::Kind::key_up: {
            const int key =
                input.key == Key::character ? imgui_letter(input.character) : imgui_key(input.key);
            if (key >= 0) io.KeysDown[key] = input.kind == Input::Kind::key_down;
            break;
        }
        case Input::Kind::drop:
            break;
    }
    return true;
}

}  // namespace

void PanelInput::take() {
    bool has_changed = false;
    frames_owed_ = inputs_.empty() ? std::max(frames_owed_ - 1, 0) : kFramesAfterInput;
    while (!inputs_.empty() && applies(inputs_.front(), has_changed)) inputs_.pop_front();
}

void PanelInput::owe() {
    frames_owed_ = std::max(frames_owed_, 1);
}

}  // namespace lissom::window
