#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/io/off/off.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// Colours are written as bytes if they were bytes and can be told from numbers between 0 and 1.
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
                append_number(text, index_of(std::lround(value * 255.0)));
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
    // Without a comment: OpenMesh reads no mesh with one before the counts.
    text += "OFF\n";
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
