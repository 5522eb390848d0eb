/// A line of text under a cursor, and the widths of characters on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lissom::cli {

/// Returns the cells of UTF-8 text on a terminal: two for wide characters of East Asia and emoji,
/// none for combining ones. Bytes that are no UTF-8 take one each.
std::size_t cells_of(std::string_view text);

/// Begin of the character of `text` that ends before byte `at`, and end of the one that begins
/// there; each with its combining characters.
std::size_t previous_character(std::string_view text, std::size_t at);
std::size_t next_character(std::string_view text, std::size_t at);

/// A line that is edited: a cursor between characters, and the text that was cut last. Words are
/// letters, digits, '_' and everything beyond ASCII.
class EditedLine {
  public:
    const std::string& text() const { return text_; }
    std::size_t cursor() const { return cursor_; }
    std::string_view before() const { return std::string_view(text_).substr(0, cursor_); }

    /// Replaces the text, with the cursor at its end.
    void replace(std::string text);
    void insert(std::string_view text);
    /// Replaces the text between `begin` and the cursor by `text`.
    void replace_before(std::size_t begin, std::string_view text);

    void left();
    void right();
    void to_begin() { cursor_ = 0; }
    void to_end() { cursor_ = text_.size(); }
    void word_left() { cursor_ = word_begin(); }
    void word_right() { cursor_ = word_end(); }

    /// Remove a character, if there is one.
    void erase_before();
    void erase_after();
    /// Exchanges the characters beside the cursor and goes on.
    void transpose();

    /// Cut the text between the cursor and the named place; `paste` puts it back.
    void cut_to_begin() { cut(0, cursor_); }
    void cut_to_end() { cut(cursor_, text_.size()); }
    void cut_word_before() { cut(word_begin(), cursor_); }
    void cut_word_after() { cut(cursor_, word_end()); }
    void paste() { insert(cut_); }

  private:
    std::size_t word_begin() const;
    std::size_t word_end() const;
    void cut(std::size_t begin, std::size_t end);

    std::string text_, cut_;
    std::size_t cursor_ = 0;
};

}  // namespace lissom::cli
