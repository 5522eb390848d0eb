#include "kernel/io/read_error.h"

#include <algorithm>
#include <limits>

namespace lissom {
namespace {

constexpr std::size_t kMaximumElements = std::numeric_limits<Index>::max();

}  // namespace

void refuse(ErrorCode code, const std::string& message, Place place) {
    if (place.kind == ElementKind::none) throw Error(code, message);
    const auto id = static_cast<Index>(std::min(place.id, kMaximumElements));
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
                          Place place) {
    const std::string what = std::to_string(count) + " " + std::string(elements);
    if (count < 0) refuse(ErrorCode::file_syntax, "the header announces " + what, place);
    const auto number = static_cast<std::size_t>(count);
    if (number > file_bytes) {
        refuse(ErrorCode::file_too_large,
               "the header announces " + what + ", but the file has only " +
                   std::to_string(file_bytes) + " bytes; it is damaged or cut short",
               place);
    }
    if (number > kMaximumElements) {
        refuse(ErrorCode::file_too_large,
               "the header announces " + what + ", more than the " +
                   std::to_string(kMaximumElements) + " that can be numbered; split the file",
               place);
    }
    return number;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kShown = 40;
    std::string shown(text.substr(0, kShown));
    for (char& c : shown) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return "'" + shown + (text.size() > kShown ? "...'" : "'");
}

}  // namespace lissom
