#include "kernel/io/stream/read_error.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "kernel/io/stream/utf8.h"

namespace lissom {
namespace {

constexpr std::size_t kMaximumElements = std::numeric_limits<Index>::max();

// Bytes of the character of UTF-8 that begins `text`; 0 if none does or it cannot be printed.
std::size_t printable_length(std::string_view text) {
    const std::size_t length = utf8_length(text);
    const auto lead = static_cast<unsigned char>(length > 0 ? text[0] : 0);
    if (length == 1) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
    const bool is_control = lead == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;
    return is_control ? 0 : length;
}

}  // namespace

void refuse(ErrorCode code, const std::string& message, FilePlace place) {
    if (place.kind == ElementKind::none) throw Error(code, message);
    const auto id = index_of(std::min(place.id, kMaximumElements));
    throw Error(code, message, {place.kind, 1, {id}});
}

void refuse_truncated(const Tally& tally) {
    std::string found = std::to_string(tally.found);
    if (tally.announced > 0) found += " of " + std::to_string(tally.announced);
    refuse(ErrorCode::file_truncated, "the file ends after " + found + " " +
                                          std::string(tally.elements) +
                                          "; copy or export it again");
}

std::size_t checked_count(std::int64_t count, std::size_t file_bytes, std::string_view elements,
                          FilePlace place) {
    const std::string what = std::to_string(count) + " " + std::string(elements);
    if (count < 0) refuse(ErrorCode::file_syntax, "the header announces " + what, place);
    if (count > static_cast<std::int64_t>(kMaximumElements)) {
        refuse(ErrorCode::file_too_large,
               "the header announces " + what + ", more than the " +
                   std::to_string(kMaximumElements) + " that can be numbered; split the file",
               place);
    }
    const auto number = static_cast<std::size_t>(count);
    if (number > file_bytes) {
        refuse(ErrorCode::file_truncated,
               "the header announces " + what + ", but the file has only " +
                   std::to_string(file_bytes) + " bytes; it is damaged or cut short",
               place);
    }
    return number;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kShown = 40;
    std::string shown;
    std::size_t at = 0;
    while (at < text.size() && shown.size() < kShown) {
        const std::size_t length = printable_length(text.substr(at));
        shown += length == 0 ? "?" : text.substr(at, length);
        at += std::max<std::size_t>(1, length);
    }
    return "'" + shown + (at < text.size() ? "...'" : "'");
}

std::string without_tag(std::string_view message) {
    const std::size_t end = message.find("] ");
    const bool tagged = message.starts_with('[') && end != std::string_view::npos;
    const std::string text(tagged ? message.substr(end + 2) : message);
    // The last token may be all data of a file.
    constexpr std::string_view kLastRead = "last read: ";
    constexpr std::size_t kMostRead = 120;
    const std::size_t read = text.find(kLastRead);
    if (read == std::string::npos || text.size() - read < kMostRead) return text;
    const std::size_t token = read + kLastRead.size();
    return text.substr(0, token) + in_quotes(std::string_view(text).substr(token + 1));
}

}  // namespace lissom
