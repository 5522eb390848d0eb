#include "kernel/io/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "kernel/io/byte_reader.h"
#include "kernel/io/index_check.h"
#include "kernel/io/ply_header.h"
#include "kernel/io/ply_layout.h"
#include "kernel/io/text_reader.h"
#include "kernel/io/text_writer.h"
#include "kernel/io/ticker.h"

namespace lissom {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr std::string_view kCornerUv = "texcoord";

// ---- reading ----

// Numbers of a PLY file's text or binary data, one after the other.
class TextSource {
  public:
    TextSource(std::string_view bytes, const PlyHeader& header)
        : text_(bytes.substr(header.size), {}, header.lines) {}

    Tally& tally() { return text_.tally; }
    double number(ScalarType) { return text_.next_number(); }
    std::size_t remaining() const { return text_.remaining(); }
    double fraction() const { return text_.fraction(); }
    Place place(std::size_t) const { return text_.place(); }

  private:
    TextReader text_;
};

class BinarySource {
  public:
    BinarySource(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes.substr(header.size), header.endianness) {}

    Tally& tally() { return bytes_.tally; }
    double number(ScalarType type) { return bytes_.read(type); }
    std::size_t remaining() const { return bytes_.remaining(); }
    double fraction() const { return bytes_.fraction(); }
    Place place(std::size_t row) const { return {ElementKind::face, row}; }

  private:
    ByteReader bytes_;
};

template <typename Source>
class BodyReader {
  public:
    BodyReader(Source source, const PlyHeader& header, const Context& context)
        : source_(std::move(source)),
          header_(header),
          context_(context),
          progress_(context, "read PLY"),
          ticker_(progress_) {}

    MeshData read() {
        const bool has_faces = declares("face");
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else if (element.name == "tristrips" && !has_faces) {
                read_strips(element);
            } else {
                skip(element);
            }
        }
        if (!declares("vertex")) refuse(ErrorCode::file_syntax, "the file has no element 'vertex'");
        vertices_.require_below(mesh_.positions.size());
        for (Attribute& attribute : face_attributes_) {
            add_without_clash(mesh_.attributes, std::move(attribute));
        }
        log_skipped();
        return std::move(mesh_);
    }

  private:
    bool declares(std::string_view name) const {
        return std::any_of(header_.elements.begin(), header_.elements.end(),
                           [&](const PlyElement& e) { return e.name == name; });
    }

    static std::string_view plural(std::string_view element) {
        if (element == "vertex") return "vertices";
        return element == "face" ? "faces" : element;
    }

    // Reads the rows of an element into its slots and calls after_row(row) for each.
    template <typename AfterRow>
    void read_rows(const PlyElement& element, std::vector<PlySlot>& slots,
                   const AfterRow& after_row) {
        if (element.properties.empty()) return;
        source_.tally() = {plural(element.name), 0, element.count};
        for (std::size_t row = 0; row < element.count; ++row) {
            ticker_.tick([&] { return source_.fraction(); });
            for (std::size_t p = 0; p < slots.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                PlySlot& slot = slots[p];
                if (property.is_list) {
                    read_list(property, slot.list, row);
                    continue;
                }
                const double value = source_.number(property.type);
                if (!slot.out) continue;
                *slot.out = value / slot.divisor;
                slot.out += slot.stride;
            }
            after_row(row);
            ++source_.tally().found;
        }
    }

    void read_list(const PlyProperty& property, std::vector<double>* list, std::size_t row) {
        const double written = source_.number(property.count_type);
        if (!(written >= 0.0) || written != std::floor(written)) {
            refuse(ErrorCode::file_syntax,
                   "the list " + in_quotes(property.name) + " has no valid length",
                   source_.place(row));
        }
        if (written > static_cast<double>(source_.remaining())) refuse_truncated(source_.tally());
        const auto count = static_cast<std::size_t>(written);
        if (list) list->clear();
        for (std::size_t i = 0; i < count; ++i) {
            const double value = source_.number(property.type);
            if (list) list->push_back(value);
        }
    }

    // Rows that the rest of the file can hold. The last of them may be cut short.
    std::size_t possible_rows(const PlyElement& element) const {
        const std::size_t bytes = std::max<std::size_t>(1, element.minimum_bytes(header_.binary));
        return std::min(element.count, source_.remaining() / bytes + 2);
    }

