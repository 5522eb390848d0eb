#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <utility>

#include "kernel/io/ply/header.h"
#include "kernel/io/ply/layout.h"
#include "kernel/io/ply/ply.h"
#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

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

// Returns the type that the attribute remembers, or double if that is an integer that cannot hold
// its values. Colours are rounded, so only those outside 0..1 do not fit.
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

    // Takes the attributes of a domain, but those for whose properties there is no free name.
    void add_attributes(SavedParts& parts, Domain domain) {
        const AttributeSet& attributes = parts.mesh().attributes();
        for (const Attribute& attribute : attributes.all()) {
            if (attribute.domain != domain) continue;
            const std::string name = face_attribute_name(attributes, attribute);
            std::vector<std::string> names = ply_property_names(name, attribute.width, domain);
            if (!reserve(names)) {
                names = ply_property_names(name, attribute.width, domain, true);
                if (!reserve(names)) continue;
            }
            parts.take(attribute);
            const bool is_color = is_ply_color(name, attribute.width);
            const ScalarType type = written_type(attribute, is_color);
            columns_.push_back({std::move(names), attribute.values.data(), attribute.width, type,
                                is_color ? color_divisor(type) : 1.0});
        }
    }

    // Before the attributes, which can have other names.
    void add_regions(SavedParts& parts) {
        const std::size_t vertex_count = parts.mesh().vertex_count();
        for (const auto& [name, region] : parts.take_regions()) {
            std::vector<double> is_inside(vertex_count, 0.0);
            for (const Index v : region.vertices()) is_inside[v] = 1.0;
            add_own(std::string(kPlyRegionPrefix) + percent_encoded(name), ScalarType::uint8,
                    std::move(is_inside));
        }
    }
    void add_labels(const std::string& kind, const FaceLabels& labels) {
        add_own(percent_encoded(kind), ScalarType::int32,
                {labels.of_face.begin(), labels.of_face.end()});
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

    void add_own(std::string name, ScalarType type, std::vector<double> values) {
        used_.insert(name);
        own_values_.push_back(std::move(values));
        columns_.push_back({{std::move(name)}, own_values_.back().data(), 1, type, 1.0});
    }

    std::vector<Column> columns_;
    std::deque<std::vector<double>> own_values_;
    std::set<std::string> used_;
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
            const double* values = column.values + at(row) * column.width;
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
            append_number(bytes_, static_cast<decltype(zero)>(value), header_.endianness);
        });
    }

    const PlyHeader& header_;
    std::string& bytes_;
    bool row_is_empty_ = true;
};

Index largest_face(const Topology& topology) {
    Index largest = 0;
    for (Index f = 0; f < topology.face_count(); ++f) {
        largest = std::max(largest, count_of(topology.face(f)));
    }
    return largest;
}

ScalarType count_type(Index largest) {
    return largest < 256 ? ScalarType::uint8 : ScalarType::uint32;
}

// An attribute of corners, as a list of the faces.
struct ListColumn {
    const Attribute* attribute;
    PlyProperty property;
    double scale;
};

// The numbers of one face's corners as they are written; none if no corner has a value.
std::vector<double> list_of_face(const ListColumn& list, Index first_corner, Index count) {
    const Attribute& attribute = *list.attribute;
    const std::size_t width = attribute.width;
    const auto begin = attribute.values.begin() + first_corner * width;
    std::vector<double> values(begin, begin + (count * width));
    const bool has_none =
        std::all_of(values.begin(), values.end(), [](double x) { return std::isnan(x); });
    if (has_none) return {};
    for (double& value : values) {
        value *= list.scale;
        if (is_integer(list.property.type)) value = rounded_to(list.property.type, value);
    }
    return values;
}

class PlyWriter {
  public:
    PlyWriter(SavedParts& parts, const SaveOptions& options, std::string& bytes)
        : mesh_(parts.mesh()), rows_(header_, bytes), bytes_(bytes) {
        header_.binary = options.binary;
        header_.endianness = options.endianness;
        header_.material_libraries = parts.take_material_libraries();
        vertex_columns_.add_positions(mesh_.positions());
        vertex_columns_.add_regions(parts);
        vertex_columns_.add_attributes(parts, Domain::vertex);
        take_labels(parts);
        face_columns_.add_attributes(parts, Domain::face);
        take_corner_attributes(parts);
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
    void take_labels(SavedParts& parts) {
        for (const auto& [kind, labels] : mesh_.attributes().labels()) {
            parts.take_labels(kind);
            if (labels.names.empty()) continue;
            header_.label_names[kind] = labels.names;
            face_columns_.add_labels(kind, labels);
        }
    }

    void take_corner_attributes(SavedParts& parts) {
        const Index largest = largest_face(mesh_.topology());
        for (const Attribute& attribute : mesh_.attributes().all()) {
            if (attribute.domain != Domain::corner) continue;
            if (attribute.width > kPlyLargestCornerWidth) continue;
            parts.take(attribute);
            const bool is_color = is_ply_color(attribute.name, attribute.width);
            const ScalarType type = written_type(attribute, is_color);
            PlyProperty property{ply_list_name(attribute), type, true,
                                 count_type(attribute.width * largest)};
            lists_.push_back(
                {&attribute, std::move(property), is_color ? color_divisor(type) : 1.0});
        }
    }

    void declare_elements() {
        indices_ = {"vertex_indices", ScalarType::int32, true,
                    count_type(largest_face(mesh_.topology()))};
        std::vector<PlyProperty> of_faces{indices_};
        for (const ListColumn& list : lists_) of_faces.push_back(list.property);
        const std::vector<PlyProperty> numbers = face_columns_.properties();
        of_faces.insert(of_faces.end(), numbers.begin(), numbers.end());
        header_.elements = {{"vertex", at(mesh_.vertex_count()), vertex_columns_.properties()},
                            {"face", at(mesh_.face_count()), std::move(of_faces)}};
    }

    void write_face(Index f) {
        const std::span<const Index> face = mesh_.topology().face(f);
        rows_.write_list(indices_, face);
        for (const ListColumn& list : lists_) {
            rows_.write_list(list.property,
                             list_of_face(list, mesh_.topology().first_corner(f), count_of(face)));
        }
        rows_.write(face_columns_.all(), f);
        rows_.end_row();
    }

    const Mesh& mesh_;
    Columns vertex_columns_, face_columns_;
    std::vector<ListColumn> lists_;
    PlyHeader header_;
    PlyProperty indices_;
    RowWriter rows_;
    std::string& bytes_;
};

}  // namespace

void write_ply(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context) {
    PlyWriter(parts, options, bytes).write(context);
}

}  // namespace lissom
