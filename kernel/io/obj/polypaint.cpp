#include "kernel/io/obj/polypaint.h"

#include <algorithm>

#include "kernel/io/stream/percent.h"

namespace lissom {
namespace {

constexpr std::string_view kPolypaint = "#MRGB";
constexpr std::size_t kColorDigits = 8;

// The byte of two digits, or -1.
int hex_byte(std::string_view digits) {
    const int high = hex_digit(digits[0]), low = hex_digit(digits[1]);
    return high < 0 || low < 0 ? -1 : 16 * high + low;
}

// The text of a comment behind its keyword, without blanks around it.
std::string_view comment_text(std::string_view rest) {
    rest = rest.substr(0, rest.find_first_of("\r\n"));
    const std::size_t first = rest.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return rest.substr(first, rest.find_last_not_of(" \t") + 1 - first);
}

bool begins_line(std::string_view text, std::size_t at) {
    return at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
}

// False if the digits are no colour.
bool add_color(std::string_view digits, std::vector<std::uint8_t>& colors,
               SkippedContent& skipped) {
    int bytes[4];
    for (std::size_t k = 0; k < 4; ++k) {
        bytes[k] = digits.size() == kColorDigits ? hex_byte(digits.substr(2 * k, 2)) : -1;
        if (bytes[k] < 0) return false;
    }
    if (bytes[0] != 0xff) skipped.add("masks of polypaint");
    for (std::size_t k = 1; k < 4; ++k) colors.push_back(static_cast<std::uint8_t>(bytes[k]));
    return true;
}

}  // namespace

std::vector<std::uint8_t> read_polypaint(std::string_view text, SkippedContent& skipped) {
    std::vector<std::uint8_t> colors;
    for (std::size_t at = 0; (at = text.find(kPolypaint, at)) != std::string_view::npos;) {
        const bool counts = begins_line(text, at);
        at += kPolypaint.size();
        if (!counts) continue;
        for (std::string_view line = comment_text(text.substr(at)); !line.empty();) {
            const std::string_view digits = line.substr(0, kColorDigits);
            // The colours behind would belong to other vertices.
            if (!add_color(digits, colors, skipped)) {
                skipped.add("damaged polypaint");
                return colors;
            }
            line.remove_prefix(digits.size());
        }
    }
    return colors;
}

}  // namespace lissom
