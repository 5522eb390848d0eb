#include "bindings/cli/repl/session_text.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace lissom::cli {
namespace {

struct SessionToken {
    std::size_t begin = 0, end = 0;
    std::string_view text;
};

bool is_name_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Returns the position behind the long bracket that opens at `at`, or `at` if none does.
std::size_t after_long_bracket(std::string_view text, std::size_t at) {
    if (at >= text.size() || text[at] != '[') return at;
    const std::size_t open = std::min(text.find_first_not_of('=', at + 1), text.size());
    if (open == text.size() || text[open] != '[') return at;
    const std::string close = "]" + std::string(open - at - 1, '=') + "]";
    const std::size_t found = text.find(close, open);
    return found == std::string_view::npos ? text.size() : found + close.size();
}

std::size_t after_comment(std::string_view text, std::size_t at) {
    const std::size_t end = after_long_bracket(text, at + 2);
    return end > at + 2 ? end : std::min(text.find('\n', at), text.size());
}

std::size_t after_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    for (++at; at < text.size() && text[at] != quote; ++at) at += text[at] == '\\' ? 1 : 0;
    return std::min(at + 1, text.size());
}

std::size_t after_token(std::string_view text, std::size_t at) {
    if (text[at] == '"' || text[at] == '\'') return after_string(text, at);
    const std::size_t bracket = after_long_bracket(text, at);
    if (bracket > at) return bracket;
    if (text.substr(at, 2) == "==") return at + 2;
    std::size_t end = at + 1;
    while (is_name_part(text[at]) && end < text.size() && is_name_part(text[end])) ++end;
    return end;
}

std::vector<SessionToken> tokens_of(std::string_view text) {
    std::vector<SessionToken> tokens;
    for (std::size_t at = 0; at < text.size();) {
        if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
            ++at;
        } else if (text.substr(at, 2) == "--") {
            at = after_comment(text, at);
        } else {
            const std::size_t end = after_token(text, at);
            tokens.push_back({at, end, text.substr(at, end - at)});
            at = end;
        }
    }
    return tokens;
}

// How a token changes the depth of blocks and brackets. `do` ends the head of a loop, whose depth
// `for` and `while` have counted.
int depth_change(const SessionToken& token, bool& in_head) {
    const auto is_one = [&](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), token.text) != words.end();
    };
    if (is_one({"for", "while"})) {
        in_head = true;
        return 1;
    }
    if (token.text == "do" && std::exchange(in_head, false)) return 0;
    if (is_one({"function", "if", "do", "repeat", "(", "{", "["})) return 1;
    return is_one({"end", "until", ")", "}", "]"}) ? -1 : 0;
}

// Replacement of a `local` statement up to its `=`, or of its whole head.
struct Change {
    std::size_t begin, end;
    std::string text;
};

// The change for the `local` at tokens[i].
std::vector<Change> changes_of(const std::vector<SessionToken>& tokens, std::size_t i) {
    const auto text_at = [&](std::size_t k) {
        return k < tokens.size() ? tokens[k].text : std::string_view();
    };
    std::vector<Change> changes{{tokens[i].begin, tokens[i].end, ";"}};
    if (text_at(i + 1) == "function") return changes;
    std::size_t k = i + 1;
    while (true) {
        if (text_at(++k) == "<") {
            if (text_at(k + 1) == "close" || text_at(k + 2) != ">") return {};
            changes.push_back({tokens[k].begin, tokens[k + 2].end, ""});
            k += 3;
        }
        if (text_at(k) != ",") break;
        ++k;
    }
    const std::size_t last = tokens[std::min(k, tokens.size()) - 1].end;
    if (text_at(k) != "=") changes.push_back({last, last, " = nil"});
    return changes;
}

}  // namespace

std::string with_session_variables(std::string_view chunk) {
    const std::vector<SessionToken> tokens = tokens_of(chunk);
    std::string result;
    std::size_t copied = 0;
    int depth = 0;
    bool in_head = false;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        depth += depth_change(tokens[i], in_head);
        if (depth != 0 || tokens[i].text != "local") continue;
        for (const Change& change : changes_of(tokens, i)) {
            result += std::string(chunk.substr(copied, change.begin - copied)) + change.text;
            copied = change.end;
        }
    }
    return result + std::string(chunk.substr(copied));
}

}  // namespace lissom::cli
