/// text_history: what a text field of Dear ImGui would take back with Ctrl-Z.
#pragma once

namespace lissom::window {

/// To be called before a text field of this label that begins with `text`. The field remembers what
/// was typed into it also while nobody types; where its text was changed from outside since then,
/// that fits no more, and taking it back would leave a text that is shorter than nothing: it is
/// forgotten.
void forget_unfit_history(const char* label, const char* text);

/// Forgets what was typed into the field that is in use: for callbacks that replace its text.
void forget_history_in_use();

}  // namespace lissom::window
