#include "kernel/scene/file/folder_lists.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/numbers/number_text.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/folder.h"

namespace lissom {
namespace {

// Up to here a list stands in the JSON.
constexpr std::size_t kFewNumbers = 12;
constexpr std::size_t kLongestName = 60;

// Calls visit with a number of each type.
template <typename Visit>
void with_number_type(NumberType type, const Visit& visit) {
    switch (type) {
        case NumberType::float32:
            return visit(float{});
        case NumberType::float64:
            return visit(double{});
        case NumberType::int32:
            return visit(Index{});
        case NumberType::uint32:
            return visit(std::uint32_t{});
        case NumberType::int64:
            return visit(std::int64_t{});
    }
}

template <typename Number>
std::vector<Number> numbers_in(std::string_view bytes) {
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

template <typename Number>
bool all_finite(const std::vector<Number>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](Number x) { return std::isfinite(static_cast<double>(x)); });
}

// In the shortest form that reads back equal.
template <typename Number>
void append_shortest(std::string& text, Number value) {
    char digits[40];
    const auto [stop, error] = write_number(digits, digits + sizeof digits, value);
    text.append(digits, stop);
}

template <typename Number>
std::string lines_of(const std::vector<Number>& numbers, std::size_t width) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        append_shortest(text, numbers[i]);
        text += (i + 1) % width == 0 || i + 1 == numbers.size() ? '\n' : ' ';
    }
    return text;
}

// Returns a component of a path without the special characters of file systems and shells.
std::string tame(std::string_view name) {
    std::string result;
    for (const char c : name.substr(0, kLongestName)) {
        const bool kept = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ||
                          (c == '.' && !result.empty());
        result += kept ? c : '_';
    }
    return result.empty() ? "_" : result;
}

std::string tame_path(std::string_view label) {
    constexpr std::string_view kItems = "items/";
    if (label.starts_with(kItems)) label.remove_prefix(kItems.size());
    std::string result;
    while (!label.empty()) {
        const std::size_t end = std::min(label.find('/'), label.size());
        result += (result.empty() ? "" : "/") + tame(label.substr(0, end));
        label.remove_prefix(std::min(end + 1, label.size()));
    }
    return result;
}

template <typename Number>
void append_points(std::string& text, std::span<const Number> coordinates) {
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        text += 'v';
        for (std::size_t k = i; k < i + 3; ++k) {
            text += ' ';
            append_shortest(text, coordinates[k]);
        }
        text += '\n';
    }
}

// "p" stands for a strand of one point: a line has two.
void append_element(std::string& text, const ModelView& model, std::size_t i) {
    const Index begin = model.offsets[i], end = model.offsets[i + 1];
    text += !model.lines ? 'f' : end - begin == 1 ? 'p' : 'l';
    for (Index k = begin; k < end; ++k) {
        text += ' ';
        append_shortest(text, (model.lines ? k : model.corners[at(k)]) + 1);
    }
    text += '\n';
}

// ---- Reading

// Text that is read word by word; errors name the line.
class WordReader {
  public:
    WordReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
        if (!text.ends_with('\n')) refuse("the file is cut short", ErrorCode::file_truncated);
    }

    bool at_end() {
        skip(" \t\r\n");
        return at_ == text_.size();
    }
    bool at_line_end() {
        skip(" \t\r");
        return at_ == text_.size() || text_[at_] == '\n';
    }
    void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
    std::string_view word() {
        skip(" \t");
        const std::size_t begin = at_;
        at_ = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
        return text_.substr(begin, at_ - begin);
    }
    template <typename Number>
    Number number() {
        Number value{};
        const std::string_view given = word();
        const auto [stop, error] = read_number(given.data(), given.data() + given.size(), value);
        if (error != std::errc() || stop != given.data() + given.size() || given.empty()) {
            refuse("'" + std::string(given) + "' is not the number that belongs here");
        }
        return value;
    }
    // The vertex of a corner "7", "7/2" or "7//5", from 0.
    Index corner() {
        const std::string_view given = word();
        Index value = 0;
        const auto [stop, error] = read_number(given.data(), given.data() + given.size(), value);
        const bool ends = stop == given.data() + given.size() || *stop == '/';
        if (error != std::errc() || !ends || value < 1) {
            refuse("'" + std::string(given) + "' is no vertex");
        }
        return value - 1;
    }
    [[noreturn]] void refuse(const std::string& what,
                             ErrorCode code = ErrorCode::file_syntax) const {
        const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at_), '\n');
        throw Error(code, name_ + ":" + std::to_string(line) + ": " + what);
    }

  private:
    void skip(std::string_view blanks) {
        at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
};

