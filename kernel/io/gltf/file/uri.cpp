#include "kernel/io/gltf/file/uri.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include "kernel/io/stream/file.h"
#include "kernel/io/stream/open_file.h"
#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBase64Digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
// Images have no announced size; none in use is near this one.
constexpr std::size_t kLargestImage = std::size_t{512} << 20;

std::array<int, 256> digit_values() {
    std::array<int, 256> values;
    values.fill(-1);
    for (std::size_t i = 0; i < kBase64Digits.size(); ++i) {
        values[static_cast<unsigned char>(kBase64Digits[i])] = index_of(i);
    }
    return values;
}

std::string decode_base64(std::string_view text) {
    const std::array<int, 256> values = digit_values();
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = values[static_cast<unsigned char>(c)];
        if (value < 0) refuse(ErrorCode::file_syntax, "a data URI is not in base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes += static_cast<char>(bits >> bit_count & 0xff);
    }
    return bytes;
}

// The scheme in lower case, empty for a relative reference.
std::string scheme_of(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || uri.find('/') < colon) return "";
    std::string scheme(uri.substr(0, colon));
    for (char& c : scheme) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return scheme;
}

[[noreturn]] void refuse_path(std::string_view uri) {
    refuse(ErrorCode::unsafe_path, "the file refers to " + in_quotes(uri) +
                                       ", which is not inside its own folder; copy the files "
                                       "that it needs beside it");
}

bool has_parent_part(const fs::path& path) {
    return std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

fs::path safe_relative_path(std::string_view uri) {
    const std::string name = percent_decoded(uri);
    const bool has_odd_character = std::any_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':';
    });
    if (name.empty() || has_odd_character || name.starts_with('/')) refuse_path(uri);
    fs::path relative(std::u8string(name.begin(), name.end()));
    if (relative.is_absolute() || relative.has_root_name() || has_parent_part(relative)) {
        refuse_path(uri);
    }
    return relative;
}

}  // namespace

std::optional<UriData> decode_data_uri(std::string_view uri) {
    if (scheme_of(uri.substr(0, 5)) != "data") return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) refuse(ErrorCode::file_syntax, "a data URI has no comma");
    const std::string_view head = uri.substr(5, comma - 5), body = uri.substr(comma + 1);
    constexpr std::string_view kBase64 = ";base64";
    UriData data;
    data.media_type = head.substr(0, std::min(head.find(';'), head.size()));
    const bool is_escaped = body.find('%') != std::string_view::npos;
    const std::string plain = is_escaped ? percent_decoded(body) : std::string();
    const std::string_view text = is_escaped ? std::string_view(plain) : body;
    data.bytes = head.ends_with(kBase64) ? decode_base64(text) : std::string(text);
    return data;
}

std::string make_data_uri(std::string_view bytes) {
    std::string uri = "data:application/octet-stream;base64,";
    uri.reserve(uri.size() + bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool there = i + k < bytes.size();
            bits = bits << 8 | (there ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            uri += i + k > bytes.size() ? '=' : kBase64Digits[bits >> (18 - 6 * k) & 63];
        }
    }
    return uri;
}

bool is_on_the_web(std::string_view uri) {
    const std::string scheme = scheme_of(uri);
    return scheme == "http" || scheme == "https";
}

fs::path GltfFolder::path_of(const fs::path& relative, std::string_view uri) const {
    if (context_.files().read) return (folder_ / relative).lexically_normal();
    try {
        return path_within(folder_, relative);
    } catch (const Error&) {
        refuse_path(uri);
    }
}

SharedBytes GltfFolder::read_from_host(const fs::path& path) {
    SharedBytes& known = content_[path];
    if (!known) {
        known = std::make_shared<const std::string>(read_file(path, context_).bytes);
        bytes_read_ += known->size();
    }
    return known;
}

SharedBytes GltfFolder::read_path(const fs::path& path, std::size_t length) {
    SharedBytes& known = content_[path];
    if (known && known->size() >= length) return known;
    std::string bytes(length, '\0');
    std::ifstream stream = open_to_read(path);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(length))) {
        refuse(ErrorCode::file_unreadable, "'" + display_name(path) + "' cannot be read");
    }
    bytes_read_ += length;
    known = std::make_shared<const std::string>(std::move(bytes));
    return known;
}

SharedBytes GltfFolder::read(std::string_view uri, std::uint64_t length) {
    if (is_on_the_web(uri)) {
        refuse(ErrorCode::unsupported,
               "the file refers to " + in_quotes(uri) + " on the web; download it and refer to it");
    }
    const fs::path relative = safe_relative_path(uri);
    if (folder_.empty()) {
        refuse(ErrorCode::file_not_found,
               "the data are in the file " + in_quotes(uri) +
                   ", but a file in memory has no folder to find it in; load it by its path");
    }
    const fs::path path = path_of(relative, uri);
    require_file(path, context_);
    const bool by_host = static_cast<bool>(context_.files().read);
    const auto size = by_host ? read_from_host(path)->size() : fs::file_size(path);
    if (size < length) {
        refuse(ErrorCode::file_truncated, "'" + display_name(path) + "' has " +
                                              std::to_string(size) + " of the " +
                                              std::to_string(length) + " bytes it should have");
    }
    if (length > std::string().max_size()) {
        refuse(ErrorCode::file_too_large,
               "a buffer has " + std::to_string(length) +
                   " bytes, more than a program of 32 bits can address; use one of 64 bits");
    }
    return read_path(path, static_cast<std::size_t>(length));
}

SharedBytes GltfFolder::read_if_there(std::string_view uri) {
    if (is_on_the_web(uri)) return nullptr;
    const fs::path relative = safe_relative_path(uri);
    if (folder_.empty()) return nullptr;
    const fs::path path = path_of(relative, uri);
    if (context_.files().read) {
        try {
            return read_from_host(path);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::file_not_found) throw;
            return nullptr;
        }
    }
    std::error_code failed;
    if (!fs::is_regular_file(path, failed)) return nullptr;
    const auto size = fs::file_size(path);
    if (size > kLargestImage) {
        refuse(ErrorCode::file_too_large, "the image '" + display_name(path) + "' has " +
                                              std::to_string(size) + " bytes; make it smaller");
    }
    return read_path(path, static_cast<std::size_t>(size));
}

}  // namespace lissom