    // Reads the rows of an element into the layout's attributes and lists.
    template <typename AfterRow>
    std::vector<Attribute> read_attributes(const PlyElement& element, PlyLayout& layout,
                                           const AfterRow& after_row) {
        layout.allocate(possible_rows(element));
        read_rows(element, layout.slots(), after_row);
        for (const std::string& property : layout.unplaced()) {
            skipped_.push_back("property " + in_quotes(property) + " of " +
                               in_quotes(element.name));
        }
        return layout.take_attributes();
    }

    void read_vertices(const PlyElement& element) {
        for (const char* name : {"x", "y", "z"}) {
            const Index property = element.find(name);
            if (property != kNoIndex && !element.properties[property].is_list) continue;
            refuse(ErrorCode::file_syntax, "vertices have no number '" + std::string(name) + "'");
        }
        PlyLayout layout(element, Domain::vertex);
        std::vector<Attribute> attributes = read_attributes(element, layout, [](std::size_t) {});
        take_positions(attributes.front().values);
        for (std::size_t i = 1; i < attributes.size(); ++i) {
            mesh_.attributes.add(std::move(attributes[i]));
        }
    }

    void take_positions(const std::vector<double>& values) {
        mesh_.positions.reserve(values.size() / 3);
        for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
            mesh_.positions.emplace_back(values[i], values[i + 1], values[i + 2]);
        }
    }

    void read_faces(const PlyElement& element) {
        PlyLayout layout(element, Domain::face);
        attach_indices(layout, element);
        const PlyProperty* const uv_list = layout.attach_list(kCornerUv, corner_uvs_);
        Attribute uv{"uv", Domain::corner, 2, uv_list ? uv_list->type : ScalarType::float32, {}};
        face_attributes_ = read_attributes(element, layout, [&](std::size_t row) {
            add_polygon(row);
            if (uv_list) append_corner_uvs(uv.values);
        });
        if (uv_list) face_attributes_.push_back(std::move(uv));
    }

    void attach_indices(PlyLayout& layout, const PlyElement& element) {
        if (layout.attach_list("vertex_indices", indices_)) return;
        if (layout.attach_list("vertex_index", indices_) || element.count == 0) return;
        refuse(ErrorCode::file_syntax,
               "the element " + in_quotes(element.name) + " has no list 'vertex_indices'");
    }

    std::int64_t to_index(double value, std::size_t row) const {
        constexpr double kLimit = 1e15;
        if (!(std::abs(value) < kLimit) || value != std::floor(value)) {
            refuse(ErrorCode::file_syntax, "a vertex index is not a whole number",
                   source_.place(row));
        }
        return static_cast<std::int64_t>(value);
    }

    void add_polygon(std::size_t row) {
        face_.clear();
        const Place place = source_.place(row);
        for (const double index : indices_) {
            face_.push_back(vertices_.checked(to_index(index, row), place));
        }
        add_face(mesh_.faces, face_);
    }

    void append_corner_uvs(std::vector<double>& uvs) const {
        const std::size_t count = 2 * face_.size();
        if (corner_uvs_.size() == count) {
            uvs.insert(uvs.end(), corner_uvs_.begin(), corner_uvs_.end());
        } else {
            uvs.insert(uvs.end(), count, kNone);
        }
    }

    void read_strips(const PlyElement& element) {
        PlyLayout layout(element, Domain::face);
        attach_indices(layout, element);
        read_rows(element, layout.slots(), [&](std::size_t row) { add_strip(row); });
    }

    // Each index makes a triangle with the two before it, every other one turned over; a negative
    // index starts a new strip. Triangles that use a vertex twice join parts of a strip and are no
    // faces.
    void add_strip(std::size_t row) {
        std::size_t length = 0;
        std::array<Index, 3> last{};
        for (const double value : indices_) {
            const std::int64_t index = to_index(value, row);
            if (index < 0) {
                length = 0;
                continue;
            }
            last = {last[1], last[2], vertices_.checked(index, source_.place(row))};
            const bool joins = last[0] == last[1] || last[1] == last[2] || last[0] == last[2];
            if (++length < 3 || joins) continue;
            const bool turned = length % 2 == 0;
            add_face(mesh_.faces, turned ? std::array{last[1], last[0], last[2]} : last);
        }
    }

    void skip(const PlyElement& element) {
        std::vector<PlySlot> nowhere(element.properties.size());
        read_rows(element, nowhere, [](std::size_t) {});
        if (element.count > 0) skipped_.push_back("element " + in_quotes(element.name));
    }

    void log_skipped() const {
        if (skipped_.empty()) return;
        std::string list;
        for (const std::string& what : skipped_) list += (list.empty() ? "" : ", ") + what;
        context_.log(LogLevel::warning, "skipped, because a mesh has no place for it: " + list);
    }

    Source source_;
    const PlyHeader& header_;
    const Context& context_;
    Progress progress_;
    Ticker ticker_;
    MeshData mesh_;
    std::vector<Attribute> face_attributes_;
    IndexCheck vertices_{"vertex", 0};
    std::vector<double> indices_, corner_uvs_;
    std::vector<Index> face_;
    std::vector<std::string> skipped_;
};

