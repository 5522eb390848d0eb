#include "bindings/lua/sketch/pick_targets.h"

#include <algorithm>
#include <utility>

#include "bindings/lua/scene/scene_object.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"

namespace lissom::lua {
namespace {

// The curves of a hairstyle, one line each, in their order.
PolylineSet curves_of(const Hairstyle& style) {
    std::vector<Vec3> points;
    std::vector<Index> offsets{0};
    for (const CurveId id : style.curves()) {
        for (const Vec3& p : style.course(id)) points.push_back(style.scalp().from_metres(p));
        offsets.push_back(count_of(points));
    }
    return {std::move(points), std::move(offsets)};
}

PolylineSet line_of(const Polyline& line) {
    const Index count = count_of(line.points);
    return {line.points, {0, count}, line.closed};
}

}  // namespace

void PickTargets::read(const Call& call) {
    if (call.has("scene")) add_scene(call);
    if (call.has("mesh")) add_mesh(call, call.object<MeshObject>("mesh").share());
    const std::size_t count = call.has("meshes") ? call.object_count("meshes") : 0;
    for (std::size_t i = 0; i < count; ++i) {
        add_mesh(call, call.object_at<MeshObject>("meshes", i).share());
    }
}

void PickTargets::add_scene(const Call& call) {
    for (const auto& object : call.object<SceneObject>("scene")->scene.objects()) {
        if (!object->look.visible) continue;
        const Affine& place = object->look.transform;
        const auto* const item = dynamic_cast<const ScriptItem*>(object->item.get());
        if (auto mesh = item ? item->surface() : nullptr) {
            add_mesh(call, std::move(mesh), object->name, place);
        } else if (const auto* line = dynamic_cast<const PolylineItem*>(object->item.get())) {
            add_lines(line_of(line->polyline()), object->name, place);
        } else if (const auto* hair = dynamic_cast<const HairstyleItem*>(object->item.get())) {
            add_lines(curves_of(hair->style()), object->name, place);
        }
    }
}

void PickTargets::add_mesh(const Call& call, std::shared_ptr<MeshObject> mesh, std::string name,
                           const Affine& place) {
    if (mesh->mesh.face_count() == 0) return;
    // A deformation shows the mesh that it deforms, which may be an object of its own.
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        if (targets_[i].mesh == mesh && scene_.object(index_of(i)).to_world == place) return;
    }
    scene_.add(mesh->tree(call.context()), {.to_world = place});
    targets_.push_back({std::move(name), std::move(mesh)});
}

void PickTargets::add_lines(PolylineSet lines, std::string name, const Affine& place) {
    lines_.push_back(std::make_unique<PolylineSet>(std::move(lines)));
    scene_.add(*lines_.back(), {.to_world = place});
    targets_.push_back({std::move(name), nullptr});
}

// Unit of drawing: metres, unless a mesh tells another.
double PickTargets::unit_of(const Strands& strands) const {
    for (const Target& target : targets_) {
        if (!target.mesh) continue;
        if (const auto unit = unit_of_roots(strands, target.mesh->mesh)) return *unit;
    }
    return 1.0;
}

void PickTargets::add_hair(const Call& call, const View& view, const Vec2& cursor, double radius) {
    if (!call.has("scene")) return;
    for (const auto& object : call.object<SceneObject>("scene")->scene.objects()) {
        const auto* item = dynamic_cast<const StrandsItem*>(object->item.get());
        if (!item || !object->look.visible) continue;
        const Strands& strands = item->strands();
        Affine place = object->look.transform;
        place.linear /= unit_of(strands);
        std::vector<LineRun> runs = lines_near(strands.points(), strands.offsets(), place, view,
                                               cursor, radius, call.context());
        if (runs.empty()) continue;
        std::vector<Vec3> points;
        std::vector<Index> offsets{0};
        for (const LineRun& run : runs) {
            const StrandView strand = strands.strand(run.line);
            for (Index k = run.first; k <= run.last; ++k) points.push_back(point_of(strand, k));
            offsets.push_back(count_of(points));
        }
        add_lines({std::move(points), std::move(offsets)}, object->name, place);
        targets_.back().runs = std::move(runs);
    }
}

PickHit PickTargets::known(PickHit hit) const {
    const std::vector<LineRun>& runs = targets_[at(hit.object)].runs;
    if (runs.empty()) return hit;
    const LineRun& run = runs[at(hit.index)];
    hit.index = run.line;
    hit.segment += run.first;
    return hit;
}

void PickTargets::add_points(std::span<const Vec3> points, bool on_top) {
    points_.push_back(std::make_unique<PointSet>(std::vector<Vec3>(points.begin(), points.end())));
    scene_.add(*points_.back(), {.on_top = on_top});
    targets_.push_back({});
}

void PickTargets::charge(const Call& call) const {
    for (const Target& target : targets_) {
        if (!target.mesh) continue;
        const std::size_t before = target.mesh->charged_bytes;
        target.mesh->charged_bytes = target.mesh->memory_bytes();
        if (target.mesh->charged_bytes > before) {
            call.charge_bytes(target.mesh->charged_bytes - before);
        }
    }
}

void PickTargets::push_fields(const Call& call, Index object) const {
    const Target& target = targets_[at(object)];
    if (!target.name.empty()) call.set_field("object", call.push(std::string_view(target.name)));
    if (target.mesh) call.set_field("mesh", call.push_shared(target.mesh));
}

std::vector<Parameter> target_options() {
    return {object("scene", "lissom.Scene",
                   "Its visible objects, in their places: meshes, deformations, free curves, "
                   "the curves of hairstyles, and for polylines the strands of hair.")
                .optional(),
            object("mesh", "lissom.Mesh", "A mesh in its own coordinates.").optional(),
            objects("meshes", "lissom.Mesh", "Several such meshes.").optional()};
}

}  // namespace lissom::lua
