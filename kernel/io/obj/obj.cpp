#include "kernel/io/obj/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kernel/core/geometry.h"
#include "kernel/io/obj/polypaint.h"
#include "kernel/io/record/color_reader.h"
#include "kernel/io/record/index_check.h"
#include "kernel/io/record/label_reader.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/io/stream/line_finding.h"
#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// Numbered values that corners refer to: texture coordinates or normals.
class CornerValues {
  public:
    CornerValues(std::string_view plural, Index width) : plural_(plural), width_(width) {}

    // The values of the next number; without values (NaN) if one is not finite.
    void add(std::initializer_list<double> values, std::size_t line) {
        const bool finite =
            std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
        if (finite) {
            pool_.insert(pool_.end(), values);
        } else {
            pool_.insert(pool_.end(), values.size(), kNone);
            not_finite_.add(line);
        }
    }

    // Gives a corner the values of a number as written; a negative one counts back from the last
    // one before.
    void refer(std::size_t corner, std::int64_t written, std::size_t line) {
        const auto known = static_cast<std::int64_t>(count());
        const std::int64_t index = written > 0 ? written - 1 : known + written;
        if (written == 0 || index < 0 || index > kLargest) return dangling_.add(line);
        if (index >= known) forward_.push_back({corner, line});
        index_of_corner_.resize(corner, kNoIndex);
        index_of_corner_.push_back(index_of(index));
    }

    // Adds the values of all corners as an attribute, if any corner has one.
    void finish(MeshData& mesh, std::string_view name) {
        drop_dangling();
        dangling_.finish(mesh.report, FindingKind::indices_dangling, std::string(plural_));
        not_finite_.finish(mesh.report, FindingKind::values_not_finite, std::string(plural_));
        const bool has_values = std::any_of(index_of_corner_.begin(), index_of_corner_.end(),
                                            [](Index i) { return i != kNoIndex; });
        if (!has_values) return;
        const std::size_t corner_count = mesh.faces.vertices.size();
        index_of_corner_.resize(corner_count, kNoIndex);
        Attribute attribute{std::string(name), Domain::corner, width_, ScalarType::float64, {}};
        const std::size_t width = width_;
        attribute.values.assign(corner_count * width, kNone);
        for (std::size_t c = 0; c < corner_count; ++c) {
            if (index_of_corner_[c] == kNoIndex) continue;
            const auto from = index_of_corner_[c] * width;
            std::copy_n(pool_.begin() + from, width, attribute.values.begin() + c * width);
        }
        mesh.attributes.add(std::move(attribute));
    }

  private:
    static constexpr std::int64_t kLargest = std::numeric_limits<Index>::max() - 1;

    // A corner whose values come later in the file, if at all.
    struct Forward {
        std::size_t corner, line;
    };

    std::size_t count() const { return pool_.size() / width_; }

    void drop_dangling() {
        for (const Forward& forward : forward_) {
            Index& index = index_of_corner_[forward.corner];
            if (at(index) < count()) continue;
            index = kNoIndex;
            dangling_.add(forward.line);
        }
    }

    std::vector<double> pool_;
    std::vector<Index> index_of_corner_;
    std::vector<Forward> forward_;
    LineFinding dangling_, not_finite_;
    std::string_view plural_;
    Index width_;
};

// Regions are groups of points: see kObjRegionPrefix.
class RegionReader {
  public:
    // A group begins whose name, after the prefix, is `name`. It is a region unless a face comes
    // before any point.
    void begin(std::string_view name) {
        end();
        name_ = percent_decoded(name);
        state_ = State::open;
    }
    // Another group begins, or the file ends.
    void end() {
        if (state_ == State::open) regions_[name_];
        state_ = State::none;
    }
    // Returns true if a face now turns a possible region into a group of faces.
    bool give_way() {
        if (state_ != State::open) return false;
        state_ = State::none;
        return true;
    }

    // Adds a vertex to the present region, within one.
    void add(Index vertex) {
        if (state_ == State::open) points_ = &regions_[name_];
        state_ = State::region;
        points_->push_back(vertex);
    }
    bool is_within() const { return state_ != State::none; }

