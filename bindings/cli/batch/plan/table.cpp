#include "bindings/cli/batch/plan/table.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/json.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMarkOfUtf8 = "\xef\xbb\xbf";

[[noreturn]] void refuse_table(const std::string& place, const std::string& message) {
    throw Error(ErrorCode::invalid_argument, place + ": " + message);
}

using Row = std::vector<std::string>;

// The separator of the first line: the first of these that stands outside of quotes.
char separator_of(std::string_view text) {
    std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    std::string bare;
    bool is_quoted = false;
    for (const char c : line) {
        is_quoted = is_quoted != (c == '"');
        if (!is_quoted) bare += c;
    }
    for (const char separator : {',', ';', '\t'}) {
        if (bare.find(separator) != std::string::npos) return separator;
    }
    return ',';
}

std::string without_spaces(std::string_view value) {
    const std::size_t begin = value.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return std::string(value.substr(begin, value.find_last_not_of(" \t") - begin + 1));
}

class TableReader {
  public:
    TableReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
        if (text_.starts_with(kMarkOfUtf8)) text_.remove_prefix(kMarkOfUtf8.size());
        skip_line_ends();
        separator_ = separator_of(text_.substr(at_));
    }

    bool has_row() {
        skip_line_ends();
        return at_ < text_.size();
    }
    int line() const { return line_; }
    std::string place() const { return name_ + ":" + std::to_string(line_); }

    Row row() {
        has_quotes_ = false;
        Row values;
        for (bool more = true; more;) {
            skip_spaces();
            const bool is_quoted = at_ < text_.size() && text_[at_] == '"';
            has_quotes_ = has_quotes_ || is_quoted;
            values.push_back(is_quoted ? quoted() : plain());
            more = at_ < text_.size() && text_[at_] == separator_;
            if (more) ++at_;
        }
        return values;
    }
    // Whether a value of the last row stood in quotes.
    bool has_quotes() const { return has_quotes_; }

  private:
    void skip_line_ends() {
        while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) {
            line_ += text_[at_++] == '\n';
        }
    }

    void skip_spaces() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    }

    bool ends_value() const {
        return at_ >= text_.size() || text_[at_] == separator_ || text_[at_] == '\r' ||
               text_[at_] == '\n';
    }

    std::string plain() {
        const std::size_t begin = at_;
        while (!ends_value()) ++at_;
        return checked(without_spaces(text_.substr(begin, at_ - begin)));
    }

    std::string quoted() {
        const std::string begin = place();
        std::string value;
        for (++at_; at_ < text_.size(); ++at_) {
            if (text_[at_] == '"') {
                if (at_ + 1 == text_.size() || text_[at_ + 1] != '"') return after_quote(value);
                ++at_;
            }
            line_ += text_[at_] == '\n';
            value += text_[at_];
        }
        refuse_table(begin, "the quoted value has no end");
    }

    std::string after_quote(const std::string& value) {
        ++at_;
        skip_spaces();
        if (!ends_value()) {
            refuse_table(place(), "'" + std::string(1, separator_) +
                                      "' or the end of the line must follow a quoted value");
        }
        return checked(value);
    }

    std::string checked(std::string value) const {
        if (is_utf8(value)) return value;
        refuse_table(place(), "the table is not in UTF-8: save it as \"CSV UTF-8\"");
    }

    std::string_view text_;
    std::string name_;
    std::size_t at_ = 0;
    int line_ = 1;
    char separator_ = ',';
    bool has_quotes_ = false;
};

void require_names(const Axis& axis, const std::string& place) {
    for (std::size_t i = 0; i < axis.names.size(); ++i) {
        if (axis.names[i].empty()) {
            refuse_table(place, "column " + std::to_string(i + 1) + " of the table has no name");
        }
        if (std::find(axis.names.begin(), axis.names.begin() + static_cast<std::ptrdiff_t>(i),
                      axis.names[i]) != axis.names.begin() + static_cast<std::ptrdiff_t>(i)) {
            refuse_table(place, "two columns of the table are called '" + axis.names[i] + "'");
        }
    }
}

std::string value_count(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " value" : " values");
}

std::string column_count(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " column" : " columns");
}

bool is_blank(const Row& row) {
    return std::all_of(row.begin(), row.end(), [](const std::string& v) { return v.empty(); });
}

// Programs leave commas behind the last column after a value there was deleted.
void drop_nameless_columns(Axis& axis) {
    while (!axis.names.empty() && axis.names.back().empty()) {
        const bool has_values = std::any_of(axis.rows.begin(), axis.rows.end(),
                                            [](const Row& row) { return !row.back().empty(); });
        if (has_values) return;
        axis.names.pop_back();
        for (Row& row : axis.rows) row.pop_back();
    }
}

void refuse_utf16(std::string_view bytes, const std::string& name) {
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
        refuse_table(name, "the table is in UTF-16: save it as \"CSV UTF-8\"");
    }
}

void read_rows(TableReader& reader, Axis& axis) {
    while (reader.has_row()) {
        const std::string place = reader.place();
        const int line = reader.line();
        Row row = reader.row();
        if (row.size() > 1 && !reader.has_quotes() && is_blank(row)) continue;
        if (row.size() != axis.names.size()) {
            refuse_table(place, "the row has " + value_count(row.size()) + " for " +
                                    column_count(axis.names.size()));
        }
        axis.rows.push_back(std::move(row));
        axis.lines.push_back(line);
    }
}

}  // namespace

Axis table_axis(const fs::path& file) {
    const FileContent content = read_file(file);
    Axis axis;
    axis.table = display_name(file);
    refuse_utf16(content.bytes, axis.table);
    TableReader reader(content.bytes, axis.table);
    if (!reader.has_row()) refuse_table(reader.place(), "the table has no first line of names");
    const std::string first = reader.place();
    axis.names = reader.row();
    read_rows(reader, axis);
    drop_nameless_columns(axis);
    axis.given = axis.names.size();
    require_names(axis, first);
    if (axis.rows.empty()) refuse_table(reader.place(), "the table has no row below its names");
    return axis;
}

}  // namespace lissom::cli