// ---- writing ----

// An attribute, or the positions, as properties of an element.
struct Column {
    std::vector<std::string> names;
    const double* values;
    Index width;
    ScalarType type;
    double scale;
};

bool can_hold(ScalarType type, double value) {
    return !std::isnan(value) && rounded_to(type, value) == value;
}

// The type that the attribute remembers, or double where that is an integer that cannot hold its
// values. Colours are rounded, so only those outside 0..1 do not fit.
ScalarType written_type(const Attribute& attribute, bool is_color) {
    if (!is_integer(attribute.type)) return attribute.type;
    const bool fits =
        std::all_of(attribute.values.begin(), attribute.values.end(), [&](double value) {
            return is_color ? value >= 0.0 && value <= 1.0 : can_hold(attribute.type, value);
        });
    return fits ? attribute.type : ScalarType::float64;
}

// The properties of one element that are single numbers.
class Columns {
  public:
    void add_positions(std::span<const Vec3> positions) {
        const bool floats = std::all_of(positions.begin(), positions.end(), [](const Vec3& p) {
            return is_float(p.x()) && is_float(p.y()) && is_float(p.z());
        });
        const ScalarType type = floats ? ScalarType::float32 : ScalarType::float64;
        const double* values = positions.empty() ? nullptr : positions.data()->data();
        columns_.push_back({{"x", "y", "z"}, values, 3, type, 1.0});
    }

    // Takes the attributes of a domain, but those whose properties would be read as something else.
    void add_attributes(SavedParts& parts, Domain domain) {
        const AttributeSet& attributes = parts.mesh().attributes();
        for (const Attribute& attribute : attributes.all()) {
            if (attribute.domain != domain) continue;
            const std::string name = face_attribute_name(attributes, attribute);
            std::vector<std::string> names = ply_property_names(name, attribute.width, domain);
            if (names.empty() || !reserve(names)) continue;
            parts.take(attribute);
            const bool is_color = is_ply_color(name, attribute.width);
            const ScalarType type = written_type(attribute, is_color);
            columns_.push_back({std::move(names), attribute.values.data(), attribute.width, type,
                                is_color ? color_divisor(type) : 1.0});
        }
    }

    std::vector<PlyProperty> properties() const {
        std::vector<PlyProperty> list;
        for (const Column& column : columns_) {
            for (const std::string& name : column.names) list.push_back({name, column.type});
        }
        return list;
    }

    const std::vector<Column>& all() const { return columns_; }

  private:
    bool reserve(const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            if (used_.contains(name)) return false;
        }
        used_.insert(names.begin(), names.end());
        return true;
    }

    std::vector<Column> columns_;
    std::set<std::string> used_{"x", "y", "z", "vertex_indices", "vertex_index", "texcoord"};
};

// Appends rows of numbers to a file's data.
class RowWriter {
  public:
    RowWriter(const PlyHeader& header, std::string& bytes) : header_(header), bytes_(bytes) {}

    void write(ScalarType type, double value) {
        if (header_.binary) return write_binary(type, value);
        if (!row_is_empty_) bytes_ += ' ';
        row_is_empty_ = false;
        if (is_integer(type)) {
            append_number(bytes_, static_cast<std::int64_t>(value));
        } else {
            append_number(bytes_, value);
        }
    }
    void write(const std::vector<Column>& columns, Index row) {
        for (const Column& column : columns) {
            const double* values = column.values + static_cast<std::size_t>(row) * column.width;
            for (Index k = 0; k < column.width; ++k) {
                const double value = values[k] * column.scale;
                write(column.type,
                      is_integer(column.type) ? rounded_to(column.type, value) : value);
            }
        }
    }
    template <typename Numbers>
    void write_list(const PlyProperty& property, const Numbers& numbers) {
        write(property.count_type, static_cast<double>(numbers.size()));
        for (const auto number : numbers) write(property.type, number);
    }
    void end_row() {
        if (!header_.binary) bytes_ += '\n';
        row_is_empty_ = true;
    }

