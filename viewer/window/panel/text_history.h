/// text_history: history of a text field of Dear ImGui for Ctrl-Z.
#pragma once

namespace lissom::window {

/// To be called before a text field of this label that begins with `text`. The field remembers its
/// typed text also while nobody types; if its text was changed from outside since then, that no
/// longer fits, and undoing it would leave a text of negative length: it is forgotten.
void forget_unfit_history(const char* label, const char* text);

/// Forgets the typed history of the field in use: for callbacks that replace its text.
void forget_history_in_use();

}  // namespace lissom::window