    void finish(MeshData& mesh) {
        end();
        mesh.regions = std::move(regions_);
    }

  private:
    enum class State { none, open, region };

    State state_ = State::none;
    std::string name_;
    std::vector<Index>* points_ = nullptr;
    std::map<std::string, std::vector<Index>, std::less<>> regions_;
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const Context& context)
        : context_(context), whole_(text), text_(text, {.comment = '#', .continuation = true}) {}

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
        if (keyword == "g") return read_group();
        if (keyword == "o") return objects_.set(text_.rest_of_line(), mesh_.faces.size());
        if (keyword == "usemtl") return materials_.set(text_.rest_of_line(), mesh_.faces.size());
        if (keyword == "s") return smoothing_.set(smoothing_group(), mesh_.faces.size());
        if (keyword == "mtllib") return read_material_libraries();
        if (keyword == "p") return read_points();
        if (keyword == "l") return skipped_.add("lines");
        skip_statement(keyword);
    }

    void read_vertex() {
        const double x = text_.number(), y = text_.number();
        if (text_.at_line_end()) {
            refuse(ErrorCode::file_syntax,
                   "a vertex has 3 coordinates, found 2; write a third, 0 for a flat shape",
                   text_.place());
        }
        const double z = text_.number();
        mesh_.positions.emplace_back(x, y, z);
        if (text_.at_line_end()) return;
        const double fourth = text_.number();
        if (text_.at_line_end()) {
            skipped_.add("weights of vertices", fourth != 1.0 ? 1 : 0);
            return;
        }
        std::array<double, 4> color{fourth, text_.number(), text_.number(), 0.0};
        const std::size_t width = text_.at_line_end() ? 3 : 4;
        if (width == 4) color[3] = text_.number();
        require_line_end("a vertex has 3 coordinates, and then a weight or 3 or 4 colour values");
        const std::span<const double> values(color.data(), width);
        if (std::all_of(values.begin(), values.end(), [](double c) { return std::isfinite(c); })) {
            colors_.set(mesh_.positions.size() - 1, values);
        } else {
            colors_not_finite_.add(text_.line());
        }
    }

    void read_texture_coordinates() {
        const double u = text_.number();
        const double v = text_.at_line_end() ? 0.0 : text_.number();
        const double w = text_.at_line_end() ? 0.0 : text_.number();
        skipped_.add("third texture coordinates", w != 0.0 ? 1 : 0);
        require_line_end("texture coordinates are 1 to 3 numbers");
        uvs_.add({u, v}, text_.line());
    }

    void read_normal() {
        const double x = text_.number(), y = text_.number(), z = text_.number();
        require_line_end("a normal is 3 numbers");
        normals_.add({x, y, z}, text_.line());
    }

    void read_face() {
        if (regions_.give_way()) groups_.set(group_, mesh_.faces.size());
        face_.clear();
        const std::size_t first_corner = mesh_.faces.vertices.size();
        const FilePlace place = text_.place();
        while (!text_.at_line_end()) {
            const std::size_t corner = first_corner + face_.size();
            face_.push_back(vertices_.checked(read_vertex_index(), place));
            if (!text_.take('/')) continue;
            if (at_index()) uvs_.refer(corner, text_.integer(), place.id);
            if (text_.take('/') && at_index()) normals_.refer(corner, text_.integer(), place.id);
        }
        add_face(mesh_.faces, face_);
    }

    // Points make regions; others are skipped.
    void read_points() {
        if (!regions_.is_within()) return skipped_.add("points");
        while (!text_.at_line_end()) {
            const FilePlace place = text_.place();
            regions_.add(vertices_.checked(read_vertex_index(), place));
        }
    }

    void read_group() {
        group_ = group_names();
        const bool may_be_region = group_.size() > kObjRegionPrefix.size() &&
                                   std::string_view(group_).starts_with(kObjRegionPrefix);
        if (may_be_region) {
            regions_.begin(std::string_view(group_).substr(kObjRegionPrefix.size()));
        } else {
            regions_.end();
        }
        groups_.set(may_be_region ? "" : group_, mesh_.faces.size());
    }

    bool at_index() const {
        const char c = text_.peek();
        return (c >= '0' && c <= '9') || c == '-' || c == '+';
    }

    // The 0-based index of a vertex; negative numbers in the file count back from the last before.
    std::int64_t read_vertex_index() {
        const std::int64_t written = text_.integer();
        if (written > 0) return written - 1;
        const auto known = std::ssize(mesh_.positions);
        if (written < 0 && written >= -known) return known + written;
        refuse(
            ErrorCode::face_index,
            "vertex " + std::to_string(written) + " does not exist; " +
                (written == 0 ? "indices count from 1" : std::to_string(known) + " come before it"),
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

    // Statements of other programs are passed over; a line without a statement shows that the file
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
        if (first_unknown_.kind == ElementKind::none) first_unknown_ = text_.place();
        skipped_.add("of " + in_quotes(keyword));
    }

    void require_line_end(const char* rule) {
        if (text_.at_line_end()) return;
        refuse(ErrorCode::file_syntax,
               std::string(rule) + "; found more: " + in_quotes(text_.word()), text_.place());
    }

    // Colours in comments, for files whose vertices have none.
    void add_polypaint() {
        const std::vector<std::uint8_t> bytes = read_polypaint(whole_, skipped_);
        if (bytes.empty()) return;
        const std::size_t count = 3 * mesh_.positions.size();
        Attribute color{"color", Domain::vertex, 3, ScalarType::uint8, {}};
        for (std::size_t i = 0; i < std::min(count, bytes.size()); ++i) {
            color.values.push_back(bytes[i] / 255.0);
        }
        color.values.resize(count, kNone);
        if (bytes.size() > count) {
            skipped_.add("polypaint colours without a vertex", (bytes.size() - count) / 3);
        }
        mesh_.attributes.add(std::move(color));
    }

    void finish() {
        const bool has_unknown = first_unknown_.kind != ElementKind::none;
        if (mesh_.positions.empty() && mesh_.faces.size() == 0 && has_unknown) {
            refuse(ErrorCode::file_syntax,
                   "the file has no vertex and statements that OBJ does not know", first_unknown_);
        }
        vertices_.require_below(mesh_.positions.size());
        colors_.finish(mesh_.attributes, Domain::vertex, mesh_.positions.size());
        if (!mesh_.attributes.find("color")) add_polypaint();
        uvs_.finish(mesh_, "uv");
        normals_.finish(mesh_, "normal");
        objects_.finish(mesh_.attributes, "object", mesh_.faces.size());
        groups_.finish(mesh_.attributes, "group", mesh_.faces.size());
        materials_.finish(mesh_.attributes, "material", mesh_.faces.size());
        smoothing_.finish(mesh_.attributes, "smoothing", mesh_.faces.size());
        colors_not_finite_.finish(mesh_.report, FindingKind::values_not_finite, "colours");
        regions_.finish(mesh_);
        skipped_.finish(mesh_.report);
    }

    const Context& context_;
    std::string_view whole_;
    TextReader text_;
    MeshData mesh_;
    std::vector<Index> face_;
    IndexCheck vertices_{"vertex", 1};
    CornerValues uvs_{"texture coordinates", 2};
    CornerValues normals_{"normals", 3};
    ColorReader colors_;
    LabelReader objects_, groups_, materials_, smoothing_;
    RegionReader regions_;
    std::string group_;
    SkippedContent skipped_;
    LineFinding colors_not_finite_;
    FilePlace first_unknown_;
};

}  // namespace

MeshData read_obj(std::string_view text, const Context& context) {
    // Some programs end the file with the zero byte of their string.
    const std::size_t last = text.find_last_not_of('\0');
    if (last != std::string_view::npos) text = text.substr(0, last + 1);
    return ObjReader(text, context).read();
}

}  // namespace lissom
