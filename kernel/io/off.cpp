#include "kernel/io/off.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/io/byte_reader.h"
#include "kernel/io/color_reader.h"
#include "kernel/io/index_check.h"
#include "kernel/io/text_reader.h"
#include "kernel/io/text_writer.h"
#include "kernel/io/ticker.h"

namespace lissom {
namespace {

constexpr TextReader::Style kStyle{.comment = '#', .continuation = false};

// What the vertices have beside positions, in the order of the file.
struct OffLayout {
    bool normals = false, colors = false, uvs = false;
};

bool begins_number(std::string_view word) {
    return (word[0] >= '0' && word[0] <= '9') || word[0] == '-' || word[0] == '+';
}

// What the keyword says: [ST][C][N][4][n]OFF.
std::optional<OffLayout> parse_keyword(std::string_view word, Place place) {
    if (!word.ends_with("OFF")) return std::nullopt;
    OffLayout layout;
    for (std::string_view prefix = word.substr(0, word.size() - 3); !prefix.empty();) {
        if (prefix.starts_with("ST")) {
            layout.uvs = true;
            prefix.remove_prefix(1);
        } else if (prefix[0] == 'C') {
            layout.colors = true;
        } else if (prefix[0] == 'N') {
            layout.normals = true;
        } else if (prefix[0] == '4' || prefix[0] == 'n') {
            refuse(ErrorCode::unsupported,
                   "points of " + in_quotes(word) +
                       " have other than three coordinates; convert it to OFF",
                   place);
        } else {
            return std::nullopt;
        }
        prefix.remove_prefix(1);
    }
    return layout;
}

// Numbers of a vertex without its colour.
std::size_t numbers_without_color(OffLayout layout) {
    return 3 + (layout.normals ? 3 : 0) + (layout.uvs ? 2 : 0);
}

// What text and binary data have in common.
struct OffBuilder {
    OffLayout layout;
    ScalarType number_type = ScalarType::float64;
    std::size_t vertex_count = 0, face_count = 0;
    MeshData mesh;
    std::vector<double> normals, uvs;
    ColorReader vertex_colors, face_colors;
    IndexCheck vertices{"vertex", 0};
    std::vector<Index> face;

    // Reads a vertex by next(), which gives the next number.
    template <typename Next>
    void add_vertex(std::size_t color_width, const Next& next) {
        const double x = next(), y = next(), z = next();
        if (layout.normals) {
            for (int k = 0; k < 3; ++k) normals.push_back(next());
        }
        if (color_width > 0) {
            std::array<double, 4> color{};
            for (std::size_t k = 0; k < color_width; ++k) color[k] = next();
            vertex_colors.set(mesh.positions.size(), {color.data(), color_width});
        }
        if (layout.uvs) {
            for (int k = 0; k < 2; ++k) uvs.push_back(next());
        }
        mesh.positions.emplace_back(x, y, z);
    }

    MeshData finish() {
        vertices.require_below(mesh.positions.size());
        add("normal", 3, std::move(normals));
        vertex_colors.finish(mesh.attributes, Domain::vertex, mesh.positions.size());
        add("uv", 2, std::move(uvs));
        face_colors.finish(mesh.attributes, Domain::face,
                           static_cast<std::size_t>(mesh.faces.size()));
        return std::move(mesh);
    }

    void add(const char* name, Index width, std::vector<double> values) {
        if (values.empty()) return;
        mesh.attributes.add({name, Domain::vertex, width, number_type, std::move(values)});
    }
};

class OffTextReader {
  public:
    OffTextReader(TextReader text, std::size_t file_bytes, OffLayout layout, const Context& context)
        : text_(text), file_bytes_(file_bytes), context_(context) {
        builder_.layout = layout;
    }

