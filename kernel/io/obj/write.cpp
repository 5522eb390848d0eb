#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/io/obj/obj.h"
#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"
#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

// The values of one attribute as OBJ writes them: each different one once, and a number for each
// corner.
template <std::size_t Width>
class WrittenValues {
  public:
    WrittenValues(const Attribute* attribute, const Topology& topology) {
        if (!attribute) return;
        number_of_corner_.assign(topology.corner_count(), kNoIndex);
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
    // 1-based, or 0 if the corner has none.
    Index number(Index corner) const {
        return number_of_corner_.empty() ? 0 : number_of_corner_[corner] + 1;
    }

  private:
    ValuePool<Width> pool_;
    std::vector<Index> number_of_corner_;
};

// Writes a statement if the label of one kind changes from one face to the next.
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

// Regions come last, as groups of points that no program takes for faces.
void write_regions(const std::map<std::string, Region, std::less<>>& regions, std::string& text) {
    constexpr Index kPointsInLine = 50;
    for (const auto& [name, region] : regions) {
        text += "g ";
        text += kObjRegionPrefix;
        text += percent_encoded(name, true) + "\n";
        Index written = 0;
        for (const Index v : region.vertices()) {
            if (written % kPointsInLine == 0) text += written == 0 ? "p" : "\np";
            text += ' ';
            append_number(text, v + 1);
            ++written;
        }
        if (written > 0) text += '\n';
    }
}

}  // namespace

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
    write_regions(parts.take_regions(), text);
}

}  // namespace lissom