  private:
    void write_binary(ScalarType type, double value) {
        with_scalar(type, [&](auto zero) {
            const auto number =
                with_byte_order(static_cast<decltype(zero)>(value), header_.endianness);
            char raw[sizeof(number)];
            std::memcpy(raw, &number, sizeof(number));
            bytes_.append(raw, sizeof(number));
        });
    }

    const PlyHeader& header_;
    std::string& bytes_;
    bool row_is_empty_ = true;
};

Index largest_face(const Topology& topology) {
    Index largest = 0;
    for (Index f = 0; f < topology.face_count(); ++f) {
        largest = std::max(largest, static_cast<Index>(topology.face(f).size()));
    }
    return largest;
}

ScalarType count_type(Index largest) {
    return largest < 256 ? ScalarType::uint8 : ScalarType::uint32;
}

// Values of one face's corners; none where a corner has none.
std::span<const double> corner_values(const Attribute& attribute, Index first, Index count) {
    const std::span<const double> values(
        attribute.values.data() + static_cast<std::size_t>(first) * attribute.width,
        static_cast<std::size_t>(count) * attribute.width);
    const bool none =
        std::all_of(values.begin(), values.end(), [](double x) { return std::isnan(x); });
    return none ? std::span<const double>() : values;
}

class PlyWriter {
  public:
    PlyWriter(SavedParts& parts, const SaveOptions& options, std::string& bytes)
        : mesh_(parts.mesh()),
          corner_uv_(parts.take("uv", {Domain::corner}, {2})),
          header_{options.binary, options.endianness, {}},
          rows_(header_, bytes),
          bytes_(bytes) {
        vertex_columns_.add_positions(mesh_.positions());
        vertex_columns_.add_attributes(parts, Domain::vertex);
        face_columns_.add_attributes(parts, Domain::face);
    }

    void write(const Context& context) {
        Progress progress(context, "write PLY");
        Ticker ticker(progress);
        declare_elements();
        bytes_ += to_text(header_);
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            ticker.tick([&] { return 0.5 * v / mesh_.vertex_count(); });
            rows_.write(vertex_columns_.all(), v);
            rows_.end_row();
        }
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            ticker.tick([&] { return 0.5 + 0.5 * f / mesh_.face_count(); });
            write_face(f);
        }
    }

  private:
    void declare_elements() {
        const Index largest = largest_face(mesh_.topology());
        indices_ = {"vertex_indices", ScalarType::int32, true, count_type(largest)};
        std::vector<PlyProperty> of_faces{indices_};
        if (corner_uv_) {
            uvs_ = {std::string(kCornerUv), written_type(*corner_uv_, false), true,
                    count_type(2 * largest)};
            of_faces.push_back(uvs_);
        }
        const std::vector<PlyProperty> numbers = face_columns_.properties();
        of_faces.insert(of_faces.end(), numbers.begin(), numbers.end());
        header_.elements = {
            {"vertex", static_cast<std::size_t>(mesh_.vertex_count()),
             vertex_columns_.properties()},
            {"face", static_cast<std::size_t>(mesh_.face_count()), std::move(of_faces)}};
    }

    void write_face(Index f) {
        const std::span<const Index> face = mesh_.topology().face(f);
        rows_.write_list(indices_, face);
        if (corner_uv_) {
            rows_.write_list(uvs_, corner_values(*corner_uv_, mesh_.topology().first_corner(f),
                                                 static_cast<Index>(face.size())));
        }
        rows_.write(face_columns_.all(), f);
        rows_.end_row();
    }

    const Mesh& mesh_;
    const Attribute* corner_uv_;
    Columns vertex_columns_, face_columns_;
    PlyHeader header_;
    PlyProperty indices_, uvs_;
    RowWriter rows_;
    std::string& bytes_;
};

}  // namespace

MeshData read_ply(std::string_view bytes, const Context& context) {
    const PlyHeader header = read_ply_header(bytes);
    if (header.binary) return BodyReader(BinarySource(bytes, header), header, context).read();
    return BodyReader(TextSource(bytes, header), header, context).read();
}

void write_ply(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context) {
    PlyWriter(parts, options, bytes).write(context);
}

}  // namespace lissom