    MeshData read() {
        Progress progress(context_, "read OFF");
        Ticker ticker(progress);
        read_counts();
        const std::size_t color_width = find_color_width();
        text_.tally = {"vertices", 0, builder_.vertex_count};
        for (; text_.tally.found < builder_.vertex_count; ++text_.tally.found) {
            ticker.tick([&] { return text_.fraction(); });
            builder_.add_vertex(color_width, [&] { return text_.next_number(); });
        }
        text_.tally = {"faces", 0, builder_.face_count};
        for (; text_.tally.found < builder_.face_count; ++text_.tally.found) {
            ticker.tick([&] { return text_.fraction(); });
            read_face();
        }
        log_skipped();
        return builder_.finish();
    }

  private:
    void read_counts() {
        text_.tally.elements = "counts";
        builder_.vertex_count = read_count("vertices");
        builder_.face_count = read_count("faces");
        if (!text_.at_line_end()) text_.integer();
    }

    std::size_t read_count(std::string_view elements) {
        const std::int64_t count = text_.next_integer();
        return checked_count(count, file_bytes_, elements, text_.place());
    }

    // The line of the first vertex tells how many values a colour has: three, four, or none,
    // whatever the keyword says. Where a vertex takes several lines, or a line several vertices,
    // the keyword decides, and a colour has four.
    std::size_t find_color_width() {
        const std::size_t others = numbers_without_color(builder_.layout);
        const std::size_t found = numbers_on_next_line();
        if (found < others || found > others + 4) return builder_.layout.colors ? 4 : 0;
        const std::size_t rest = found - others;
        if (rest == 0 || rest >= 3) return rest;
        refuse(ErrorCode::file_syntax,
               "the first vertex has " + std::to_string(found) + " numbers, but " +
                   std::to_string(others) + " and a colour of 3 or 4 were expected",
               text_.place());
    }

    std::size_t numbers_on_next_line() {
        if (builder_.vertex_count == 0 || text_.at_end()) return 0;
        TextReader ahead = text_;
        std::size_t count = 0;
        for (; !ahead.at_line_end(); ++count) ahead.number();
        return count;
    }

    void read_face() {
        const std::int64_t size = text_.next_integer();
        const Place place = text_.place();
        if (size < 0) {
            refuse(ErrorCode::file_syntax, "a face has " + std::to_string(size) + " vertices",
                   place);
        }
        if (static_cast<std::uint64_t>(size) > text_.remaining()) refuse_truncated(text_.tally);
        builder_.face.clear();
        for (std::int64_t k = 0; k < size; ++k) {
            const std::int64_t index = text_.next_integer();
            builder_.face.push_back(builder_.vertices.checked(index, text_.place()));
        }
        read_face_color();
        add_face(builder_.mesh.faces, builder_.face);
    }

    // A colour is the rest of the line.
    void read_face_color() {
        std::array<double, 4> color{};
        std::size_t width = 0;
        while (width < 4 && !text_.at_line_end()) color[width++] = text_.number();
        if (width == 0) return;
        if (width < 3) {
            ++skipped_colors_;
        } else {
            builder_.face_colors.set(static_cast<std::size_t>(builder_.mesh.faces.size()),
                                     {color.data(), width});
        }
        if (text_.at_line_end()) return;
        refuse(ErrorCode::file_syntax, "a face has more numbers than vertices and a colour of 4",
               text_.place());
    }

    void log_skipped() const {
        if (skipped_colors_ == 0) return;
        context_.log(LogLevel::warning,
                     "the colours of " + std::to_string(skipped_colors_) +
                         " faces were skipped; they are indices into a colour map");
    }

