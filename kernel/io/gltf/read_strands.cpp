#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/io/gltf/file/accessor.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/io/gltf/mesh/primitives.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/gltf/strands.h"
#include "kernel/io/record/strand_links.h"
#include "kernel/io/record/strand_values.h"
#include "kernel/io/stream/byte_source.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

using LinePrimitive = tinygltf::Primitive;

// Values of the points, and texture coordinates of the roots; black, thin, opaque where a
// primitive has none.
struct LineValues {
    std::vector<float> points, widths, transparency;
    std::vector<Eigen::Vector3f> colors;
    std::vector<Eigen::Vector2f> root_uvs;
    std::vector<Index> offsets = {0};
    bool has_widths = false, has_transparency = false, has_colors = false, has_root_uvs = false;
};

class LineReader {
  public:
    LineReader(const GltfDocument& document, const AccessorReader& accessors,
               const Context& context)
        : document_(document), accessors_(accessors), context_(context) {}

    FileHair read(const std::vector<GltfInstance>& instances) {
        Progress progress(context_, "read lines");
        for (std::size_t i = 0; i < instances.size(); ++i) {
            progress.update(i, instances.size());
            read_instance(instances[i]);
        }
        require(lines_ > 0 || others_ == 0,
                "the file holds a surface or points, and no lines; load it as a mesh",
                ErrorCode::unsupported);
        if (others_ > 0) {
            context_.log(LogLevel::warning,
                         std::to_string(others_) + " primitives that are no lines were left out");
        }
        return finished();
    }

  private:
    void read_instance(const GltfInstance& instance) {
        const std::size_t first = values_.offsets.size();
        for (const LinePrimitive& primitive :
             document_.model.meshes[at(instance.mesh)].primitives) {
            if (shape_of_mode(primitive.mode) != PrimitiveShape::lines ||
                !primitive.attributes.contains("POSITION")) {
                ++others_;
                continue;
            }
            ++lines_;
            mesh_ = instance.mesh;
            read_primitive(primitive, instance.transform);
        }
        if (values_.offsets.size() == first) return;
        names_.push_back(instance.label);
        groups_.resize(values_.offsets.size() - 1, count_of(names_) - 1);
    }

    // Numbers of the points of a primitive, if it has them.
    std::optional<AccessorValues> numbers(const LinePrimitive& primitive, const char* name,
                                          std::size_t count, Index width) const {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return std::nullopt;
        AccessorValues values = accessors_.values(found->second);
        const bool fits = values.count == count && values.width >= width;
        if (!fits) {
            refuse(ErrorCode::file_syntax, std::string(name) + " of lines does not have " +
                                               std::to_string(width) + " numbers for each of " +
                                               std::to_string(count) + " points");
        }
        return values;
    }

    std::vector<StrandLink> links_of(const LinePrimitive& primitive, std::size_t count) const {
        std::vector<Index> corners;
        if (primitive.indices >= 0) {
            corners = accessors_.indices(primitive.indices, count);
        } else {
            for (std::size_t i = 0; i < count; ++i) corners.push_back(index_of(i));
        }
        const std::size_t step = primitive.mode == TINYGLTF_MODE_LINE ? 2 : 1;
        std::vector<StrandLink> links;
        for (std::size_t i = 0; i + 1 < corners.size(); i += step) {
            links.push_back({corners[i], corners[i + 1]});
        }
        return links;
    }

