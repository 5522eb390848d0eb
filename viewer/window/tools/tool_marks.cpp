#include "viewer/window/tools/tool_marks.h"

#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

namespace lissom::window {
namespace {

// The region that all tools share.
constexpr std::string_view kSelected = "selected";
constexpr Color kLabelColor{0.95, 0.95, 0.95};

Color color_or(const std::string& text, const Color& usual) {
    return text.empty() ? usual : parse_color(text);
}

ToolOutline circle(const lua::CircleMark& mark) {
    constexpr int kCorners = 64;
    ToolOutline outline;
    outline.closed = true;
    outline.color = color_or(mark.color, kLabelColor);
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * kPi * i / kCorners;
        outline.pixels.emplace_back(mark.at.x() + mark.radius * std::cos(angle),
                                    mark.at.y() + mark.radius * std::sin(angle));
    }
    return outline;
}

}  // namespace

Overlay overlay_of(const lua::ToolViewObject& view) {
    Overlay overlay;
    for (const lua::PointMarks& mark : view.points) {
        const Color color = color_or(mark.color, kHandleColor);
        for (const Vec3& p : mark.points) overlay.points.push_back({p, color, mark.radius});
    }
    for (const lua::LineMark& mark : view.lines) {
        overlay.lines.push_back(
            {mark.points, mark.closed, color_or(mark.color, kWireColor), mark.width});
    }
    return overlay;
}

ToolMarks marks_of(const lua::ToolViewObject& view) {
    ToolMarks marks;
    for (const lua::LabelMark& mark : view.labels) {
        marks.labels.push_back({mark.at, mark.text, color_or(mark.color, kLabelColor)});
    }
    for (const lua::OutlineMark& mark : view.outlines) {
        marks.outlines.push_back({mark.pixels, mark.closed, color_or(mark.color, kLabelColor),
                                  mark.width, mark.opacity});
    }
    for (const lua::CircleMark& mark : view.circles) marks.outlines.push_back(circle(mark));
    for (const lua::SurfaceMark& mark : view.surfaces) {
        marks.surfaces.push_back(
            {mark.from, mark.to, color_or(mark.color, kHandleColor), mark.opacity});
    }
    return marks;
}

void paint_regions(const lua::ToolViewObject& view, Picture& picture) {
    for (DrawnMesh& drawn : picture.meshes) {
        const Region* selected = drawn.mesh->find_region(kSelected);
        if (selected && !drawn.style.region) drawn.style.region = *selected;
        for (const lua::RegionMark& mark : view.regions) {
            if (drawn.mesh.get() != &mark.mesh->mesh) continue;
            if (mark.region.topology() != drawn.mesh->shared_topology()) continue;
            drawn.style.parts.push_back({mark.region, color_or(mark.color, kRegionColor)});
        }
    }
}

void add_meshes(const lua::ToolViewObject& view, Picture& picture) {
    for (const lua::MeshMark& mark : view.meshes) {
        if (mark.mesh->mesh.face_count() == 0) continue;
        DrawnMesh drawn{std::shared_ptr<const Mesh>(mark.mesh, &mark.mesh->mesh)};
        drawn.transform = mark.transform;
        drawn.style.color = color_or(mark.color, drawn.style.color);
        drawn.style.raised = true;
        picture.meshes.push_back(std::move(drawn));
    }
}

}  // namespace lissom::window
