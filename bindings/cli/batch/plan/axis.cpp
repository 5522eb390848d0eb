#include "bindings/cli/batch/plan/axis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "bindings/cli/file_patterns.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxValues = 1e6;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
}

std::optional<double> number_in(std::string_view text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    return is_number && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::vector<std::string> listed(const std::string& text) {
    std::vector<std::string> values(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == ',') {
            values.back() += text[++i];
        } else if (text[i] == ',') {
            values.emplace_back();
        } else {
            values.back() += text[i];
        }
    }
    return values;
}

// Numbers at equal distances; the last is `to` itself if `ends_there`.
std::vector<std::string> spaced(double from, double to, double count, bool ends_there, double step,
                                const std::string& text) {
    if (count > kMaxValues) refuse("'" + text + "' has more than a million values");
    std::vector<std::string> values;
    for (double i = 0.0; i < count; ++i) {
        const bool is_end = ends_there && i + 1.0 == count && count > 1.0;
        // Fewer digits than a number has: 0:1:0.1 shall hold 0.3, not 0.30000000000000004.
        const double value = is_end ? to : from + i * step;
        const double scale = std::pow(10.0, 12.0 - std::ceil(std::log10(std::abs(value) + 1e-300)));
        const double rounded = std::round(value * scale) / scale;
        values.push_back(number_text(is_end || !std::isfinite(rounded) ? value : rounded));
    }
    return values;
}

// FROM:TO:STEP.
std::vector<std::string> stepped(double from, double to, double step, const std::string& text) {
    if (step == 0.0 || (to - from) * step < 0.0) {
        refuse("'" + text + "' never ends: the step must lead from " + number_text(from) + " to " +
               number_text(to));
    }
    const double count = std::floor((to - from) / step + 1e-9) + 1.0;
    const bool ends_there = std::abs(from + (count - 1.0) * step - to) < 1e-9 * std::abs(step);
    return spaced(from, to, count, ends_there, step, text);
}

// FROM:TO/COUNT.
std::vector<std::string> counted(double from, double to, double count, const std::string& text) {
    if (count < 1.0 || count != std::floor(count)) {
        refuse("'" + text + "' needs a whole number of values after '/'");
    }
    const double step = count > 1.0 ? (to - from) / (count - 1.0) : 0.0;
    return spaced(from, to, count, true, step, text);
}

// The numbers of a range, or nothing if the text is none.
std::optional<std::vector<std::string>> range(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) return {};
    const std::size_t next = text.find_first_of(":/", colon + 1);
    if (next == std::string::npos) return {};
    const std::string_view view = text;
    const auto from = number_in(view.substr(0, colon));
    const auto to = number_in(view.substr(colon + 1, next - colon - 1));
    const auto last = number_in(view.substr(next + 1));
    if (!from || !to || !last) return {};
    return text[next] == ':' ? stepped(*from, *to, *last, text) : counted(*from, *to, *last, text);
}

std::string file_name_value(std::string_view kind, const fs::path& file, const fs::path& relative) {
    if (kind == "ext") return file.extension().string().erase(0, 1);
    if (kind == "dir") return relative.parent_path().generic_string();
    return file.stem().string();
}

// Adds the columns of kFileNames that are missing; `relative` holds a path for each row.
void add_columns(Axis& axis, const std::vector<fs::path>& relative) {
    for (const std::string_view kind : kFileNames) {
        if (std::find(axis.names.begin(), axis.names.end(), kind) != axis.names.end()) continue;
        axis.names.emplace_back(kind);
        for (std::size_t i = 0; i < axis.rows.size(); ++i) {
            axis.rows[i].push_back(file_name_value(kind, relative[i].filename(), relative[i]));
        }
    }
}

}  // namespace

std::string number_text(double number) {
    constexpr double kMaxWhole = 1e15;
    char text[32];
    const bool is_whole = std::abs(number) < kMaxWhole && number == std::floor(number);
    const auto [end, error] =
        is_whole ? std::to_chars(text, text + sizeof text, static_cast<std::int64_t>(number))
                 : std::to_chars(text, text + sizeof text, number);
    return error == std::errc() ? std::string(text, end) : std::to_string(number);
}

std::vector<std::string> sweep_values(const std::string& text) {
    if (auto numbers = range(text)) return *numbers;
    return listed(text);
}

Axis sweep_axis(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        refuse("--sweep " + text + " names no parameter: write NAME=VALUES, as height=0:90:15");
    }
    Axis axis;
    axis.names = {text.substr(0, equals)};
    axis.given = 1;
    for (std::string& value : sweep_values(text.substr(equals + 1))) {
        axis.rows.push_back({std::move(value)});
    }
    return axis;
}

Axis files_axis(const std::string& name, const std::string& pattern) {
    const PatternMatches matches = expand_pattern(pattern);
    std::error_code error;
    const bool names_one = matches.files.size() == 1 && !fs::exists(matches.files[0].path, error);
    if (matches.files.empty() && !matches.base.empty() && !fs::exists(matches.base, error)) {
        throw Error(ErrorCode::file_not_found,
                    pattern + ": " + missing_file_text(matches.base / "file"));
    }
    if (matches.files.empty() || names_one) {
        throw Error(ErrorCode::file_not_found,
                    names_one ? pattern + ": " + missing_file_text(pattern)
                              : "no file of a mesh or of hair matches '" + pattern + "'");
    }
    Axis axis;
    axis.names = {name};
    axis.given = 1;
    axis.is_pattern = true;
    std::vector<fs::path> relative;
    for (const MatchedFile& file : matches.files) {
        axis.rows.push_back({file.path.string()});
        relative.push_back(file.relative);
    }
    add_columns(axis, relative);
    return axis;
}

void add_file_names(Axis& axis, const std::string& name) {
    const auto column = std::find(axis.names.begin(), axis.names.end(), name) - axis.names.begin();
    std::vector<fs::path> files;
    for (const std::vector<std::string>& row : axis.rows) {
        files.push_back(fs::path(row[static_cast<std::size_t>(column)]).filename());
    }
    add_columns(axis, files);
}

}  // namespace lissom::cli