    TextReader text_;
    std::size_t file_bytes_;
    OffBuilder builder_;
    const Context& context_;
    std::size_t skipped_colors_ = 0;
};

// How binary data are laid out. In Geomview's each face ends with the number of its colour values
// and these; the other kind has no such number.
struct BinaryKind {
    Endianness order;
    bool has_color_counts;
};

constexpr std::array<BinaryKind, 3> kBinaryKinds{
    {{Endianness::big, true}, {Endianness::little, false}, {Endianness::big, false}}};

struct BinaryCounts {
    std::uint32_t vertices, faces;
};

BinaryCounts read_binary_counts(ByteReader& data) {
    data.tally.elements = "counts";
    const auto vertices = data.read<std::uint32_t>(), faces = data.read<std::uint32_t>();
    data.skip(sizeof(std::uint32_t));
    return {vertices, faces};
}

std::size_t binary_vertex_bytes(OffLayout layout) {
    return sizeof(float) * (numbers_without_color(layout) + (layout.colors ? 4 : 0));
}

// Moves over a number and as many numbers of four bytes; false where the data end before.
bool skip_counted(ByteReader& data) {
    if (data.remaining() < 4) return false;
    const std::size_t bytes = std::size_t{4} * data.read<std::uint32_t>();
    if (data.remaining() < bytes) return false;
    data.skip(bytes);
    return true;
}

// True where the data, taken to be of this kind, end with the last face.
bool fits(std::string_view bytes, OffLayout layout, BinaryKind kind) {
    ByteReader data(bytes, kind.order);
    const BinaryCounts counts = read_binary_counts(data);
    const std::size_t vertex_bytes = counts.vertices * binary_vertex_bytes(layout);
    if (vertex_bytes > data.remaining()) return false;
    data.skip(vertex_bytes);
    for (std::uint32_t f = 0; f < counts.faces; ++f) {
        if (!skip_counted(data) || (kind.has_color_counts && !skip_counted(data))) return false;
    }
    return data.remaining() == 0;
}

// The kind that the data fit exactly. Where they fit none, for instance because they are cut short,
// the byte order is the one with the smaller counts.
BinaryKind find_kind(std::string_view bytes, OffLayout layout) {
    for (const BinaryKind kind : kBinaryKinds) {
        if (fits(bytes, layout, kind)) return kind;
    }
    ByteReader big(bytes, Endianness::big), little(bytes, Endianness::little);
    const bool is_big = read_binary_counts(big).vertices <= read_binary_counts(little).vertices;
    return kBinaryKinds[is_big ? 0 : 1];
}

class OffBinaryReader {
  public:
    OffBinaryReader(std::string_view bytes, OffLayout layout, const Context& context)
        : bytes_(bytes),
          context_(context),
          kind_(find_kind(bytes, layout)),
          data_(bytes, kind_.order) {
        builder_.layout = layout;
        builder_.number_type = ScalarType::float32;
    }

    MeshData read() {
        Progress progress(context_, "read OFF");
        Ticker ticker(progress);
        const BinaryCounts counts = read_binary_counts(data_);
        builder_.vertex_count = checked_count(counts.vertices, bytes_.size(), "vertices", {});
        builder_.face_count = checked_count(counts.faces, bytes_.size(), "faces", {});

        data_.tally = {"vertices", 0, builder_.vertex_count};
        const std::size_t color_width = builder_.layout.colors ? 4 : 0;
        for (; data_.tally.found < builder_.vertex_count; ++data_.tally.found) {
            ticker.tick([&] { return data_.fraction(); });
            builder_.add_vertex(color_width, [&] { return data_.read<float>(); });
        }
        data_.tally = {"faces", 0, builder_.face_count};
        for (; data_.tally.found < builder_.face_count; ++data_.tally.found) {
            ticker.tick([&] { return data_.fraction(); });
            read_face();
        }
        return builder_.finish();
    }

  private:
    std::size_t read_length() {
        const auto length = data_.read<std::uint32_t>();
        if (length > data_.remaining() / 4) refuse_truncated(data_.tally);
        return length;
    }

    void read_face() {
        const Place place{ElementKind::face, data_.tally.found};
        builder_.face.clear();
        for (std::size_t k = read_length(); k > 0; --k) {
            builder_.face.push_back(builder_.vertices.checked(data_.read<std::int32_t>(), place));
        }
        if (kind_.has_color_counts) read_face_color();
        add_face(builder_.mesh.faces, builder_.face);
    }

    void read_face_color() {
        std::array<double, 4> color{};
        const std::size_t width = read_length();
        for (std::size_t k = 0; k < width; ++k) {
            const double value = data_.read<float>();
            if (k < 4) color[k] = value;
        }
        if (width < 3) return;
        builder_.face_colors.set(static_cast<std::size_t>(builder_.mesh.faces.size()),
                                 {color.data(), std::min<std::size_t>(width, 4)});
    }

