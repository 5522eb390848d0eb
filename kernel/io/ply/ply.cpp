#include "kernel/io/ply/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "kernel/core/geometry.h"
#include "kernel/io/ply/header.h"
#include "kernel/io/ply/layout.h"
#include "kernel/io/ply/number_source.h"
#include "kernel/io/record/finite_values.h"
#include "kernel/io/record/index_check.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// The values of the corners of faces, which a list of each face holds.
class CornerList {
  public:
    explicit CornerList(Attribute attribute)
        : attribute_(std::move(attribute)),
          divisor_(is_ply_color(attribute_.name, attribute_.width) ? color_divisor(attribute_.type)
                                                                   : 1.0) {}

    // The list of the face that is being read.
    std::vector<double>& row() { return row_; }
    const Attribute& attribute() const { return attribute_; }

    // Adds the values of a face; none if the list is of another length. Returns the number of
    // values that were made up so.
    std::size_t add_face(std::size_t corners) {
        const std::size_t count = corners * attribute_.width;
        if (row_.size() != count) {
            mismatched_ += row_.empty() ? 0 : 1;
            attribute_.values.insert(attribute_.values.end(), count, kNone);
            return count;
        }
        for (const double value : row_) attribute_.values.push_back(value / divisor_);
        return 0;
    }
    // Lists that were not of the length that their face needs.
    std::size_t mismatched() const { return mismatched_; }
    Attribute take() { return std::move(attribute_); }

  private:
    Attribute attribute_;
    double divisor_;
    std::vector<double> row_;
    std::size_t mismatched_ = 0;
};

FaceLabels to_labels(const Attribute& numbers, std::vector<std::string> names,
                     std::size_t& dangling) {
    FaceLabels labels{std::move(names), {}};
    labels.of_face.reserve(numbers.values.size());
    for (const double number : numbers.values) {
        const bool exists = number >= 0.0 && number < labels.names.size();
        labels.of_face.push_back(exists ? static_cast<Index>(number) : kNoIndex);
        dangling += !exists && number != kNoIndex ? 1 : 0;
    }
    return labels;
}

// The elements whose number is 1, or nothing if numbers are not 0 or 1.
std::optional<std::vector<Index>> to_region(const Attribute& numbers) {
    std::vector<Index> region;
    for (std::size_t i = 0; i < numbers.values.size(); ++i) {
        if (numbers.values[i] == 1.0) {
            region.push_back(index_of(i));
        } else if (numbers.values[i] != 0.0) {
            return std::nullopt;
        }
    }
    return region;
}

template <typename Source>
class BodyReader {
  public:
    BodyReader(Source source, const PlyHeader& header, const Context& context)
        : source_(std::move(source)),
          header_(header),
          progress_(context, "read PLY"),
          ticker_(progress_) {}

    MeshData read() {
        file_bytes_ = source_.remaining();
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
        finish();
        return std::move(mesh_);
    }

  private:
    bool declares(std::string_view name) const {
        return std::any_of(header_.elements.begin(), header_.elements.end(),
                           [&](const PlyElement& e) { return e.name == name; });
    }

    static std::string_view plural(std::string_view element) {
        if (element == "vertex") return "vertices";
        return element == "face" ? "faces" : "elements that a mesh has no place for";
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
                   source_.place(ElementKind::face, row));
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

    // Reads the rows of an element into the layout's columns and lists.
    template <typename AfterRow>
    std::vector<PlyColumn> read_columns(const PlyElement& element, PlyLayout& layout,
                                        const AfterRow& after_row) {
        layout.allocate(possible_rows(element));
        read_rows(element, layout.slots(), after_row);
        for (const std::string& property : layout.unplaced()) {
            skipped_.add("of property " + in_quotes(property) + " of " + in_quotes(element.name),
                         element.count);
        }
        return layout.take_columns();
    }

    void read_vertices(const PlyElement& element) {
        for (const char* name : {"x", "y", "z"}) {
            const Index property = element.find(name);
            if (property != kNoIndex && !element.properties[property].is_list) continue;
            refuse(ErrorCode::file_syntax, "vertices have no number '" + std::string(name) + "'");
        }
        PlyLayout layout(header_, element, Domain::vertex);
        for (PlyColumn& column : read_columns(element, layout, [](std::size_t) {})) {
            take_vertex_column(std::move(column));
        }
    }

    void take_vertex_column(PlyColumn column) {
        if (column.role == PlyRole::position) return take_positions(column.attribute.values);
        if (column.role != PlyRole::region) {
            mesh_.attributes.add(std::move(column.attribute));
        } else if (auto region = to_region(column.attribute)) {
            mesh_.regions.emplace(column.attribute.name, std::move(*region));
        } else {
            column.attribute.name = std::string(kPlyRegionPrefix) + column.attribute.name;
            mesh_.attributes.add(std::move(column.attribute));
        }
    }

