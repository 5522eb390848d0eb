#include "viewer/window/panel/boundary_pick.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lissom::window {
namespace {

// How far from a boundary a click counts, in units of length.
constexpr double kPickReach = 14.0;

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 side = b - a;
    const double length = side.squaredNorm();
    const double along = length > 0.0 ? std::clamp((p - a).dot(side) / length, 0.0, 1.0) : 0.0;
    return (p - a - along * side).norm();
}

// Returns the pixels of a loop in front of the camera; none if a part lies behind it.
std::vector<Vec2> pixels_of(const PickLoop& loop, const Camera& camera, const PictureSize& size) {
    std::vector<Vec2> pixels;
    for (const Vec3& point : loop.points) {
        const Vec3 pixel = camera.project(point, size);
        if (!(pixel.z() > 0.0) || !pixel.allFinite()) return {};
        pixels.push_back(pixel.head<2>());
    }
    return pixels;
}

double distance_to_loop(const std::vector<Vec2>& pixels, const Vec2& at) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        nearest =
            std::min(nearest, distance_to_segment(at, pixels[i], pixels[(i + 1) % pixels.size()]));
    }
    return nearest;
}

struct PickedPlace {
    lua::ScriptParameter* parameter = nullptr;
    std::size_t number = 0;
    std::vector<const PickLoop*> loops = {};
};

// Returns the parameter that is picked, and its boundaries; no parameter if it has gone.
PickedPlace place_of(PanelContent& content) {
    auto& list = content.picking->of_tool ? content.tool.parameters : content.parameters;
    const auto found = std::find_if(list.begin(), list.end(), [&](const lua::ScriptParameter& p) {
        return p.name == content.picking->parameter && p.type == lua::ParameterType::boundary;
    });
    if (found == list.end()) return {};
    PickedPlace place{&*found, static_cast<std::size_t>(found - list.begin())};
    for (const PickMesh* mesh : meshes_of(*found, list, content.picks)) {
        for (const PickLoop& loop : mesh->boundaries) place.loops.push_back(&loop);
    }
    return place;
}

class LoopDrawing {
  public:
    LoopDrawing(const PanelContent& content, const Canvas& canvas, double scale)
        : content_(content),
          corner_(static_cast<float>(canvas.x), static_cast<float>(canvas.y)),
          scale_(static_cast<float>(scale)) {
        const ImVec2 end(corner_.x + static_cast<float>(content.picture_size.width),
                         corner_.y + static_cast<float>(content.picture_size.height));
        list_->PushClipRect(corner_, end);
    }
    LoopDrawing(const LoopDrawing&) = delete;
    LoopDrawing& operator=(const LoopDrawing&) = delete;
    ~LoopDrawing() { list_->PopClipRect(); }

    void draw(const PickLoop& loop, bool is_near) {
        const auto pixels = pixels_of(loop, content_.camera, content_.picture_size);
        if (pixels.empty()) return;
        std::vector<ImVec2> points;
        for (const Vec2& pixel : pixels) points.push_back(on_screen(pixel));
        const ImU32 color = is_near ? IM_COL32(255, 170, 40, 255) : IM_COL32(90, 190, 255, 255);
        list_->AddPolyline(points.data(), count_of(points), color, ImDrawFlags_Closed,
                           (is_near ? 4.0f : 2.0f) * scale_);
        Vec2 middle = Vec2::Zero();
        for (const Vec2& pixel : pixels) middle += pixel / static_cast<double>(pixels.size());
        write(loop.value, on_screen(middle), color);
    }

  private:
    ImVec2 on_screen(const Vec2& pixel) const {
        return ImVec2(corner_.x + static_cast<float>(pixel.x()),
                      corner_.y + static_cast<float>(pixel.y()));
    }
    // In the middle of the loop, on a dark ground.
    void write(const std::string& text, const ImVec2& middle, ImU32 color) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const ImVec2 from(middle.x - 0.5f * size.x, middle.y - 0.5f * size.y);
        list_->AddRectFilled(ImVec2(from.x - 5.0f, from.y - 2.0f),
                             ImVec2(from.x + size.x + 5.0f, from.y + size.y + 2.0f),
                             IM_COL32(24, 26, 30, 210), 3.0f);
        list_->AddText(from, color, text.c_str());
    }

    const PanelContent& content_;
    ImDrawList* list_ = ImGui::GetBackgroundDrawList();
    ImVec2 corner_;
    float scale_;
};

void pick(const PickLoop& loop, const PickedPlace& place, PanelContent& content,
          PanelAnswers& answers) {
    place.parameter->value = loop.value;
    if (content.picking->of_tool) {
        answers.tool.parameter = place.number;
    } else {
        answers.parameters_changed = true;
    }
    content.picking.reset();
}

}  // namespace

const PickLoop* loop_near(const std::vector<const PickLoop*>& loops, const Camera& camera,
                          const PictureSize& size, const Vec2& pixel, double reach) {
    const PickLoop* nearest = nullptr;
    for (const PickLoop* loop : loops) {
        const double distance = distance_to_loop(pixels_of(*loop, camera, size), pixel);
        if (!(distance < reach)) continue;
        reach = distance;
        nearest = loop;
    }
    return nearest;
}

void draw_boundary_pick(PanelContent& content, PanelAnswers& answers, const Canvas& canvas,
                        double scale) {
    if (!content.picking) return;
    const PickedPlace place = place_of(content);
    if (!place.parameter || ImGui::IsKeyPressed(ImGuiKey_Escape)) return content.picking.reset();
    const ImVec2 mouse = ImGui::GetMousePos();
    const Vec2 pixel(mouse.x - static_cast<float>(canvas.x),
                     mouse.y - static_cast<float>(canvas.y));
    const bool is_inside = (pixel.array() >= 0.0).all() && pixel.x() < canvas.width &&
                           pixel.y() < canvas.height && !ImGui::GetIO().WantCaptureMouse;
    const PickLoop* near = is_inside ? loop_near(place.loops, content.camera, content.picture_size,
                                                 pixel, scale * kPickReach)
                                     : nullptr;
    {
        LoopDrawing drawing(content, canvas, scale);
        for (const PickLoop* loop : place.loops) drawing.draw(*loop, loop == near);
    }
    if (near && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) pick(*near, place, content, answers);
}

}  // namespace lissom::window
