#include "kernel/io/ply/strands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "kernel/io/ply/header.h"
#include "kernel/io/ply/number_source.h"
#include "kernel/io/record/index_check.h"
#include "kernel/io/record/strand_links.h"
#include "kernel/io/record/strand_values.h"
#include "kernel/io/stream/byte_source.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

constexpr std::array<std::string_view, 9> kPointNumbers{
    "x", "y", "z", "red", "green", "blue", "alpha", "thickness", "transparency"};
constexpr std::array<std::string_view, 13> kStrandNumbers{"nsegs",
                                                          "root_u",
                                                          "root_v",
                                                          "root_face",
                                                          "root_weight_0",
                                                          "root_weight_1",
                                                          "root_weight_2",
                                                          "root_vertex_0",
                                                          "root_vertex_1",
                                                          "root_vertex_2",
                                                          "id",
                                                          "guide",
                                                          "guide_arc"};
constexpr std::string_view kGroupNumber = "group";
constexpr std::array<std::string_view, 2> kLinkNumbers{"vertex1", "vertex2"};

template <std::size_t N>
bool is_one(std::string_view name, const std::array<std::string_view, N>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// The numbers of an element by the names of their properties, and the lists of vertices.
struct StrandTable {
    std::size_t rows = 0;
    std::map<std::string, std::vector<double>, std::less<>> numbers;
    // Lists of all rows one after the other, and the place behind each.
    std::vector<Index> listed;
    std::vector<Index> ends;
    bool has_lists = false;

    const std::vector<double>* find(std::string_view name) const {
        const auto found = numbers.find(name);
        return found == numbers.end() ? nullptr : &found->second;
    }
};

// Reads the elements that hair is made of.
template <typename Source>
class StrandTables {
  public:
    StrandTables(Source source, const PlyHeader& header, const Context& context)
        : source_(std::move(source)),
          header_(header),
          progress_(context, "read strands"),
          ticker_(progress_) {}

    StrandTable points, strands, links;
    IndexCheck vertices{"vertex", 0};
    // Names of numbers without a place.
    std::vector<std::string> unplaced;

    void read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_rows(element, points, [](auto name) { return is_one(name, kPointNumbers); });
            } else if (element.name == "strand" || element.name == "polyline") {
                read_rows(element, strands, [](auto name) {
                    return is_one(name, kStrandNumbers) || name == kGroupNumber;
                });
            } else if (element.name == "edge") {
                read_rows(element, links, [](auto name) { return is_one(name, kLinkNumbers); });
            } else {
                StrandTable none;
                read_rows(element, none, [](auto) { return false; });
            }
        }
        vertices.require_below(points.rows);
    }

  private:
    template <typename Known>
    void read_rows(const PlyElement& element, StrandTable& table, const Known& known) {
        std::vector<std::vector<double>*> columns;
        for (const PlyProperty& property : element.properties) {
            columns.push_back(place_of(element, property, table, known));
        }
        table.rows = element.count;
        if (element.properties.empty()) return;
        source_.tally() = {"rows of elements", 0, element.count};
        for (std::size_t row = 0; row < element.count; ++row) {
            ticker_.tick([&] { return source_.fraction(); });
            for (std::size_t p = 0; p < columns.size(); ++p) {
                read_one(element.properties[p], columns[p], table, row);
            }
            if (table.has_lists) table.ends.push_back(count_of(table.listed));
            ++source_.tally().found;
        }
    }

    template <typename Known>
    std::vector<double>* place_of(const PlyElement& element, const PlyProperty& property,
                                  StrandTable& table, const Known& known) {
        if (property.is_list && is_list_of_strand(element, property)) {
            table.has_lists = true;
        } else if (!property.is_list && known(std::string_view(property.name))) {
            return &table.numbers[property.name];
        } else if (unplaced.size() < 10) {
            unplaced.push_back(in_quotes(property.name) + " of " + in_quotes(element.name));
        }
        return nullptr;
    }

    static bool is_list_of_strand(const PlyElement& element, const PlyProperty& property) {
        return (element.name == "strand" || element.name == "polyline") &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    }

    void read_one(const PlyProperty& property, std::vector<double>* column, StrandTable& table,
                  std::size_t row) {
        if (property.is_list) return read_list(property, table, row);
        const double value = source_.number(property.type);
        if (!column) return;
        const bool is_color = property.name == "red" || property.name == "green" ||
                              property.name == "blue" || property.name == "alpha";
        column->push_back(
            is_color && is_integer(property.type) ? value / color_divisor(property.type) : value);
    }

    void read_list(const PlyProperty& property, StrandTable& table, std::size_t row) {
        const double length = source_.number(property.count_type);
        if (!(length >= 0.0) || length != std::floor(length)) {
            refuse(ErrorCode::file_syntax,
                   "the list " + in_quotes(property.name) + " has no valid length",
                   source_.place(ElementKind::row, row));
        }
        if (length > static_cast<double>(source_.remaining())) refuse_truncated(source_.tally());
        const bool keeps = &table == &strands &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
        for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i) {
            const double value = source_.number(property.type);
            if (!keeps) continue;
            table.listed.push_back(
                vertices.checked(whole(value), source_.place(ElementKind::strand, row)));
        }
    }

    // Numbers that are none become -1, which no index is.
    static std::int64_t whole(double value) {
        constexpr double kLimit = 1e15;
        return std::abs(value) < kLimit && value == std::floor(value)
                   ? static_cast<std::int64_t>(value)
                   : -1;
    }

    Source source_;
    const PlyHeader& header_;
    Progress progress_;
    Ticker ticker_;
};

