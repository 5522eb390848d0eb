#include "viewer/window/screen/display.h"

#include <algorithm>

namespace lissom::window {
namespace {

constexpr Color kDarkBackground{0.17, 0.18, 0.20};
constexpr Color kLightBackground{0.93, 0.935, 0.94};
constexpr double kSeenThrough = 0.5;

bool is_hidden(const DisplaySettings& settings, std::size_t mesh) {
    return mesh < settings.hidden.size() && settings.hidden[mesh];
}

void apply(const DisplaySettings& settings, MeshStyle& style) {
    if (settings.wire) style.wire = true;
    if (settings.flat) style.shading = Shading::flat;
    if (settings.boundaries) style.boundaries = true;
    if (settings.see_through) style.opacity = std::min(style.opacity, kSeenThrough);
    if (settings.vertex_normals) style.vertex_normals = true;
    if (settings.face_normals) style.face_normals = true;
    style.wire_width *= settings.scale;
    style.line_width *= settings.scale;
}

void widen(Overlay& marks, double scale) {
    for (DrawnLine& line : marks.lines) line.width *= scale;
    for (DrawnPoint& point : marks.points) point.radius *= scale;
}

// Those of a picture that are shown, in one space.
Picture visible(const Picture& picture, const DisplaySettings& settings) {
    const Snapshot placed = snapshot_of(picture);
    Picture result = picture;
    result.meshes.clear();
    result.strands.clear();
    result.columns = 0;
    result.captions.clear();
    widen(result.marks, settings.scale);
    widen(result.tool_marks, settings.scale);
    for (std::size_t i = 0; i < placed.meshes.size(); ++i) {
        if (is_hidden(settings, i)) continue;
        result.meshes.push_back(placed.meshes[i]);
        apply(settings, result.meshes.back().style);
    }
    for (std::size_t i = 0; i < placed.strands.size(); ++i) {
        const auto mesh = picture.strands[i].mesh;
        if (mesh && is_hidden(settings, *mesh)) continue;
        result.strands.push_back({placed.strands[i], std::nullopt});
    }
    const bool has_range = placed.range.low < placed.range.high;
    if (has_range && range_of_values(result.meshes)) result.range = placed.range;
    if (result.meshes.empty()) result.legend = false;
    return result;
}

}  // namespace

Color background_of(const DisplaySettings& settings) {
    return settings.dark ? kDarkBackground : kLightBackground;
}

Picture displayed(const Picture& picture, const DisplaySettings& settings, const Camera& camera,
                  int width, int height) {
    Picture result = visible(picture, settings);
    result.camera = camera;
    result.options = {};
    result.options.width = width;
    result.options.height = height;
    result.options.background = background_of(settings);
    return result;
}

Snapshot quick_snapshot(const Picture& picture, const DisplaySettings& settings) {
    return snapshot_of(visible(picture, settings));
}

std::optional<Legend> shown_legend(const Picture& picture, const DisplaySettings& settings) {
    return legend_of(visible(picture, settings));
}

}  // namespace lissom::window
