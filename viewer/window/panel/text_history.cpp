#include "viewer/window/panel/text_history.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <cstring>

namespace lissom::window {
namespace {

void forget(ImGuiInputTextState& state) {
    auto& undo = state.Stb.undostate;
    undo.undo_point = 0;
    undo.undo_char_point = 0;
    undo.redo_point = STB_TEXTEDIT_UNDOSTATECOUNT;
    undo.redo_char_point = STB_TEXTEDIT_UNDOCHARCOUNT;
}

}  // namespace

void forget_unfit_history(const char* label, const char* text) {
    ImGuiInputTextState* const state = ImGui::GetInputTextState(ImGui::GetID(label));
    if (!state || state->TextA.empty()) return;
    if (std::strcmp(state->TextA.Data, text) != 0) forget(*state);
}

void forget_history_in_use() {
    forget(ImGui::GetCurrentContext()->InputTextState);
}

}  // namespace lissom::window
