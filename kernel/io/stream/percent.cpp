#include "kernel/io/stream/percent.h"

namespace lissom {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";

bool is_plain(char c, bool keeps_utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) return keeps_utf8;
    return byte > 0x20 && byte < 0x7f && c != '%' && c != '\\' && c != '#' && c != '"';
}

}  // namespace

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

std::string percent_encoded_byte(char byte) {
    const auto value = static_cast<unsigned char>(byte);
    return {'%', kHexDigits[value / 16], kHexDigits[value % 16]};
}

std::string percent_encoded(std::string_view name, bool keeps_utf8) {
    std::string text;
    for (const char c : name) {
        if (is_plain(c, keeps_utf8)) {
            text += c;
        } else {
            text += percent_encoded_byte(c);
        }
    }
    return text;
}

std::string percent_decoded(std::string_view text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        if (low < 0) {
            name += text[i];
        } else {
            name += static_cast<char>(16 * high + low);
            i += 2;
        }
    }
    return name;
}

}  // namespace lissom
