#include "bindings/cli/batch/plan/output_name.h"

#include <algorithm>

#include "kernel/core/error.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// A value as a part of a file's name.
std::string name_part(std::string value) {
    for (char& c : value) {
        const bool is_control = static_cast<unsigned char>(c) < 0x20;
        if (c == '/' || c == '\\' || is_control) c = '_';
    }
    if (value == "." || value == "..") value.replace(0, value.size(), value.size(), '_');
    return value.empty() ? "_" : value;
}

// Folders below another: without steps upwards.
std::string folder_part(const std::string& value) {
    fs::path folder;
    for (const fs::path& part : fs::path(value).relative_path()) {
        if (!part.empty() && part != ".") folder /= name_part(part.string());
    }
    return folder.empty() ? "." : folder.generic_string();
}

}  // namespace

OutputName::OutputName(const std::string& text) {
    const auto refuse = [&text](const char* brace) {
        throw Error(ErrorCode::invalid_argument, "--out " + text + ": a '" + brace +
                                                     "' lacks its other; write it twice for the "
                                                     "character itself");
    };
    pieces_.emplace_back();
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_brace = text[i] == '{' || text[i] == '}';
        if (is_brace && i + 1 < text.size() && text[i + 1] == text[i]) {
            pieces_.back().text += text[i++];
        } else if (text[i] == '{') {
            const std::size_t end = text.find('}', i);
            if (end == std::string::npos) refuse("{");
            pieces_.push_back({text.substr(i + 1, end - i - 1), true});
            pieces_.emplace_back();
            i = end;
        } else if (text[i] == '}') {
            refuse("}");
        } else {
            pieces_.back().text += text[i];
        }
    }
}

std::vector<std::string> OutputName::placeholders() const {
    std::vector<std::string> names;
    for (const Piece& piece : pieces_) {
        if (piece.is_placeholder) names.push_back(piece.text);
    }
    return names;
}

fs::path OutputName::base() const {
    const fs::path before = fs::path(pieces_.front().text);
    const fs::path folder = before.parent_path();
    return folder.empty() ? "." : folder.lexically_normal();
}

fs::path OutputName::fill(const std::function<std::string(const std::string&)>& value) const {
    std::string text;
    for (const Piece& piece : pieces_) {
        if (!piece.is_placeholder) {
            text += piece.text;
        } else {
            const std::string filled = value(piece.text);
            text += piece.text == "dir" ? folder_part(filled) : name_part(filled);
        }
    }
    return fs::path(text).lexically_normal();
}

}  // namespace lissom::cli
