/// The keys of a terminal, from the bytes that it sends.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace lissom::cli {

/// Meaning of a key; `none` for keys without one.
enum class Key {
    none,
    text,
    enter,
    complete,
    end_of_input,
    left,
    right,
    word_left,
    word_right,
    begin,
    end,
    older,
    newer,
    search,
    erase_before,
    erase_after,
    cut_to_begin,
    cut_to_end,
    cut_word_before,
    cut_word_after,
    paste,
    transpose,
    clear_screen,
    leave
};

struct KeyPress {
    Key key = Key::none;
    /// Text of Key::text: one character, in UTF-8.
    std::string text = {};
};

/// Reads one key. `next` returns the next byte, or nothing if none comes soon: an escape that
/// stands alone is Key::leave. The keys are those of Emacs, as at other prompts, and the arrows,
/// Home, End and Delete of terminals like VT100 and xterm, with Ctrl for words.
KeyPress read_key(char first, const std::function<std::optional<char>()>& next);

}  // namespace lissom::cli
