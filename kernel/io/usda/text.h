/// UsdaText: the tokens of a USD layer in text form; private to kernel/io.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {

/// A position in the text of a layer that moves forward. Blanks, line ends and comments ("#", "//"
/// and "/* */") are passed over between tokens; nesting is bounded.
class UsdaText {
  public:
    enum class Kind { end, word, number, text, punctuation };
    struct Token {
        Kind kind = Kind::end;
        /// Text without its quotes.
        std::string_view value;
        std::size_t line = 0;

        bool is(std::string_view word) const { return kind != Kind::text && value == word; }
    };

    explicit UsdaText(std::string_view text);

    /// Returns the next token, which stays the next, and the same with a move behind it.
    const Token& peek() const { return next_; }
    Token take();
    /// Moves over the next token if it is this word or punctuation.
    bool take(std::string_view word);
    /// Errors: file_syntax, file_truncated if it is another.
    void expect(std::string_view word);

    /// Moves over a value: one token, or brackets with all they hold. Errors: file_syntax for
    /// brackets that do not match or are nested too deep; file_truncated.
    void skip_value();
    /// Reads a value of numbers, in any brackets; none for a value that is blocked ("None").
    /// Errors: as skip_value; file_syntax for other tokens.
    std::vector<double> numbers();
    /// Reads as `numbers` does, into 32 bits, for values that can be large. Errors: also not_finite
    /// naming the line.
    std::vector<float> floats();
    /// Reads a list of texts, or one, with characters escaped by backslashes. Errors: as `numbers`.
    std::vector<std::string> texts();

    FilePlace place() const { return {ElementKind::line, next_.line}; }
    /// Throws file_syntax (file_truncated at the end of the text): something else was expected.
    [[noreturn]] void refuse_token(std::string_view expected) const;
    /// Share of the text that lies behind, 0 to 1.
    double fraction() const;

  private:
    void advance();
    void skip_blanks();
    bool skip_comment();
    void skip_line_rest();
    void skip_block_comment();
    void read_text();
    void read_delimited(char end);
    void read_asset();

    template <typename Visit>
    void visit_value(const Visit& visit);

    const char* begin_;
    const char* at_;
    const char* end_;
    std::size_t line_ = 0;
    Token next_;
};

}  // namespace lissom