    void read_primitive(const LinePrimitive& primitive, const Affine& transform) {
        const AccessorValues positions = accessors_.values(primitive.attributes.at("POSITION"));
        const std::size_t count = positions.count;
        if (positions.width != 3) {
            refuse(ErrorCode::file_syntax, "positions of lines do not have three numbers");
        }
        const StrandOrder order = strands_of_links(links_of(primitive, count), index_of(count));
        unused_ += order.unused;
        constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<Index>::max());
        if (order.vertices.size() > kMost - values_.points.size() / 3) {
            refuse(ErrorCode::file_too_large, "the file has more points than can be numbered");
        }
        add_points(positions, order, transform);
        add_widths(numbers(primitive, "_WIDTH", count, 1), order,
                   std::cbrt(std::abs(transform.linear.determinant())));
        add_colors(numbers(primitive, "COLOR_0", count, 3),
                   numbers(primitive, "_TRANSPARENCY", count, 1), order);
        const auto uvs = numbers(primitive, "_ROOT_UV", count, 2);
        values_.has_root_uvs = values_.has_root_uvs || uvs;
        for (std::size_t s = 0; s + 1 < order.offsets.size(); ++s) {
            const std::size_t root = at(order.vertices[at(order.offsets[s])]);
            Eigen::Vector2f uv = Eigen::Vector2f::Zero();
            if (uvs) uv = {float_of(*uvs, root, 0), float_of(*uvs, root, 1)};
            values_.root_uvs.push_back(uv);
        }
    }

    static float float_of(const AccessorValues& values, std::size_t row, std::size_t column) {
        return static_cast<float>(values.values[row * at(values.width) + column]);
    }

    void add_points(const AccessorValues& positions, const StrandOrder& order,
                    const Affine& transform) {
        const Index before = values_.offsets.back();
        for (std::size_t s = 1; s < order.offsets.size(); ++s) {
            values_.offsets.push_back(before + order.offsets[s]);
        }
        for (const Index v : order.vertices) {
            const Vec3 own(positions.values[3 * at(v)], positions.values[3 * at(v) + 1],
                           positions.values[3 * at(v) + 2]);
            for (const double x : transform(own)) values_.points.push_back(static_cast<float>(x));
        }
    }

    void add_widths(const std::optional<AccessorValues>& widths, const StrandOrder& order,
                    double scale) {
        values_.has_widths = values_.has_widths || widths;
        for (const Index v : order.vertices) {
            values_.widths.push_back(
                widths ? static_cast<float>(scale * widths->values[at(v) * at(widths->width)])
                       : kHairWidth);
        }
    }

    void add_colors(const std::optional<AccessorValues>& colors,
                    const std::optional<AccessorValues>& transparency, const StrandOrder& order) {
        const bool has_alpha = colors && colors->width > 3;
        values_.has_colors = values_.has_colors || colors;
        values_.has_transparency = values_.has_transparency || transparency || has_alpha;
        for (const Index v : order.vertices) {
            Eigen::Vector3f color = Eigen::Vector3f::Zero();
            for (Index k = 0; colors && k < 3; ++k) color[k] = float_of(*colors, at(v), at(k));
            values_.colors.push_back(color);
            float clear = has_alpha ? 1.0f - float_of(*colors, at(v), 3) : 0.0f;
            if (transparency) clear = float_of(*transparency, at(v), 0);
            values_.transparency.push_back(clear);
        }
    }

    FileHair finished() {
        if (unused_ > 0) {
            context_.log(LogLevel::warning,
                         std::to_string(unused_) + " points without lines were left out");
        }
        require_finite(values_.points, 3, 0, values_.offsets);
        FileHair hair;
        hair.has_widths = values_.has_widths;
        hair.strands = Strands(std::move(values_.points), values_.offsets, context_.memory());
        if (hair.strands.empty()) return hair;
        set_point_values(hair.strands);
        if (names_.size() > 1) hair.strands.set_groups(groups_, names_);
        StrandRoots roots;
        if (values_.has_root_uvs) roots.uvs = std::move(values_.root_uvs);
        hair.strands.set_roots(std::move(roots));
        if (lines_ == 1) read_tables(hair.strands);
        return hair;
    }

    void set_point_values(Strands& strands) {
        if (values_.has_widths) {
            require_finite(values_.widths, 1, 0, values_.offsets);
            StrandWidths widths;
            take_fewest(values_.offsets, std::move(values_.widths), widths);
            strands.set_widths(std::move(widths));
        }
        if (values_.has_colors) {
            StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
            take_fewest(values_.offsets, std::move(values_.colors), colors);
            strands.set_colors(std::move(colors));
        }
        if (!values_.has_transparency) return;
        StrandValues<float> transparency{0.0f};
        take_fewest(values_.offsets, std::move(values_.transparency), transparency);
        strands.set_transparency(std::move(transparency));
    }

    // Numbers of the strands, for a file of one primitive; another program may have changed it.
    void read_tables(Strands& strands) const {
        const Json* const extras = member(document_.json["meshes"][at(mesh_)], "extras");
        const Json* const tables = extras ? member(*extras, kStrandTables) : nullptr;
        if (!tables) return;
        if (index_member(*tables, "count", kStrandTables) != strands.size()) {
            context_.log(LogLevel::warning,
                         "ids, groups, guides and roots were left out: the lines have changed");
            return;
        }
        read_roots(*tables, strands);
        if (const auto ids = table(*tables, "id", 1, strands)) {
            strands.set_ids(whole_numbers(*ids, "id"));
        }
        read_guides(*tables, strands);
        read_groups(*tables, strands);
        strands.set_comment(text_member(*tables, "comment"));
    }

    std::optional<AccessorValues> table(const Json& tables, const char* key, Index width,
                                        const Strands& strands) const {
        const int accessor = index_member(tables, key, kStrandTables);
        if (accessor < 0) return std::nullopt;
        AccessorValues values = accessors_.values(accessor);
        if (values.count == at(strands.size()) && values.width == width) return values;
        refuse(ErrorCode::file_syntax, "the numbers '" + std::string(key) + "' do not fit the " +
                                           std::to_string(strands.size()) + " strands");
    }

    static std::vector<std::uint32_t> whole_numbers(const AccessorValues& values, const char* key) {
        std::vector<std::uint32_t> list;
        for (const double value : values.values) {
            if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value))) {
                refuse(ErrorCode::file_syntax,
                       "the numbers '" + std::string(key) + "' are not whole");
            }
            list.push_back(static_cast<std::uint32_t>(value));
        }
        return list;
    }

    // Indices below `limit`; none of them is the largest number.
    static std::vector<Index> optional_indices(const AccessorValues& values, const char* key,
                                               Index limit) {
        std::vector<Index> list;
        for (const std::uint32_t value : whole_numbers(values, key)) {
            if (value != kNoGuide && value >= static_cast<std::uint32_t>(limit)) {
                refuse(ErrorCode::file_syntax, "the number " + std::to_string(value) + " of '" +
                                                   std::string(key) + "' is out of range");
            }
            list.push_back(value == kNoGuide ? kNoIndex : static_cast<Index>(value));
        }
        return list;
    }

    static std::vector<float> floats(const AccessorValues& values, const Strands& strands) {
        std::vector<float> list(values.values.begin(), values.values.end());
        std::vector<Index> offsets;
        for (Index s = 0; s <= strands.size(); ++s) offsets.push_back(s);
        require_finite(list, at(values.width), 0, offsets);
        return list;
    }

    void read_roots(const Json& tables, Strands& strands) const {
        constexpr Index kMost = std::numeric_limits<Index>::max();
        const auto face = table(tables, "face", 1, strands);
        const auto weights = table(tables, "weights", 3, strands);
        if (!face || !weights) return;
        StrandRoots roots = strands.roots();
        roots.faces = optional_indices(*face, "face", kMost);
        const std::vector<float> list = floats(*weights, strands);
        for (std::size_t i = 0; i < list.size(); i += 3) roots.barycentrics.emplace_back(&list[i]);
        if (const auto vertices = table(tables, "vertices", 3, strands)) {
            const std::vector<Index> ids = optional_indices(*vertices, "vertices", kMost);
            for (std::size_t i = 0; i < ids.size(); i += 3) {
                roots.triangles.push_back({ids[i], ids[i + 1], ids[i + 2]});
            }
        }
        strands.set_roots(std::move(roots));
    }

    void read_guides(const Json& tables, Strands& strands) const {
        const auto guide = table(tables, "guide", 1, strands);
        const auto arc = table(tables, "guide_arc", 1, strands);
        if (!guide || !arc) return;
        strands.set_guides({whole_numbers(*guide, "guide"), floats(*arc, strands)});
    }

    void read_groups(const Json& tables, Strands& strands) const {
        const auto group = table(tables, "group", 1, strands);
        const Json* const names = member(tables, "group_names");
        if (!group || !names || !names->is_array()) return;
        std::vector<std::string> list;
        for (const Json& name : *names) {
            std::string text = name.is_string() ? name.get<std::string>() : std::string();
            list.push_back(text.empty() ? "group " + std::to_string(list.size() + 1) : text);
        }
        std::vector<Index> groups = optional_indices(*group, "group", count_of(list));
        strands.set_groups(std::move(groups), std::move(list));
    }

    const GltfDocument& document_;
    const AccessorReader& accessors_;
    const Context& context_;
    LineValues values_;
    std::vector<std::string> names_;
    std::vector<Index> groups_;
    // Primitives of lines and others, and points of no line.
    std::size_t lines_ = 0, others_ = 0, unused_ = 0;
    // The mesh of the last lines.
    int mesh_ = -1;
};

}  // namespace

FileHair read_gltf_strands(std::string_view bytes, const Context& context) {
    Report report;
    GltfDocument document = open_gltf({bytes, {}}, report, context);
    GltfBudget budget(document.bytes_read);
    const AccessorReader accessors(document, budget);
    expand_instancing(document.json, accessors, budget, report);
    return LineReader(document, accessors, context).read(find_instances(document.json, report));
}

}  // namespace lissom
