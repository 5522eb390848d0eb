#include "kernel/io/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kernel/io/color_reader.h"
#include "kernel/io/index_check.h"
#include "kernel/io/label_reader.h"
#include "kernel/io/text_reader.h"
#include "kernel/io/text_writer.h"
#include "kernel/io/ticker.h"
#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Statements that were passed over, by keyword.
class SkippedStatements {
  public:
    void add(std::string_view keyword) {
        const auto found = counts_.find(keyword);
        if (found != counts_.end()) {
            ++found->second;
        } else {
            counts_.emplace(keyword, 1);
        }
    }
    bool empty() const { return counts_.empty(); }

    void log(const Context& context) const {
        constexpr std::size_t kShown = 10;
        if (empty()) return;
        std::string list;
        std::size_t shown = 0;
        for (const auto& [keyword, count] : counts_) {
            if (++shown > kShown) break;
            list +=
                (list.empty() ? "" : ", ") + std::to_string(count) + " of " + in_quotes(keyword);
        }
        if (counts_.size() > kShown) list += ", ...";
        context.log(LogLevel::warning,
                    "statements that a mesh has no place for were skipped: " + list);
    }

  private:
    std::map<std::string, std::size_t, std::less<>> counts_;
};

// Numbered values that corners refer to: texture coordinates or normals.
class CornerValues {
  public:
    CornerValues(std::string_view element, Index width) : check_(element, 1), width_(width) {}

    std::vector<double>& pool() { return pool_; }
    std::size_t count() const { return pool_.size() / static_cast<std::size_t>(width_); }

    void refer(std::size_t corner, std::int64_t index, Place place) {
        index_of_corner_.resize(corner, kNoIndex);
        index_of_corner_.push_back(check_.checked(index, place));
    }

    // The values of all corners as an attribute, where any corner has one.
    void finish(AttributeSet& attributes, std::string_view name, std::size_t corner_count) {
        check_.require_below(count());
        if (index_of_corner_.empty()) return;
        index_of_corner_.resize(corner_count, kNoIndex);
        Attribute attribute{std::string(name), Domain::corner, width_, ScalarType::float64, {}};
        const auto width = static_cast<std::size_t>(width_);
        attribute.values.assign(corner_count * width, kNone);
        for (std::size_t c = 0; c < corner_count; ++c) {
            if (index_of_corner_[c] == kNoIndex) continue;
            const auto from = static_cast<std::size_t>(index_of_corner_[c]) * width;
            std::copy_n(pool_.begin() + static_cast<std::ptrdiff_t>(from), width,
                        attribute.values.begin() + static_cast<std::ptrdiff_t>(c * width));
        }
        attributes.add(std::move(attribute));
    }

