#include "bindings/cli/terminal/keys.h"

#include <cstddef>
#include <string_view>
#include <utility>

namespace lissom::cli {
namespace {

constexpr char kEscape = 27, kDelete = 127;

constexpr char control(char letter) {
    return static_cast<char>(letter & 0x1f);
}

constexpr std::pair<char, Key> kControlKeys[] = {
    {control('A'), Key::begin},        {control('B'), Key::left},
    {control('D'), Key::end_of_input}, {control('E'), Key::end},
    {control('F'), Key::right},        {control('G'), Key::leave},
    {control('H'), Key::erase_before}, {control('I'), Key::complete},
    {control('J'), Key::enter},        {control('K'), Key::cut_to_end},
    {control('L'), Key::clear_screen}, {control('M'), Key::enter},
    {control('N'), Key::newer},        {control('P'), Key::older},
    {control('R'), Key::search},       {control('T'), Key::transpose},
    {control('U'), Key::cut_to_begin}, {control('W'), Key::cut_word_before},
    {control('Y'), Key::paste},        {kDelete, Key::erase_before}};

// With Alt, which sends an escape before them.
constexpr std::pair<char, Key> kAltKeys[] = {{'b', Key::word_left},
                                             {'f', Key::word_right},
                                             {'d', Key::cut_word_after},
                                             {control('H'), Key::cut_word_before},
                                             {kDelete, Key::cut_word_before}};

// After an escape and '[' or 'O'.
constexpr std::pair<std::string_view, Key> kSequences[] = {
    {"A", Key::older},        {"B", Key::newer},         {"C", Key::right},
    {"D", Key::left},         {"H", Key::begin},         {"F", Key::end},
    {"1~", Key::begin},       {"7~", Key::begin},        {"4~", Key::end},
    {"8~", Key::end},         {"3~", Key::erase_after},  {"1;5C", Key::word_right},
    {"1;5D", Key::word_left}, {"1;3C", Key::word_right}, {"1;3D", Key::word_left},
    {"5C", Key::word_right},  {"5D", Key::word_left},    {"3;5~", Key::cut_word_after}};

template <typename Name, std::size_t N>
Key look_up(const std::pair<Name, Key> (&keys)[N], Name name) {
    for (const auto& [known, key] : keys) {
        if (known == name) return key;
    }
    return Key::none;
}

// Parameters, and the one that ends them.
KeyPress read_sequence(const std::function<std::optional<char>()>& next) {
    std::string sequence;
    while (const std::optional<char> byte = next()) {
        sequence += *byte;
        if (*byte >= '@' && *byte <= '~') break;
    }
    return {look_up(kSequences, std::string_view(sequence))};
}

KeyPress read_escape(const std::function<std::optional<char>()>& next) {
    const std::optional<char> byte = next();
    if (!byte) return {Key::leave};
    if (*byte == '[' || *byte == 'O') return read_sequence(next);
    return {look_up(kAltKeys, *byte)};
}

KeyPress read_character(char first, const std::function<std::optional<char>()>& next) {
    KeyPress press{Key::text, {first}};
    const auto byte = static_cast<unsigned char>(first);
    const int more = byte < 0xc2 ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : byte < 0xf5 ? 3 : 0;
    for (int i = 0; i < more; ++i) {
        const std::optional<char> following = next();
        if (!following) break;
        press.text += *following;
    }
    return press;
}

}  // namespace

KeyPress read_key(char first, const std::function<std::optional<char>()>& next) {
    if (first == kEscape) return read_escape(next);
    const auto byte = static_cast<unsigned char>(first);
    if (byte >= ' ' && first != kDelete) return read_character(first, next);
    return {look_up(kControlKeys, first)};
}

}  // namespace lissom::cli
