/// Reads words and numbers from text in memory, the same in every locale; private to kernel/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/core/error.h"
#include "kernel/core/index.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {

/// A position in a text that moves forward. Lines end with LF, CR LF or CR; spaces and tabs
/// separate words.
class TextReader {
  public:
    struct Style {
        /// Starts a comment that lasts to the end of the line; NUL for none.
        char comment = '\0';
        /// A backslash at the end of a line joins the next line to it.
        bool continuation = false;
    };

    /// `first_line` is the number of the line that the text begins with.
    TextReader(std::string_view text, Style style, std::size_t first_line = 0)
        : begin_(text.data()),
          end_(begin_ + text.size()),
          at_(begin_),
          line_(first_line),
          style_(style) {}

    /// Tally of the present read, for the error of a text that ends too early.
    Tally tally;

    /// 0-based number of the present line, and the same as a place for errors.
    std::size_t line() const { return line_; }
    FilePlace place() const { return {ElementKind::line, line_}; }
    std::size_t offset() const { return at(at_ - begin_); }
    std::size_t remaining() const { return at(end_ - at_); }
    /// Share of the text that lies behind, 0 to 1.
    double fraction() const {
        return begin_ == end_ ? 1.0 : double(at_ - begin_) / double(end_ - begin_);
    }

    /// Returns the next character, or NUL at the end of the text.
    char peek() const { return at_ == end_ ? '\0' : *at_; }
    /// Moves over the next character if it is `c`.
    bool take(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    /// Skips blanks; true if nothing but a comment is left on the line.
    bool at_line_end();
    /// Skips blanks, comments and line ends; true if nothing is left of the text.
    bool at_end();
    /// Moves to the start of the next line.
    void skip_line();

    /// Returns the next word of the line, empty at its end; comments are part of it.
    std::string_view word();
    /// Returns the rest of the line without the blanks around it; comments are part of it.
    std::string_view rest_of_line();

    /// Returns the next number on the line; also "nan" and "inf". Numbers beyond the range of
    /// double are read as infinity or zero. Errors: file_syntax.
    double number();
    /// Returns the next whole number on the line; beyond 64 bits it is the nearest that fits.
    /// Errors: file_syntax.
    std::int64_t integer();

    /// Read as `number` and `integer` do, on this line or a later one. Errors: file_truncated.
    double next_number();
    std::int64_t next_integer();
    /// Returns the next word on this line or a later one. Errors: file_truncated.
    std::string_view next_word();

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

    void skip_blanks();
    bool skip_line_end();
    bool skip_continuation();
    void skip_plus();
    bool at_word_end() const;
    [[noreturn]] void refuse_word(const char* start, std::string_view expected);

    const char* begin_;
    const char* end_;
    const char* at_;
    std::size_t line_;
    Style style_;
};

}  // namespace lissom
