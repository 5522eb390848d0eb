#include "viewer/window/screen/key_letter.h"

namespace lissom::window {
namespace {

// GLFW's numbers of the keys that may type a letter, and of the digits of the number pad.
constexpr int kFirstKey = 39, kLastKey = 162, kFirstPad = 320, kLastPad = 329;

bool is_between(int code, int first, int last) {
    return code >= first && code <= last;
}

// The capital letter that a name consists of; 0 if it is anything else.
char32_t latin_letter(const std::string& name) {
    if (name.size() != 1) return 0;
    const char c = name[0];
    if (is_between(c, 'a', 'z')) return static_cast<char32_t>(c - 'a' + 'A');
    return is_between(c, 'A', 'Z') ? static_cast<char32_t>(c) : 0;
}

bool has_letter(char32_t letter, const std::function<std::string(int)>& name_of) {
    for (int code = kFirstKey; code <= kLastKey; ++code) {
        if (latin_letter(name_of(code)) == letter) return true;
    }
    return false;
}

}  // namespace

char32_t key_letter(int code, const std::function<std::string(int)>& name_of) {
    if (is_between(code, kFirstPad, kLastPad))
        return static_cast<char32_t>(U'0' + code - kFirstPad);
    if (!is_between(code, kFirstKey, kLastKey)) return 0;
    if (const char32_t letter = latin_letter(name_of(code))) return letter;
    const auto own = static_cast<char32_t>(code);
    if (is_between(code, '0', '9')) return own;
    return is_between(code, 'A', 'Z') && !has_letter(own, name_of) ? own : 0;
}

}  // namespace lissom::window
