#include "viewer/window/screen/key_letter.h"

#include <doctest/doctest.h>

#include <map>

using namespace lissom::window;

namespace {

// A layout: the US keyboard, but for some keys by their US place.
std::function<std::string(int)> layout(const std::map<char, std::string>& others) {
    return [others](int code) {
        const auto found = others.find(static_cast<char>(code));
        if (found != others.end() && code < 128) return found->second;
        const bool is_letter = code >= 'A' && code <= 'Z';
        const bool is_other = (code >= '0' && code <= '9') || (code >= 39 && code <= 96);
        if (is_letter) return std::string(1, static_cast<char>(code - 'A' + 'a'));
        return is_other ? std::string(1, static_cast<char>(code)) : std::string();
    };
}

}  // namespace

TEST_CASE("key letters: they are those of the layout under us, de and fr") {
    const auto us = layout({});
    for (const char32_t letter : {U'A', U'Q', U'Z', U'1'}) {
        CHECK(key_letter(static_cast<int>(letter), us) == letter);
    }
    const auto de = layout({{'Z', "y"}, {'Y', "z"}, {';', "ö"}, {'[', "ü"}});
    CHECK(key_letter('Y', de) == U'Z');
    CHECK(key_letter('Z', de) == U'Y');
    CHECK(key_letter(';', de) == 0);
    const auto fr = layout({{'Q', "a"},
                            {'A', "q"},
                            {'Z', "w"},
                            {'W', "z"},
                            {';', "m"},
                            {'M', ","},
                            {'1', "&"},
                            {'2', "é"},
                            {'[', ""}});
    CHECK(key_letter('Q', fr) == U'A');
    CHECK(key_letter('A', fr) == U'Q');
    CHECK(key_letter(';', fr) == U'M');
    CHECK(key_letter('M', fr) == 0);
    CHECK(key_letter('1', fr) == U'1');
    CHECK(key_letter('2', fr) == U'2');
    // A dead key.
    CHECK(key_letter('[', fr) == 0);
}

TEST_CASE("key letters: a layout without Latin letters leaves them where US keyboards have them") {
    std::map<char, std::string> names;
    for (char c = 'A'; c <= 'Z'; ++c) names[c] = "я";
    CHECK(key_letter('Z', layout(names)) == U'Z');
    // Not where another key gives it: Ctrl-Q must not end the program under a hand that types é.
    names[';'] = "q";
    CHECK(key_letter('Q', layout(names)) == 0);
    CHECK(key_letter(';', layout(names)) == U'Q');
}

TEST_CASE("key letters: digits of the number pad are digits, other keys are none") {
    const auto us = layout({});
    CHECK(key_letter(320, us) == U'0');
    CHECK(key_letter(329, us) == U'9');
    CHECK(key_letter(334, us) == 0);
    CHECK(key_letter(290, us) == 0);
    CHECK(key_letter(-1, us) == 0);
}