// Puts strands together from the tables of a file.
class HairBuilder {
  public:
    HairBuilder(const PlyHeader& header, const StrandTable& points, const StrandTable& strands,
                const StrandTable& links, const Context& context)
        : header_(header), points_(points), table_(strands), links_(links), context_(context) {}

    FileHair build() {
        for (const char* name : {"x", "y", "z"}) {
            if (points_.find(name)) continue;
            refuse(ErrorCode::file_syntax, "vertices have no number '" + std::string(name) + "'");
        }
        order_ = find_order();
        FileHair hair;
        hair.strands = Strands(gathered({"x", "y", "z"}), order_.offsets, context_.memory());
        hair.has_widths = points_.find("thickness") != nullptr;
        set_point_values(hair.strands);
        set_roots(hair.strands);
        set_guides(hair.strands);
        set_groups(hair.strands);
        set_comment(hair.strands);
        return hair;
    }

  private:
    bool declares(std::string_view name) const {
        return std::any_of(header_.elements.begin(), header_.elements.end(),
                           [&](const PlyElement& e) { return e.name == name; });
    }

    StrandOrder find_order() const {
        if (table_.has_lists) return listed_order();
        if (table_.find("nsegs")) return counted_order();
        if (links_.find("vertex1") && links_.find("vertex2")) return linked_order();
        refuse(ErrorCode::unsupported,
               declares("face") ? "the file holds a surface and no strands; load it as a mesh"
                                : "the file does not tell which points belong to a strand: it has "
                                  "no element 'strand' or 'edge'; write it with one of them");
    }

    StrandOrder listed_order() const {
        StrandOrder order;
        order.vertices = table_.listed;
        Index before = 0;
        for (std::size_t s = 0; s < table_.ends.size(); ++s) {
            if (table_.ends[s] == before) refuse_strand(s, "has no points");
            before = table_.ends[s];
            order.offsets.push_back(before);
        }
        return order;
    }

    StrandOrder counted_order() const {
        StrandOrder order;
        double total = 0.0;
        const std::vector<double>& segments = *table_.find("nsegs");
        for (std::size_t s = 0; s < segments.size(); ++s) {
            const double n = segments[s];
            if (!(n >= 0.0) || n != std::floor(n)) refuse_strand(s, "has no valid 'nsegs'");
            total += n + 1.0;
            if (total > static_cast<double>(points_.rows)) break;
            order.offsets.push_back(static_cast<Index>(total));
        }
        if (total != static_cast<double>(points_.rows)) {
            refuse(ErrorCode::file_syntax,
                   "'nsegs' of the strands and the " + std::to_string(points_.rows) +
                       " vertices do not agree: each strand has one vertex more than segments");
        }
        order.vertices.resize(points_.rows);
        for (std::size_t i = 0; i < points_.rows; ++i) order.vertices[i] = index_of(i);
        return order;
    }

