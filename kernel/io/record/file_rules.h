/// Common rules of mesh files and hair files: extensions, units, and the place of an error; private
/// to kernel/io.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "kernel/core/error.h"
#include "kernel/io/stream/file_error.h"

namespace lissom {

/// Lower case, without the dot.
inline std::string normalized_extension(std::string_view extension) {
    if (extension.starts_with('.')) extension.remove_prefix(1);
    std::string result(extension);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// Text without the mark that editors put before UTF-8.
inline std::string_view without_byte_order_mark(std::string_view bytes) {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    return bytes.substr(bytes.starts_with(kMark) ? kMark.size() : 0);
}

/// Errors: invalid_argument if `unit` is not positive and finite.
inline void require_unit(double unit) {
    if (unit > 0.0 && std::isfinite(unit)) return;
    throw Error(ErrorCode::invalid_argument,
                "unit is " + std::to_string(unit) + ", but must be positive and finite");
}

/// Returns the result of `action`; its errors begin with the file, and the line if there is one.
template <typename Action>
auto with_place_in_errors(const std::string& file, const Action& action) {
    try {
        return action();
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
        std::string place = file;
        const Elements& elements = error.elements();
        if (elements.kind == ElementKind::line && !elements.ids.empty()) {
            place += (file.empty() ? "line " : ":") + std::to_string(elements.ids[0] + 1LL);
        }
        if (!place.empty()) place += ": ";
        throw FileError(error.code(), FileError::of(error, file), place + error.message(),
                        elements);
    }
}

}  // namespace lissom
