/// key_letter: the letter or digit of a key under the keyboard's layout, by which shortcuts go.
#pragma once

#include <functional>
#include <string>

namespace lissom::window {

/// Returns the capital letter or the digit of a key; 0 if it has none.
///
/// `code` is the key by its place on a US keyboard, as GLFW numbers them ('A', '1', ...), and
/// `name_of` returns the text in UTF-8 that the layout gives a key without modifiers. Digits above
/// the letters keep their place if the layout wants shift for them (AZERTY), and digits of the
/// number pad count as digits. A letter that no key of the layout gives (Cyrillic, Greek) keeps its
/// place on the US keyboard.
char32_t key_letter(int code, const std::function<std::string(int)>& name_of);

}  // namespace lissom::window
