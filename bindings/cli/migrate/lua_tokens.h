/// Lua source as a list of tokens with their places.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace lissom::cli {

enum class TokenKind { name, string, number, symbol };

/// A piece of Lua source: bytes [begin, end) of the text, in a line from 1.
struct Token {
    TokenKind kind;
    std::size_t begin, end;
    int line;
};

/// A Lua script as tokens; comments and space are left out. Of a Markdown text only the blocks
/// that begin with ```lua are read.
class LuaTokens {
  public:
    /// The text must outlive this object.
    explicit LuaTokens(std::string_view text, bool markdown = false);

    std::size_t size() const { return tokens_.size(); }
    const Token& operator[](std::size_t i) const { return tokens_[i]; }
    /// The text of token `i`; "" behind the last one.
    std::string_view text(std::size_t i) const;
    bool is(std::size_t i, std::string_view word) const { return text(i) == word; }
    /// Returns whether token `i` is a name and no keyword.
    bool is_name(std::size_t i) const;
    bool is_string(std::size_t i) const;
    /// The bracket that belongs to the bracket at `i`; size() if there is none.
    std::size_t match(std::size_t i) const { return match_[i]; }
    /// The line, from 1, of byte `at`.
    int line_of(std::size_t at) const;

  private:
    void read(std::size_t begin, std::size_t end);
    std::size_t read_token(std::size_t at, std::size_t end);
    std::size_t skip_comment(std::size_t at, std::size_t end) const;
    std::size_t string_end(std::size_t at, std::size_t end) const;
    std::size_t long_end(std::size_t at, std::size_t end) const;
    void add(TokenKind kind, std::size_t begin, std::size_t end);
    void find_matches();

    std::string_view text_;
    std::vector<Token> tokens_;
    std::vector<std::size_t> match_, line_starts_;
};

}  // namespace lissom::cli