  private:
    std::vector<double> pool_;
    std::vector<Index> index_of_corner_;
    IndexCheck check_;
    Index width_;
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const Context& context)
        : context_(context), text_(text, {.comment = '#', .continuation = true}) {}

    MeshData read() {
        Progress progress(context_, "read OBJ");
        Ticker ticker(progress);
        for (; !text_.at_end(); text_.skip_line()) {
            ticker.tick([&] { return text_.fraction(); });
            read_statement(text_.word());
        }
        finish();
        return std::move(mesh_);
    }

  private:
    void read_statement(std::string_view keyword) {
        if (keyword == "v") return read_vertex();
        if (keyword == "f") return read_face();
        if (keyword == "vt") return read_texture_coordinates();
        if (keyword == "vn") return read_normal();
        if (keyword == "g") return groups_.set(group_names(), mesh_.faces.size());
        if (keyword == "o") return objects_.set(text_.rest_of_line(), mesh_.faces.size());
        if (keyword == "usemtl") return materials_.set(text_.rest_of_line(), mesh_.faces.size());
        if (keyword == "s") return smoothing_.set(smoothing_group(), mesh_.faces.size());
        if (keyword == "mtllib") return read_material_libraries();
        skip_statement(keyword);
    }

    void read_vertex() {
        const double x = text_.number(), y = text_.number(), z = text_.number();
        mesh_.positions.emplace_back(x, y, z);
        if (text_.at_line_end()) return;
        const double fourth = text_.number();
        if (text_.at_line_end()) {
            weights_ += fourth != 1.0;
            return;
        }
        std::array<double, 4> color{fourth, text_.number(), text_.number(), 0.0};
        const std::size_t width = text_.at_line_end() ? 3 : 4;
        if (width == 4) color[3] = text_.number();
        require_line_end("a vertex has 3 coordinates, and then a weight or 3 or 4 colour values");
        colors_.set(mesh_.positions.size() - 1, {color.data(), width});
    }

    void read_texture_coordinates() {
        const double u = text_.number();
        const double v = text_.at_line_end() ? 0.0 : text_.number();
        if (!text_.at_line_end()) third_coordinates_ += text_.number() != 0.0;
        require_line_end("texture coordinates are 1 to 3 numbers");
        uvs_.pool().insert(uvs_.pool().end(), {u, v});
    }

    void read_normal() {
        const double x = text_.number(), y = text_.number(), z = text_.number();
        require_line_end("a normal is 3 numbers");
        normals_.pool().insert(normals_.pool().end(), {x, y, z});
    }

    void read_face() {
        face_.clear();
        const std::size_t first_corner = mesh_.faces.vertices.size();
        const Place place = text_.place();
        while (!text_.at_line_end()) {
            const std::size_t corner = first_corner + face_.size();
            face_.push_back(vertices_.checked(read_index("vertex", mesh_.positions.size()), place));
            if (!text_.take('/')) continue;
            if (at_index()) {
                uvs_.refer(corner, read_index("texture coordinate", uvs_.count()), place);
            }
            if (text_.take('/') && at_index()) {
                normals_.refer(corner, read_index("normal", normals_.count()), place);
            }
        }
        add_face(mesh_.faces, face_);
    }

    bool at_index() const {
        const char c = text_.peek();
        return (c >= '0' && c <= '9') || c == '-' || c == '+';
    }

    // The 0-based index; negative numbers in the file count back from the last of the `count`
    // elements before the face.
    std::int64_t read_index(std::string_view element, std::size_t count) {
        const std::int64_t written = text_.integer();
        if (written > 0) return written - 1;
        const auto known = static_cast<std::int64_t>(count);
        if (written < 0 && written >= -known) return known + written;
        refuse(ErrorCode::face_index,
               std::string(element) + " " + std::to_string(written) + " does not exist; " +
                   (written == 0 ? "indices count from 1"
                                 : std::to_string(count) + " come before the face"),
               text_.place());
    }

    std::string group_names() {
        std::string names(text_.word());
        for (auto name = text_.word(); !name.empty(); name = text_.word()) {
            names += ' ';
            names += name;
        }
        return names;
    }

    // "off" also for its other spelling "0".
    std::string_view smoothing_group() {
        const std::string_view name = text_.rest_of_line();
        return name == "0" ? "off" : name;
    }

    // File names end with ".mtl", so that names with blanks are told from several names on the
    // line.
    void read_material_libraries() {
        std::string_view line = text_.rest_of_line();
        while (!line.empty()) {
            const std::size_t dot = line.find(".mtl ");
            const std::size_t size = dot == std::string_view::npos ? line.size() : dot + 4;
            mesh_.material_libraries.emplace_back(line.substr(0, size));
            line.remove_prefix(size);
            line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        }
    }

    // Statements of other programs are passed over; what is no statement at all shows that the file
    // is not OBJ.
    void skip_statement(std::string_view keyword) {
        const bool is_name = std::all_of(keyword.begin(), keyword.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                   c == '_';
        });
        if (!is_name || (keyword[0] >= '0' && keyword[0] <= '9')) {
            refuse(ErrorCode::file_syntax, "expected an OBJ statement, found " + in_quotes(keyword),
                   text_.place());
        }
        if (skipped_.empty()) first_skipped_ = text_.place();
        skipped_.add(keyword);
    }

    void require_line_end(const char* rule) {
        if (text_.at_line_end()) return;
        refuse(ErrorCode::file_syntax,
               std::string(rule) + "; found more: " + in_quotes(text_.word()), text_.place());
    }

    void finish() {
        if (mesh_.positions.empty() && mesh_.faces.size() == 0 && !skipped_.empty()) {
            refuse(ErrorCode::file_syntax,
                   "the file has no vertex and statements that OBJ does not know", first_skipped_);
        }
        vertices_.require_below(mesh_.positions.size());
        colors_.finish(mesh_.attributes, Domain::vertex, mesh_.positions.size());
        const std::size_t corner_count = mesh_.faces.vertices.size();
        uvs_.finish(mesh_.attributes, "uv", corner_count);
        normals_.finish(mesh_.attributes, "normal", corner_count);
        objects_.finish(mesh_.attributes, "object", mesh_.faces.size());
        groups_.finish(mesh_.attributes, "group", mesh_.faces.size());
        materials_.finish(mesh_.attributes, "material", mesh_.faces.size());
        smoothing_.finish(mesh_.attributes, "smoothing", mesh_.faces.size());
        log_skipped();
    }

    void log_skipped() const {
        skipped_.log(context_);
        if (weights_ > 0) {
            context_.log(LogLevel::warning, "the weights of " + std::to_string(weights_) +
                                                " vertices were skipped; polygons have none");
        }
        if (third_coordinates_ > 0) {
            context_.log(LogLevel::warning, std::to_string(third_coordinates_) +
                                                " third texture coordinates were skipped");
        }
    }

    const Context& context_;
    TextReader text_;
    MeshData mesh_;
    std::vector<Index> face_;
    IndexCheck vertices_{"vertex", 1};
    CornerValues uvs_{"texture coordinate", 2};
    CornerValues normals_{"normal", 3};
    ColorReader colors_;
    LabelReader objects_, groups_, materials_, smoothing_;
    SkippedStatements skipped_;
    Place first_skipped_;
    std::size_t weights_ = 0, third_coordinates_ = 0;
};