    void take_positions(const std::vector<double>& values) {
        mesh_.positions.reserve(values.size() / 3);
        for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
            mesh_.positions.emplace_back(values[i], values[i + 1], values[i + 2]);
        }
    }

    void read_faces(const PlyElement& element) {
        PlyLayout layout(header_, element, Domain::face);
        attach_indices(layout, element);
        for (const PlyProperty& property : element.properties) attach_corners(layout, property);
        face_columns_ = read_columns(element, layout, [&](std::size_t row) {
            add_polygon(row);
            for (CornerList& list : corner_lists_) {
                made_up_ += list.add_face(face_.size());
            }
            require_reasonable_size();
        });
    }

    void attach_indices(PlyLayout& layout, const PlyElement& element) {
        if (layout.attach_list("vertex_indices", indices_)) return;
        if (layout.attach_list("vertex_index", indices_) || element.count == 0) return;
        refuse(ErrorCode::file_syntax,
               "the element " + in_quotes(element.name) + " has no list 'vertex_indices'");
    }

    void attach_corners(PlyLayout& layout, const PlyProperty& property) {
        if (!property.is_list) return;
        std::optional<Attribute> attribute = ply_corner_attribute(property);
        if (!attribute) return;
        corner_lists_.emplace_back(std::move(*attribute));
        if (!layout.attach_list(property.name, corner_lists_.back().row())) {
            corner_lists_.pop_back();
        }
    }

    // An empty list takes one byte of the file, but stands for many values.
    void require_reasonable_size() const {
        constexpr std::size_t kValuesInByte = 32, kAlways = 1 << 20;
        if (made_up_ < kAlways || made_up_ / kValuesInByte < file_bytes_) return;
        refuse(ErrorCode::file_too_large,
               "the values of corners, most of which are absent, would take more than 250 times as "
               "much memory as the file");
    }

    std::int64_t to_index(double value, std::size_t row) const {
        constexpr double kLimit = 1e15;
        if (!(std::abs(value) < kLimit) || value != std::floor(value)) {
            refuse(ErrorCode::file_syntax, "a vertex index is not a whole number",
                   source_.place(ElementKind::face, row));
        }
        return static_cast<std::int64_t>(value);
    }

    void add_polygon(std::size_t row) {
        face_.clear();
        const FilePlace place = source_.place(ElementKind::face, row);
        for (const double index : indices_) {
            face_.push_back(vertices_.checked(to_index(index, row), place));
        }
        add_face(mesh_.faces, face_);
    }

    void read_strips(const PlyElement& element) {
        PlyLayout layout(header_, element, Domain::face);
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
            last = {last[1], last[2],
                    vertices_.checked(index, source_.place(ElementKind::face, row))};
            const bool joins = last[0] == last[1] || last[1] == last[2] || last[0] == last[2];
            if (++length < 3 || joins) continue;
            const bool turned = length % 2 == 0;
            add_face(mesh_.faces, turned ? std::array{last[1], last[0], last[2]} : last);
        }
    }

    void skip(const PlyElement& element) {
        std::vector<PlySlot> nowhere(element.properties.size());
        read_rows(element, nowhere, [](std::size_t) {});
        skipped_.add("of element " + in_quotes(element.name), element.count);
    }

    void finish() {
        mesh_.material_libraries = header_.material_libraries;
        for (CornerList& list : corner_lists_) {
            add_corner_values(list.take());
            skipped_.add("lists of another length than their face", list.mismatched());
        }
        for (PlyColumn& column : face_columns_) {
            if (column.role == PlyRole::labels) {
                add_labels(column.attribute);
            } else {
                add_without_clash(mesh_.attributes, std::move(column.attribute));
            }
        }
        drop_infinite_values(mesh_.attributes, mesh_.report);
        skipped_.finish(mesh_.report);
    }

    void add_corner_values(Attribute attribute) {
        if (mesh_.attributes.find(attribute.name)) {
            skipped_.add("values of vertices that corners have too", mesh_.positions.size());
        }
        mesh_.attributes.add(std::move(attribute));
    }

    void add_labels(const Attribute& numbers) {
        std::size_t dangling = 0;
        const auto names = header_.label_names.find(numbers.name);
        mesh_.attributes.labels()[numbers.name] = to_labels(numbers, names->second, dangling);
        if (dangling == 0) return;
        mesh_.report.add(FindingKind::indices_dangling, dangling,
                         "labels " + in_quotes(numbers.name));
    }

    Source source_;
    const PlyHeader& header_;
    Progress progress_;
    Ticker ticker_;
    MeshData mesh_;
    std::vector<PlyColumn> face_columns_;
    std::deque<CornerList> corner_lists_;
    // Values of corners that the file does not give, against the size of its data.
    std::size_t made_up_ = 0, file_bytes_ = 0;
    IndexCheck vertices_{"vertex", 0};
    std::vector<double> indices_;
    std::vector<Index> face_;
    SkippedContent skipped_;
};

}  // namespace

MeshData read_ply(std::string_view bytes, const Context& context) {
    const PlyHeader header = read_ply_header(bytes);
    if (header.binary) return BodyReader(PlyBinary(bytes, header), header, context).read();
    return BodyReader(PlyText(bytes, header), header, context).read();
}

}  // namespace lissom
