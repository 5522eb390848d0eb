#include "bindings/lua/sandbox/pattern.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>

namespace lissom::lua {
namespace {

// The depth of Lua's own matcher.
constexpr int kMaximumDepth = 200;

unsigned char byte_of(char c) {
    return static_cast<unsigned char>(c);
}

// Whether `c` is of the class that `letter` names behind '%'; other characters name themselves.
bool is_of_class(unsigned char c, unsigned char letter) {
    bool is = false;
    switch (std::tolower(letter)) {
        case 'a':
            is = std::isalpha(c);
            break;
        case 'c':
            is = std::iscntrl(c);
            break;
        case 'd':
            is = std::isdigit(c);
            break;
        case 'g':
            is = std::isgraph(c);
            break;
        case 'l':
            is = std::islower(c);
            break;
        case 'p':
            is = std::ispunct(c);
            break;
        case 's':
            is = std::isspace(c);
            break;
        case 'u':
            is = std::isupper(c);
            break;
        case 'w':
            is = std::isalnum(c);
            break;
        case 'x':
            is = std::isxdigit(c);
            break;
        default:
            return letter == c;
    }
    return std::isupper(letter) ? !is : is;
}

}  // namespace

std::size_t Matcher::match_at(std::size_t begin) {
    count_ = 0;
    depth_ = 0;
    return match(begin, 0);
}

const Capture& Matcher::capture(int i) const {
    if (captures_[i].length == Capture::kOpen) throw PatternError("unfinished capture");
    return captures_[i];
}

std::size_t Matcher::match(std::size_t s, std::size_t p) {
    if (depth_ == kMaximumDepth) throw PatternError("pattern too complex");
    ++depth_;
    std::optional<std::size_t> end;
    while (!end) {
        stop_.tick(ticks_);
        end = step(s, p);
    }
    --depth_;
    return *end;
}

// Takes one item of the pattern. Returns the end of the match, or kNone, once that is known; if
// not, moves `s` and `p` past the item.
std::optional<std::size_t> Matcher::step(std::size_t& s, std::size_t& p) {
    if (p == pattern_.size()) return s;
    const char next = p + 1 < pattern_.size() ? pattern_[p + 1] : '\0';
    switch (pattern_[p]) {
        case '(':
            return next == ')' ? open(s, p + 2, Capture::kPosition)
                               : open(s, p + 1, Capture::kOpen);
        case ')':
            return close(s, p + 1);
        case '$':
            if (p + 1 == pattern_.size()) return s == text_.size() ? s : kNone;
            break;
        case '%':
            if (next == 'f') return step_frontier(s, p);
            if (next == 'b' || std::isdigit(byte_of(next))) return step_part(s, p, next);
            break;
        default:
            break;
    }
    return step_characters(s, p);
}

// "%f[set]"
std::optional<std::size_t> Matcher::step_frontier(std::size_t s, std::size_t& p) const {
    p += 2;
    if (p >= pattern_.size() || pattern_[p] != '[') {
        throw PatternError("missing '[' after '%f' in pattern");
    }
    if (!at_frontier(s, p)) return kNone;
    p = set_end(p);
    return std::nullopt;
}

// "%bxy", or an earlier capture again: "%1".
std::optional<std::size_t> Matcher::step_part(std::size_t& s, std::size_t& p, char kind) const {
    s = kind == 'b' ? balanced(s, p + 2) : repeated(s, kind);
    p += kind == 'b' ? 4 : 2;
    return s == kNone ? std::optional(kNone) : std::nullopt;
}

// A character or a class, with the suffix that says how many times it stands.
std::optional<std::size_t> Matcher::step_characters(std::size_t& s, std::size_t& p) {
    const std::size_t after = item_end(p);
    tick(after - p);
    const char suffix = after < pattern_.size() ? pattern_[after] : '\0';
    if (suffix == '*' || suffix == '+') return longest(s, p, after, suffix == '+');
    if (suffix == '-') return shortest(s, p, after);
    const bool fit = fits(s, p, after);
    if (suffix == '?') {
        const std::size_t end = fit ? match(s + 1, after + 1) : kNone;
        if (end != kNone) return end;
        p = after + 1;
        return std::nullopt;
    }
    if (!fit) return kNone;
    ++s;
    p = after;
    return std::nullopt;
}

std::size_t Matcher::open(std::size_t s, std::size_t p, std::size_t length) {
    if (count_ == kMaximumCaptures) throw PatternError("too many captures");
    captures_[count_++] = {s, length};
    const std::size_t end = match(s, p);
    if (end == kNone) --count_;
    return end;
}

std::size_t Matcher::close(std::size_t s, std::size_t p) {
    int last = count_ - 1;
    while (last >= 0 && captures_[last].length != Capture::kOpen) --last;
    if (last < 0) throw PatternError("invalid pattern capture");
    captures_[last].length = s - captures_[last].begin;
    const std::size_t end = match(s, p);
    if (end == kNone) captures_[last].length = Capture::kOpen;
    return end;
}

// Behind the text that begins with pattern_[p] at `s` and ends with the pattern_[p + 1] that
// belongs to it.
std::size_t Matcher::balanced(std::size_t s, std::size_t p) const {
    if (p + 1 >= pattern_.size())
        throw PatternError("malformed pattern (missing arguments to '%b')");
    if (s >= text_.size() || text_[s] != pattern_[p]) return kNone;
    unsigned ticks = 0;
    std::size_t inside = 1;
    for (std::size_t i = s + 1; i < text_.size(); ++i) {
        stop_.tick(ticks);
        if (text_[i] == pattern_[p + 1]) {
            if (--inside == 0) return i + 1;
        } else if (text_[i] == pattern_[p]) {
            ++inside;
        }
    }
    return kNone;
}

bool Matcher::at_frontier(std::size_t s, std::size_t set) const {
    const std::size_t end = set_end(set);
    const char before = s == 0 ? '\0' : text_[s - 1], here = s < text_.size() ? text_[s] : '\0';
    return !is_in_set(byte_of(before), set, end) && is_in_set(byte_of(here), set, end);
}

// End of the text of an earlier capture, if it stands at `s` again.
std::size_t Matcher::repeated(std::size_t s, char digit) const {
    const int i = digit - '1';
    if (i < 0 || i >= count_ || captures_[i].length == Capture::kOpen) {
        throw PatternError("invalid capture index %" + std::to_string(i + 1));
    }
    // A position is no text, which stands nowhere.
    if (captures_[i].length == Capture::kPosition) return kNone;
    const std::string_view part = text_.substr(captures_[i].begin, captures_[i].length);
    return text_.substr(s).starts_with(part) ? s + part.size() : kNone;
}

// Takes as many of the item as there are, and fewer if the rest does not match behind them.
std::size_t Matcher::longest(std::size_t s, std::size_t p, std::size_t after, bool once) {
    std::size_t count = 0;
    while (fits(s + count, p, after)) ++count;
    for (std::size_t i = count + 1; i-- > (once ? 1u : 0u);) {
        const std::size_t end = match(s + i, after + 1);
        if (end != kNone) return end;
    }
    return kNone;
}

std::size_t Matcher::shortest(std::size_t s, std::size_t p, std::size_t after) {
    while (true) {
        const std::size_t end = match(s, after + 1);
        if (end != kNone) return end;
        if (!fits(s, p, after)) return kNone;
        ++s;
    }
}

std::size_t Matcher::item_end(std::size_t p) const {
    if (pattern_[p] == '[') return set_end(p);
    if (pattern_[p] != '%') return p + 1;
    if (p + 1 == pattern_.size()) throw PatternError("malformed pattern (ends with '%')");
    return p + 2;
}

// Behind the ']' of the set that begins at `p`; a ']' that comes first is one of the set.
std::size_t Matcher::set_end(std::size_t p) const {
    ++p;
    if (p < pattern_.size() && pattern_[p] == '^') ++p;
    for (bool first = true; first || p >= pattern_.size() || pattern_[p] != ']'; first = false) {
        if (p >= pattern_.size()) throw PatternError("malformed pattern (missing ']')");
        p += pattern_[p] == '%' ? 2 : 1;
    }
    return p + 1;
}

// Sets may be as long as the text.
void Matcher::tick(std::size_t characters) {
    stop_.tick(ticks_, static_cast<unsigned>(std::min<std::size_t>(characters, kLongest)));
}

bool Matcher::fits(std::size_t s, std::size_t p, std::size_t after) {
    tick(after - p);
    if (s >= text_.size()) return false;
    const unsigned char c = byte_of(text_[s]);
    switch (pattern_[p]) {
        case '.':
            return true;
        case '%':
            return is_of_class(c, byte_of(pattern_[p + 1]));
        case '[':
            return is_in_set(c, p, after);
        default:
            return byte_of(pattern_[p]) == c;
    }
}

bool Matcher::is_in_set(unsigned char c, std::size_t p, std::size_t end) const {
    const std::size_t last = end - 1;
    const bool is_negated = pattern_[p + 1] == '^';
    p += is_negated ? 2 : 1;
    while (p < last) {
        if (pattern_[p] == '%') {
            if (is_of_class(c, byte_of(pattern_[p + 1]))) return !is_negated;
            p += 2;
        } else if (p + 2 < last && pattern_[p + 1] == '-') {
            if (byte_of(pattern_[p]) <= c && c <= byte_of(pattern_[p + 2])) return !is_negated;
            p += 3;
        } else {
            if (byte_of(pattern_[p]) == c) return !is_negated;
            ++p;
        }
    }
    return is_negated;
}

bool is_plain(std::string_view pattern) {
    return pattern.find_first_of("^$*+?.([%-") == std::string_view::npos;
}

std::size_t find_plain(std::string_view text, std::string_view part, std::size_t begin,
                       const Stop& stop) {
    if (part.empty()) return begin;
    unsigned ticks = 0;
    while (begin + part.size() <= text.size()) {
        const void* at =
            std::memchr(text.data() + begin, part[0], text.size() - part.size() + 1 - begin);
        if (!at) return Matcher::kNone;
        begin = static_cast<std::size_t>(static_cast<const char*>(at) - text.data());
        if (text.substr(begin, part.size()) == part) return begin;
        stop.tick(ticks, 1 + static_cast<unsigned>(std::min<std::size_t>(part.size() / 64, 4096)));
        ++begin;
    }
    return Matcher::kNone;
}

}  // namespace lissom::lua
