#include "viewer/render/draw/scene_drawing.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "kernel/hair/strands/strand_place.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"
#include "viewer/render/draw/style_marks.h"

namespace lissom {
namespace {

// Number of vertices without faces that are drawn, and their radius in pixels.
constexpr std::size_t kMaxPoints = 50000;
constexpr double kPointRadius = 2.0;

Color color_of(const std::optional<Vec3>& rgb, const Color& usual) {
    return rgb ? Color{rgb->x(), rgb->y(), rgb->z()} : usual;
}

MeshStyle mesh_style(const ObjectStyle& given, const Mesh& mesh) {
    MeshStyle style;
    style.color = color_of(given.color, style.color);
    // A colour of its own counts before those of the vertices.
    style.vertex_colors = given.vertex_colors && !given.color;
    style.shading = given.flat ? Shading::flat : Shading::smooth;
    style.crease = given.crease;
    style.wire = given.wire;
    style.wire_color = color_of(given.wire_color, style.wire_color);
    style.wire_width = given.wire_width;
    style.boundaries = given.boundaries;
    style.line_width = given.line_width;
    if (const Region* region = mesh.find_region(given.region)) style.region = *region;
    return style;
}

// A region of the whole mesh says nothing.
void add_handles(const Deformer& deformer, MeshStyle& style) {
    const Region& region = deformer.region();
    if (region.size() < region.topology()->vertex_count()) style.region = region;
    for (const HandleId id : deformer.handles()) {
        style.handles.push_back(deformer.handle(id).region);
    }
}

class SceneDraughtsman {
  public:
    explicit SceneDraughtsman(const ObjectList& objects) : objects_(objects) {}

    // Meshes come first: deformations and hair look for theirs.
    SceneDrawing draw() {
        for (const ItemKind kind : {ItemKind::mesh, ItemKind::deformation, ItemKind::strands,
                                    ItemKind::hairstyle, ItemKind::polyline}) {
            for (const auto& object : objects_) {
                if (object->look.visible && object->item->kind() == kind) add(*object);
            }
        }
        return std::move(drawing_);
    }

  private:
    void add(const NamedObject& object) {
        const SceneItem* item = object.item.get();
        if (const auto* mesh = dynamic_cast<const MeshItem*>(item)) {
            if (mesh->mesh().face_count() == 0) return add_points(object, mesh->mesh());
            add_mesh(object, mesh->shared_mesh());
        } else if (const auto* edit = dynamic_cast<const DeformItem*>(item)) {
            add_deformation(object, *edit);
        } else if (const auto* strands = dynamic_cast<const StrandsItem*>(item)) {
            add_strands(object, strands->shared_strands());
        } else if (const auto* style = dynamic_cast<const HairstyleItem*>(item)) {
            for (DrawnLine& line : style_lines(style->style(), marks_of(object))) {
                add_line(object, std::move(line));
            }
            add_field(object, field_marks(style->style()));
        } else if (const auto* line = dynamic_cast<const PolylineItem*>(item)) {
            const Polyline& drawn = line->polyline();
            const Color color = color_of(object.look.style.color, kWireColor);
            add_line(object, {drawn.points, drawn.closed, color, object.look.style.line_width});
        }
    }

    DrawnMesh& add_mesh(const NamedObject& object, std::shared_ptr<const Mesh> mesh) {
        MeshStyle style = mesh_style(object.look.style, *mesh);
        drawing_.meshes.push_back(
            {std::move(mesh), std::move(style), object.look.transform, object.id.value});
        return drawing_.meshes.back();
    }

    void add_points(const NamedObject& object, const Mesh& mesh) {
        const std::span<const Vec3> positions = mesh.positions();
        const std::size_t stride = positions.size() / kMaxPoints + 1;
        const Color color = color_of(object.look.style.color, kWireColor);
        for (std::size_t i = 0; i < positions.size(); i += stride) {
            const Vec3 place = object.look.transform(positions[i]);
            if (place.allFinite()) drawing_.points.push_back({place, color, kPointRadius});
        }
    }

    DrawnMesh* find_mesh(const Mesh* mesh) {
        const auto is_it = [&](const DrawnMesh& drawn) { return drawn.mesh.get() == mesh; };
        const auto found = std::find_if(drawing_.meshes.begin(), drawing_.meshes.end(), is_it);
        return found == drawing_.meshes.end() ? nullptr : &*found;
    }

    void add_deformation(const NamedObject& object, const DeformItem& edit) {
        const auto part = std::dynamic_pointer_cast<MeshItem>(edit.parts().front());
        if (!part || part->mesh().face_count() == 0) return;
        DrawnMesh* drawn = find_mesh(&part->mesh());
        if (!drawn) drawn = &add_mesh(object, part->shared_mesh());
        const bool current = edit.deformer().region().topology() == drawn->mesh->shared_topology();
        if (object.look.style.handles && current) add_handles(edit.deformer(), drawn->style);
    }

    void add_strands(const NamedObject& object, std::shared_ptr<const Strands> strands) {
        StrandStyle style;
        if (object.look.style.color) style.color = color_of(object.look.style.color, {});
        style.level = object.look.style.level;
        for (const DrawnMesh& drawn : drawing_.meshes) {
            const auto unit = unit_of_roots(*strands, *drawn.mesh);
            if (!unit) continue;
            style.unit = *unit;
            break;
        }
        drawing_.strands.push_back({std::move(strands), style, object.look.transform});
    }

    static StyleMarks marks_of(const NamedObject& object) {
        StyleMarks marks;
        marks.width = object.look.style.line_width;
        return marks;
    }

    // Styles of one scene share their legend.
    void add_field(const NamedObject& object, NamedMarks marks) {
        for (DrawnLine& line : marks.lines) {
            for (Vec3& point : line.points) point = object.look.transform(point);
            drawing_.field.lines.push_back(std::move(line));
        }
        for (LegendPart& part : marks.names) {
            auto& names = drawing_.field.names;
            if (std::find(names.begin(), names.end(), part) == names.end()) {
                names.push_back(std::move(part));
            }
        }
    }

    void add_line(const NamedObject& object, DrawnLine line) {
        for (Vec3& point : line.points) point = object.look.transform(point);
        drawing_.lines.push_back(std::move(line));
    }

    const ObjectList& objects_;
    SceneDrawing drawing_;
};

}  // namespace

SceneDrawing drawing_of(const ObjectList& objects) {
    return SceneDraughtsman(objects).draw();
}

}  // namespace lissom