// The values of one attribute as OBJ writes them: each different one once, and a number for each
// corner.
template <std::size_t Width>
class WrittenValues {
  public:
    WrittenValues(const Attribute* attribute, const Topology& topology) {
        if (!attribute) return;
        number_of_corner_.assign(static_cast<std::size_t>(topology.corner_count()), kNoIndex);
        for (Index c = 0; c < topology.corner_count(); ++c) {
            const Index element =
                attribute->domain == Domain::corner ? c : topology.faces().vertices[c];
            const std::span<const double> values = attribute->at(element);
            if (std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); })) {
                continue;
            }
            std::array<double, Width> tuple;
            std::copy(values.begin(), values.end(), tuple.begin());
            number_of_corner_[c] = pool_.add(tuple);
        }
    }

    void write(std::string_view keyword, std::string& text) const {
        for (const auto& tuple : pool_.tuples()) {
            text += keyword;
            append_numbers(text, tuple);
            text += '\n';
        }
    }
    // 1-based, or 0 where the corner has none.
    Index number(Index corner) const {
        return number_of_corner_.empty() ? 0 : number_of_corner_[corner] + 1;
    }

  private:
    ValuePool<Width> pool_;
    std::vector<Index> number_of_corner_;
};

// Writes a statement where the label of one kind changes from one face to the next.
class LabelWriter {
  public:
    LabelWriter(const FaceLabels* labels, std::string_view keyword, std::string_view none)
        : labels_(labels), keyword_(keyword), none_(none) {}

    void write_change(Index face, std::string& text) {
        if (!labels_ || labels_->of_face[face] == current_) return;
        current_ = labels_->of_face[face];
        text += keyword_;
        text +=
            current_ == kNoIndex ? std::string(none_) : " " + one_line(labels_->names[current_]);
        text += '\n';
    }

  private:
    const FaceLabels* labels_;
    std::string_view keyword_, none_;
    Index current_ = kNoIndex;
};

void write_vertices(const Mesh& mesh, const Attribute* colors, std::string& text) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        text += 'v';
        append_numbers(text, mesh.position(v));
        if (colors && !std::isnan(colors->at(v)[0])) append_numbers(text, colors->at(v));
        text += '\n';
    }
}

void append_corner(std::string& text, Index vertex, Index uv, Index normal) {
    text += ' ';
    append_number(text, vertex + 1);
    if (uv == 0 && normal == 0) return;
    text += '/';
    if (uv != 0) append_number(text, uv);
    if (normal == 0) return;
    text += '/';
    append_number(text, normal);
}

}  // namespace

MeshData read_obj(std::string_view text, const Context& context) {
    return ObjReader(text, context).read();
}

void write_obj(SavedParts& parts, const SaveOptions&, std::string& text, const Context& context) {
    const Mesh& mesh = parts.mesh();
    const Topology& topology = mesh.topology();
    Progress progress(context, "write OBJ");
    text += "# Written by Lissom\n";
    for (const std::string& library : parts.take_material_libraries()) {
        text += "mtllib " + one_line(library) + "\n";
    }
    write_vertices(mesh, parts.take("color", {Domain::vertex}, {3, 4}), text);
    progress.update(0.3);
    const WrittenValues<2> uvs(parts.take("uv", {Domain::corner, Domain::vertex}, {2}), topology);
    const WrittenValues<3> normals(parts.take("normal", {Domain::corner, Domain::vertex}, {3}),
                                   topology);
    uvs.write("vt", text);
    normals.write("vn", text);
    progress.update(0.6);

    LabelWriter labels[] = {{parts.take_labels("object"), "o", ""},
                            {parts.take_labels("group"), "g", ""},
                            {parts.take_labels("material"), "usemtl", ""},
                            {parts.take_labels("smoothing"), "s", " off"}};
    Ticker ticker(progress);
    for (Index f = 0; f < topology.face_count(); ++f) {
        ticker.tick([&] { return 0.6 + 0.4 * f / topology.face_count(); });
        for (LabelWriter& label : labels) label.write_change(f, text);
        text += 'f';
        Index corner = topology.first_corner(f);
        for (const Index v : topology.face(f)) {
            append_corner(text, v, uvs.number(corner), normals.number(corner));
            ++corner;
        }
        text += '\n';
    }
}

}  // namespace lissom