    StrandOrder linked_order() const {
        const std::vector<double>&a = *links_.find("vertex1"), &b = *links_.find("vertex2");
        std::vector<StrandLink> links;
        links.reserve(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            links.push_back({vertex_of(a[i], i), vertex_of(b[i], i)});
        }
        StrandOrder order = strands_of_links(links, index_of(points_.rows));
        if (order.unused > 0) {
            context_.log(LogLevel::warning,
                         std::to_string(order.unused) + " vertices without edges were left out");
        }
        return order;
    }

    Index vertex_of(double value, std::size_t edge) const {
        if (value >= 0.0 && value < static_cast<double>(points_.rows) &&
            value == std::floor(value)) {
            return static_cast<Index>(value);
        }
        refuse(ErrorCode::face_index, "an edge names a vertex that the file does not have",
               {ElementKind::row, edge});
    }

    [[noreturn]] static void refuse_strand(std::size_t strand, const std::string& what) {
        refuse(ErrorCode::file_syntax, "strand " + std::to_string(strand) + " " + what,
               {ElementKind::strand, strand});
    }

    Index size() const { return count_of(order_.offsets) - 1; }

    // Numbers of the points in the order of the strands, side by side.
    std::vector<float> gathered(const std::vector<std::string_view>& names) const {
        std::vector<float> values(names.size() * order_.vertices.size());
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::vector<double>& column = *points_.find(names[k]);
            for (std::size_t i = 0; i < order_.vertices.size(); ++i) {
                values[names.size() * i + k] = static_cast<float>(column[at(order_.vertices[i])]);
            }
        }
        require_finite(values, names.size(), 0, order_.offsets);
        return values;
    }

    void set_point_values(Strands& strands) const {
        if (strands.empty()) return;
        if (points_.find("thickness")) {
            StrandWidths widths;
            take_fewest(order_.offsets, gathered({"thickness"}), widths);
            strands.set_widths(std::move(widths));
        }
        if (points_.find("red") && points_.find("green") && points_.find("blue")) {
            const std::vector<float> numbers = gathered({"red", "green", "blue"});
            std::vector<Eigen::Vector3f> list;
            for (std::size_t i = 0; i < numbers.size(); i += 3) list.emplace_back(&numbers[i]);
            StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
            take_fewest(order_.offsets, std::move(list), colors);
            strands.set_colors(std::move(colors));
        }
        const bool exact = points_.find("transparency") != nullptr;
        if (!exact && !points_.find("alpha")) return;
        std::vector<float> list = gathered({exact ? "transparency" : "alpha"});
        if (!exact)
            std::transform(list.begin(), list.end(), list.begin(),
                           [](float a) { return 1.0f - a; });
        StrandValues<float> transparency{0.0f};
        take_fewest(order_.offsets, std::move(list), transparency);
        strands.set_transparency(std::move(transparency));
    }

    // Numbers of strands; edges tell none.
    const std::vector<double>* of_strands(std::string_view name) const {
        const std::vector<double>* const column = table_.find(name);
        if (!column || column->size() != at(size())) return nullptr;
        for (std::size_t s = 0; s < column->size(); ++s) {
            if (!std::isfinite(static_cast<float>((*column)[s]))) {
                refuse(ErrorCode::not_finite,
                       "strand " + std::to_string(s) + ": " + std::string(name) +
                           " is NaN or infinite",
                       {ElementKind::strand, s});
            }
        }
        return column;
    }

    template <typename Number>
    Number whole(const std::vector<double>& column, std::size_t s, std::string_view name) const {
        const double value = column[s];
        if (value >= double(std::numeric_limits<Number>::min()) &&
            value <= double(std::numeric_limits<Number>::max()) && value == std::floor(value)) {
            return static_cast<Number>(value);
        }
        refuse_strand(s, "has no valid " + in_quotes(name));
    }

    void set_roots(Strands& strands) const {
        StrandRoots roots;
        const std::size_t n = at(size());
        const auto *u = of_strands("root_u"), *v = of_strands("root_v");
        for (std::size_t s = 0; u && v && s < n; ++s) {
            roots.uvs.emplace_back(static_cast<float>((*u)[s]), static_cast<float>((*v)[s]));
        }
        const auto* const face = of_strands("root_face");
        const std::array weights{of_strands("root_weight_0"), of_strands("root_weight_1"),
                                 of_strands("root_weight_2")};
        const std::array vertices{of_strands("root_vertex_0"), of_strands("root_vertex_1"),
                                  of_strands("root_vertex_2")};
        const bool known = face && weights[0] && weights[1] && weights[2];
        const bool corners = known && vertices[0] && vertices[1] && vertices[2];
        for (std::size_t s = 0; known && s < n; ++s) {
            roots.faces.push_back(whole<Index>(*face, s, "root_face"));
            Eigen::Vector3f weight;
            Triangle triangle;
            for (std::size_t k = 0; k < 3; ++k) {
                weight[index_of(k)] = static_cast<float>((*weights[k])[s]);
                if (corners) triangle[k] = whole<Index>(*vertices[k], s, "root_vertex");
            }
            roots.barycentrics.push_back(weight);
            if (corners) roots.triangles.push_back(triangle);
        }
        strands.set_roots(std::move(roots));
        const auto* const id = of_strands("id");
        if (!id) return;
        std::vector<std::uint32_t> ids;
        for (std::size_t s = 0; s < n; ++s) ids.push_back(whole<std::uint32_t>(*id, s, "id"));
        strands.set_ids(std::move(ids));
    }

    void set_guides(Strands& strands) const {
        const auto *guide = of_strands("guide"), *arc = of_strands("guide_arc");
        if (!guide || !arc) return;
        StrandGuides guides;
        for (std::size_t s = 0; s < guide->size(); ++s) {
            guides.ids.push_back(whole<std::uint32_t>(*guide, s, "guide"));
            guides.arcs.push_back(static_cast<float>((*arc)[s]));
        }
        strands.set_guides(std::move(guides));
    }

    void set_groups(Strands& strands) const {
        const auto* const group = of_strands(kGroupNumber);
        const auto names = header_.label_names.find("group");
        if (!group || names == header_.label_names.end()) return;
        std::vector<Index> groups;
        for (std::size_t s = 0; s < group->size(); ++s) {
            const auto g = whole<Index>(*group, s, kGroupNumber);
            if (g < kNoIndex || g >= count_of(names->second)) {
                refuse_strand(s, "is of a group without a name");
            }
            groups.push_back(g);
        }
        std::vector<std::string> list = names->second;
        for (std::size_t g = 0; g < list.size(); ++g) {
            if (list[g].empty()) list[g] = "group " + std::to_string(g + 1);
        }
        strands.set_groups(std::move(groups), std::move(list));
    }

    void set_comment(Strands& strands) const {
        const auto comment = header_.label_names.find("comment");
        if (comment == header_.label_names.end() || comment->second.empty()) return;
        strands.set_comment(comment->second.front());
    }

    const PlyHeader& header_;
    const StrandTable &points_, &table_, &links_;
    const Context& context_;
    StrandOrder order_;
};

template <typename Source>
FileHair read_tables(Source source, const PlyHeader& header, const Context& context) {
    StrandTables<Source> tables(std::move(source), header, context);
    tables.read();
    FileHair hair =
        HairBuilder(header, tables.points, tables.strands, tables.links, context).build();
    std::string names;
    for (const std::string& name : tables.unplaced) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) {
        context.log(LogLevel::warning, "numbers without a place were left out: " + names);
    }
    return hair;
}

}  // namespace

FileHair read_ply_strands(std::string_view bytes, const Context& context) {
    const PlyHeader header = read_ply_header(bytes);
    if (header.binary) return read_tables(PlyBinary(bytes, header), header, context);
    return read_tables(PlyText(bytes, header), header, context);
}

}  // namespace lissom