// `path` is that of a value in scene.json.
[[noreturn]] void refuse_entry(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::file_syntax, "the scene's '" + path + "' " + what);
}

std::size_t count_in(const std::string& path, const SceneJson& entry, const char* key) {
    const auto found = entry.find(key);
    if (found == entry.end() || !found->is_number_unsigned()) {
        refuse_entry(path + "/" + key, "must be a count");
    }
    return found->get<std::size_t>();
}

void require_count(const std::string& name, const char* what, std::size_t has, std::size_t needs) {
    if (has == needs) return;
    throw Error(has < needs ? ErrorCode::file_truncated : ErrorCode::file_syntax,
                name + ": has " + std::to_string(has) + " " + what + " but scene.json says " +
                    std::to_string(needs));
}

template <typename Number>
std::string raw_bytes(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

template <typename Number>
std::string read_inline(const std::string& path, const SceneJson& entry) {
    std::vector<Number> numbers;
    for (const SceneJson& one : entry) {
        if (!one.is_number()) refuse_entry(path, "must be a list of numbers");
        numbers.push_back(one.get<Number>());
    }
    return raw_bytes(numbers);
}

template <typename Number>
std::string read_lines(std::string_view text, const std::string& name, std::size_t count) {
    WordReader words(text, name);
    std::vector<Number> numbers;
    // A damaged count must not take memory.
    numbers.reserve(std::min(count, text.size() / 2 + 1));
    while (!words.at_end()) numbers.push_back(words.number<Number>());
    require_count(name, "numbers", numbers.size(), count);
    return raw_bytes(numbers);
}

struct ModelText {
    std::vector<double> coordinates;
    std::vector<float> float_coordinates;
    std::vector<Index> offsets{0}, corners;
};

// Content of other programs beside points and elements is passed over.
ModelText read_model(std::string_view text, const std::string& name, bool lines) {
    WordReader words(text, name);
    ModelText model;
    while (!words.at_end()) {
        const std::string_view kind = words.word();
        if (kind == "v") {
            for (int k = 0; k < 3; ++k) {
                if (lines) model.float_coordinates.push_back(words.number<float>());
                if (!lines) model.coordinates.push_back(words.number<double>());
            }
        } else if (lines ? kind == "l" || kind == "p" : kind == "f") {
            while (!words.at_line_end()) model.corners.push_back(words.corner());
            model.offsets.push_back(count_of(model.corners));
        }
        words.skip_line();
    }
    return model;
}

void require_points(const std::string& path, const std::string& name, const SceneJson& entry,
                    const ModelText& model, std::size_t points) {
    require_count(name, "points", points, count_in(path, entry, "points"));
    require_count(name, "elements", model.offsets.size() - 1, count_in(path, entry, "elements"));
    for (const Index corner : model.corners) {
        if (at(corner) < points) continue;
        throw Error(ErrorCode::face_index, name + ": has no point " + std::to_string(corner + 1) +
                                               ", which one of its elements names");
    }
}

}  // namespace

void require_inside(const std::string& name) {
    const std::filesystem::path path(name);
    const auto leads_out = [](const std::filesystem::path& part) { return part == ".."; };
    if (!name.empty() && !path.is_absolute() && path.has_filename() && !path.has_root_name() &&
        name.find('\\') == std::string::npos && name.find('\0') == std::string::npos &&
        std::none_of(path.begin(), path.end(), leads_out)) {
        return;
    }
    throw Error(ErrorCode::unsafe_path,
                "scene.json: '" + name + "' is not the name of a file in the scene's folder");
}