    std::string_view bytes_;
    const Context& context_;
    BinaryKind kind_;
    ByteReader data_;
    OffBuilder builder_;
};

// ---- writing ----

// Colours are written as bytes where they were bytes and can be told from numbers between 0 and 1.
bool as_bytes(const Attribute& color) {
    if (color.type != ScalarType::uint8) return false;
    const auto end = color.values.end();
    const bool fits = std::all_of(color.values.begin(), end, [&](double value) {
        return (value >= 0.0 && value <= 1.0) ||
               (color.domain == Domain::face && std::isnan(value));
    });
    return fits &&
           std::any_of(color.values.begin(), end, [](double v) { return v * 255.0 >= 1.5; });
}

class ColorWriter {
  public:
    explicit ColorWriter(const Attribute* color)
        : color_(color), bytes_(color && as_bytes(*color)) {}

    void write(Index element, std::string& text) const {
        if (!color_) return;
        const std::span<const double> values = color_->at(element);
        if (color_->domain == Domain::face && std::isnan(values[0])) return;
        for (const double value : values) {
            text += ' ';
            if (bytes_) {
                append_number(text, static_cast<int>(std::lround(value * 255.0)));
            } else {
                append_number(text, value);
            }
        }
    }

  private:
    const Attribute* color_;
    bool bytes_;
};

}  // namespace

MeshData read_off(std::string_view bytes, const Context& context) {
    const TextReader start(bytes, kStyle);
    TextReader text = start;
    text.tally.elements = "keywords";
    const std::string_view keyword = text.next_word();
    const std::optional<OffLayout> layout = parse_keyword(keyword, text.place());
    if (!layout) {
        if (!begins_number(keyword)) {
            refuse(ErrorCode::file_syntax,
                   "expected the keyword 'OFF', found " + in_quotes(keyword), text.place());
        }
        return OffTextReader(start, bytes.size(), {}, context).read();
    }
    TextReader ahead = text;
    if (ahead.word() != "BINARY") return OffTextReader(text, bytes.size(), *layout, context).read();
    ahead.skip_line();
    return OffBinaryReader(bytes.substr(ahead.offset()), *layout, context).read();
}

void write_off(SavedParts& parts, const SaveOptions&, std::string& text, const Context& context) {
    const Mesh& mesh = parts.mesh();
    const Topology& topology = mesh.topology();
    Progress progress(context, "write OFF");
    Ticker ticker(progress);
    const Attribute* const uv = parts.take("uv", {Domain::vertex}, {2});
    const Attribute* const normal = parts.take("normal", {Domain::vertex}, {3});
    const Attribute* const color = parts.take("color", {Domain::vertex}, {3, 4});
    const ColorWriter vertex_colors(color);
    const ColorWriter face_colors(
        parts.take(color ? "face_color" : "color", {Domain::face}, {3, 4}));

    text += uv ? "ST" : "";
    text += color ? "C" : "";
    text += normal ? "N" : "";
    text += "OFF";
    text += "\n# Written by Lissom\n";
    append_number(text, mesh.vertex_count());
    append_numbers(text, std::array{mesh.face_count(), topology.edge_count()});
    text += '\n';
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        ticker.tick([&] { return 0.5 * v / mesh.vertex_count(); });
        const Vec3& position = mesh.position(v);
        append_number(text, position.x());
        append_numbers(text, std::array{position.y(), position.z()});
        if (normal) append_numbers(text, normal->at(v));
        vertex_colors.write(v, text);
        if (uv) append_numbers(text, uv->at(v));
        text += '\n';
    }
    for (Index f = 0; f < topology.face_count(); ++f) {
        ticker.tick([&] { return 0.5 + 0.5 * f / topology.face_count(); });
        append_number(text, topology.face(f).size());
        append_numbers(text, topology.face(f));
        face_colors.write(f, text);
        text += '\n';
    }
}

}  // namespace lissom
