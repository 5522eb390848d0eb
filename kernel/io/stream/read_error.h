/// Errors of readers of mesh files, and their common parts; private to kernel/io. A reader does not
/// know the path of its file: the caller that opened the file puts it before the message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/core/error.h"

namespace lissom {

/// Place of an error in a file: a line of a text, or an element of a binary file.
struct FilePlace {
    ElementKind kind = ElementKind::none;
    std::size_t id = 0;
};

/// Throws an error at a place.
[[noreturn]] void refuse(ErrorCode code, const std::string& message, FilePlace place = {});

/// Kind and count of the elements found, for a file that ends too early. `elements` is a plural;
/// `announced` is 0 if the file does not say how many there are.
struct Tally {
    std::string_view elements = "statements";
    std::size_t found = 0;
    std::size_t announced = 0;
};

/// Throws file_truncated with the numbers of the tally.
[[noreturn]] void refuse_truncated(const Tally& tally);

/// Returns a number of elements announced by a header, once it is known that a file of `file_bytes`
/// bytes may hold as many. Errors: file_syntax for a negative count; file_too_large for more than
/// can be numbered; file_truncated for more than there are bytes.
std::size_t checked_count(std::int64_t count, std::size_t file_bytes, std::string_view elements,
                          FilePlace place);

/// Returns the beginning of `text` in quotes: valid UTF-8, with '?' for unprintable characters.
std::string in_quotes(std::string_view text);

/// Returns the message of a parser of JSON, without the name and number of its own that it puts
/// before it: "[json.exception.parse_error.101] parse error at line 3".
std::string without_tag(std::string_view message);

}  // namespace lissom