// ---- Writing

std::string FolderSink::free_name(std::string_view label, std::string_view end) {
    const std::string begin = tame_path(label);
    for (int number = 1;; ++number) {
        std::string name = begin + (number > 1 ? "-" + std::to_string(number) : "");
        name += end;
        std::string small;
        for (const char c : name) {
            small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
        if (taken_.insert(small).second) return name;
    }
}

SceneJson FolderSink::put(const ListPlace& place, std::string_view bytes, ListForm form) {
    SceneJson entry;
    with_number_type(form.type, [&](auto kind) {
        using Number = decltype(kind);
        const auto numbers = numbers_in<Number>(bytes);
        if (numbers.size() <= kFewNumbers && all_finite(numbers)) {
            entry = SceneJson(numbers);
            return;
        }
        const std::string name = free_name(place.label, ".txt");
        files_[name] = lines_of(numbers, form.width);
        entry = {{"file", name}, {"count", numbers.size()}};
    });
    return entry;
}

SceneJson FolderSink::put_model(const std::string& label, const ModelView& model) {
    const std::string name = free_name(label, ".obj");
    std::string text = "# part of a scene; see scene.json\n";
    const std::size_t points = model.lines ? model.points.size() / 3 : model.positions.size();
    if (model.lines) {
        append_points(text, model.points);
    } else if (points > 0) {
        append_points(text, std::span<const double>(model.positions.front().data(), 3 * points));
    }
    const std::size_t elements = model.offsets.empty() ? 0 : model.offsets.size() - 1;
    for (std::size_t i = 0; i < elements; ++i) append_element(text, model, i);
    files_[name] = std::move(text);
    return {{"file", name}, {"points", points}, {"elements", elements}};
}

std::string FolderSource::read(const std::string& path, const SceneJson& entry, std::string& name) {
    const auto file = entry.is_object() ? entry.find("file") : entry.end();
    if (!entry.is_object() || file == entry.end() || !file->is_string()) {
        refuse_entry(path, "must be numbers, or have the name of its 'file'");
    }
    name = file->get<std::string>();
    require_inside(name);
    FileContent content = read_from_folder(folder_, name, context_);
    name = display_name(folder_ / name);
    return std::move(content.bytes);
}

std::string_view FolderSource::get(const std::string& path, const SceneJson* entry, ListForm form) {
    if (!entry) refuse_entry(path, "must be there");
    with_number_type(form.type, [&](auto kind) {
        using Number = decltype(kind);
        if (entry->is_array()) {
            bytes_ = read_inline<Number>(path, *entry);
            return;
        }
        std::string name;
        const std::string text = read(path, *entry, name);
        bytes_ = read_lines<Number>(text, name, count_in(path, *entry, "count"));
    });
    return bytes_;
}

void FolderSource::get_surface(const std::string& path, const SceneJson& entry,
                               std::vector<Vec3>& positions, std::vector<Index>& offsets,
                               std::vector<Index>& corners) {
    std::string name;
    const std::string text = read(path, entry, name);
    ModelText model = read_model(text, name, false);
    const std::size_t count = model.coordinates.size() / 3;
    require_points(path, name, entry, model, count);
    positions.resize(count);
    if (count > 0) {
        std::memcpy(positions.front().data(), model.coordinates.data(), count * sizeof(Vec3));
    }
    offsets = std::move(model.offsets);
    corners = std::move(model.corners);
}

// The points of a strand follow each other.
void FolderSource::get_lines(const std::string& path, const SceneJson& entry,
                             std::vector<float>& points, std::vector<Index>& offsets) {
    std::string name;
    const std::string text = read(path, entry, name);
    ModelText model = read_model(text, name, true);
    require_points(path, name, entry, model, model.float_coordinates.size() / 3);
    for (Index k = 0; k < count_of(model.corners); ++k) {
        if (model.corners[at(k)] == k) continue;
        throw Error(ErrorCode::file_syntax,
                    name + ": the points of its lines do not follow each other");
    }
    points = std::move(model.float_coordinates);
    offsets = std::move(model.offsets);
}

}  // namespace lissom
