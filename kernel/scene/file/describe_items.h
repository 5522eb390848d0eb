/// Names of the contents of scene files: one description of each record for writing and reading;
/// private to kernel/scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/description.h"
#include "kernel/deform/holds/bone_handles.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/report.h"
#include "kernel/scene/file/item_records.h"
#include "kernel/scene/file/scene_archive.h"
#include "kernel/scene/polyline.h"
#include "kernel/scene/scene_state.h"

namespace lissom {

// ---- Names of files

inline std::string label_of(const Attribute& attribute) {
    return attribute.name;
}
inline std::string label_of(const LabelRecord& labels) {
    return labels.kind;
}
inline std::string label_of(const RegionRecord& region) {
    return region.name;
}

// ---- Meshes

template <typename Archive>
void describe(Archive& a, Attribute& attribute) {
    static constexpr const char* kDomains[] = {"vertex", "corner", "face"};
    static constexpr const char* kTypes[] = {"float32", "float64", "int8",  "uint8",
                                             "int16",   "uint16",  "int32", "uint32"};
    a.text("name", attribute.name);
    a.choice("domain", attribute.domain, kDomains);
    a.integer("width", attribute.width);
    a.choice("type", attribute.type, kTypes);
    a.list("values", attribute.values,
           static_cast<std::size_t>(std::max(attribute.width, Index{1})));
}

template <typename Archive>
void describe_finding(Archive& a, Finding& finding) {
    std::vector<const char*> kinds, elements;
    for (const FindingKind kind : all_finding_kinds()) kinds.push_back(finding_name(kind).data());
    for (int kind = 0; kind <= static_cast<int>(ElementKind::strand); ++kind) {
        elements.push_back(kind_name(static_cast<ElementKind>(kind)).data());
    }
    auto count = static_cast<double>(finding.count);
    a.choice("kind", finding.kind, kinds);
    a.choice("element", finding.element, elements);
    a.flag("in_file", finding.in_file);
    a.number("count", count);
    finding.count = count >= 0.0 && count < 1e18 ? static_cast<std::size_t>(count) : 0;
    a.text("message", finding.message);
    a.list("ids", finding.ids);
}

template <typename Archive>
void describe(Archive& a, MeshRecord& mesh) {
    if (!a.surface(mesh.positions, mesh.offsets, mesh.corners)) {
        a.list("positions", mesh.positions);
        a.list("offsets", mesh.offsets);
        a.list("corners", mesh.corners);
    }
    a.objects("attributes", mesh.attributes, [](Archive& b, Attribute& x) { describe(b, x); });
    a.objects("labels", mesh.labels, [](Archive& b, LabelRecord& record) {
        b.text("kind", record.kind);
        b.texts("names", record.labels.names);
        b.list("of_face", record.labels.of_face);
    });
    a.objects("regions", mesh.regions, [](Archive& b, RegionRecord& region) {
        b.text("name", region.name);
        b.list("vertices", region.vertices);
    });
    a.texts("material_libraries", mesh.material_libraries);
    a.objects("report", mesh.findings, [](Archive& b, Finding& x) { describe_finding(b, x); });
}

// ---- Strands

template <typename Archive, typename Value>
void describe_values(Archive& a, StrandValues<Value>& values) {
    static constexpr const char* kDomains[] = {"all", "strand", "point"};
    std::vector<Value> common{values.common};
    a.choice("domain", values.domain, kDomains);
    a.list("common", common);
    a.list("values", values.values);
    if (common.size() != 1)
        throw Error(ErrorCode::file_syntax, "strands of the scene lack a value");
    values.common = common.front();
}

// Files without them have roots on triangles, or weights of the first three corners of faces.
template <typename Archive>
void describe_root_triangles(Archive& a, StrandRoots& roots) {
    std::optional<std::vector<Index>> vertices;
    if (!roots.triangles.empty()) {
        vertices.emplace();
        for (const Triangle& t : roots.triangles)
            vertices->insert(vertices->end(), t.begin(), t.end());
    }
    a.optional("root_triangles", vertices,
               [](Archive& b, std::vector<Index>& x) { b.list("vertices", x); });
    if (!Archive::kReads || !vertices) return;
    if (vertices->size() % 3 != 0) {
        throw Error(ErrorCode::file_syntax, "triangles of roots in the scene are not whole");
    }
    roots.triangles.clear();
    for (std::size_t i = 0; i < vertices->size(); i += 3) {
        roots.triangles.push_back({(*vertices)[i], (*vertices)[i + 1], (*vertices)[i + 2]});
    }
}

template <typename Archive>
void describe(Archive& a, StrandsRecord& strands) {
    if (Archive::kReads) strands.offsets.clear();
    if (!a.lines(strands.points, strands.offsets)) {
        a.list("points", strands.points);
        a.list("offsets", strands.offsets);
    }
    a.object("widths", [&](Archive& b) {
        describe_values(b, strands.widths);
        b.list("profile", strands.widths.profile);
    });
    a.list("root_faces", strands.roots.faces);
    a.list("root_weights", strands.roots.barycentrics);
    a.list("root_uvs", strands.roots.uvs);
    a.list("groups", strands.groups);
    a.texts("group_names", strands.group_names);
    a.list("ids", strands.ids);
    std::optional<StrandGuides> guides;
    if (!strands.guides.ids.empty()) guides = strands.guides;
    a.optional("guides", guides, [](Archive& b, StrandGuides& x) {
        b.list("ids", x.ids);
        b.list("arcs", x.arcs);
    });
    strands.guides = std::move(guides).value_or(StrandGuides());
    describe_root_triangles(a, strands.roots);
    a.optional("colors", strands.colors, [](Archive& b, auto& x) { describe_values(b, x); });
    a.object("transparency", [&](Archive& b) { describe_values(b, strands.transparency); });
    a.text("comment", strands.comment);
}

// ---- Deformations

// Files without these displaced flat vertices, and do so still.
template <typename Archive>
void describe_surface(Archive& a, DeformOptions& options) {
    static constexpr const char* kFlatNames[] = {"extended", "displaced"};
    static constexpr const char* kLooseNames[] = {"error", "stay", "follow"};
    std::optional<DeformOptions> given = options;
    a.optional("surface", given, [](Archive& b, DeformOptions& o) {
        b.choice("flat", o.flat, kFlatNames);
        b.choice("loose", o.loose, kLooseNames);
        b.integer("free_rings", o.free_rings);
    });
    options.flat = given ? given->flat : FlatVertices::displaced;
    if (!given) return;
    options.loose = given->loose;
    options.free_rings = given->free_rings;
}

template <typename Archive>
void describe(Archive& a, DeformOptions& options) {
    static constexpr const char* kMethods[] = {
        "implicit", "naive", "rotation_estimate", "similarity", "geodesic", "harmonic", "frames"};
    static constexpr const char* kSecond[] = {"blend", "laplacian", "poisson"};
    static constexpr const char* kSizes[] = {"keep", "scale"};
    static constexpr const char* kWeights[] = {"cotangent", "uniform"};
    a.choice("method", options.method, kMethods);
    a.choice("second", options.second, kSecond);
    a.choice("local_size", options.local_size, kSizes);
    a.choice("weights", options.weights, kWeights);
    a.integer("refine", options.refine);
    a.integer("coherence", options.coherence);
    a.number("coherence_weight", options.coherence_weight);
    a.number("degenerate_threshold", options.degenerate_threshold);
    describe_surface(a, options);
    a.flag("refine_borders", options.subdivide_borders);
    a.number("displacement", options.displacement);
    a.flag("scale_free", options.scale_free);
    a.number("transition", options.transition);
    std::optional<double> levels, volume;
    if (options.level_vertices != 0) levels = options.level_vertices;
    a.number("level_vertices", levels);
    options.level_vertices = static_cast<Index>(std::clamp(levels.value_or(0.0), 0.0, 1e9));
    if (options.volume != 0.0) volume = options.volume;
    a.number("volume", volume);
    options.volume = volume.value_or(0.0);
}

template <typename Archive>
void describe(Archive& a, MeshPoint& point) {
    a.few("vertices", point.vertices);
    a.few("weights", point.weights);
}

template <typename Archive>
void describe(Archive& a, HandleDescription& handle) {
    Index partner = handle.partner ? handle.partner->value : kNoIndex;
    a.list("vertices", handle.vertices);
    a.objects("points", handle.points, [](Archive& b, MeshPoint& x) { describe(b, x); });
    a.flag("position", handle.options.position);
    a.flag("gradient", handle.options.gradient);
    a.number("weight", handle.options.weight);
    a.number("falloff", handle.options.falloff);
    a.integer("partner", partner);
    handle.partner = partner == kNoIndex ? std::nullopt : std::optional(HandleId{partner});
    describe_vector(a, "mirror_point", handle.mirror.point);
    describe_vector(a, "mirror_normal", handle.mirror.normal);
    a.number("mirror_tolerance", handle.mirror.tolerance);
    describe_map(a, "transform", handle.pose.transform);
    describe_map(a, "local_transform", handle.pose.local_transform);
    describe_vector(a, "turn", handle.pose.turn);
}

template <typename Archive>
void describe(Archive& a, PointConstraint& constraint) {
    a.object("point", [&](Archive& b) { describe(b, constraint.point); });
    a.optional("position", constraint.position,
               [](Archive& b, Vec3& x) { describe_vector(b, "at", x); });
    a.optional("gradient", constraint.gradient,
               [](Archive& b, Mat3& x) { describe_matrix(b, "columns", x); });
    a.number("weight", constraint.weight);
}

template <typename Archive>
void describe(Archive& a, Bones& bones) {
    std::vector<Index> handles;
    for (const HandleId id : bones.handles) handles.push_back(id.value);
    a.few("handles", handles);
    bones.handles.clear();
    for (const Index id : handles) bones.handles.push_back({id});
    std::vector<double> joints;
    for (const Vec3& joint : bones.joints) joints.insert(joints.end(), joint.begin(), joint.end());
    a.few("joints", joints);
    bones.joints.clear();
    for (std::size_t i = 0; i + 2 < joints.size(); i += 3) {
        bones.joints.emplace_back(joints[i], joints[i + 1], joints[i + 2]);
    }
    a.few("limits", bones.limits);
}

template <typename Archive>
void describe(Archive& a, DeformRecord& record) {
    a.integer("mesh", record.mesh);
    a.list("region", record.region);
    a.object("options", [&](Archive& b) { describe(b, record.options); });
    a.objects("handles", record.description.handles,
              [](Archive& b, std::optional<HandleDescription>& handle) {
                  b.optional("handle", handle,
                             [](Archive& c, HandleDescription& x) { describe(c, x); });
              });
    a.objects("constraints", record.description.constraints,
              [](Archive& b, PointConstraint& x) { describe(b, x); });
    std::optional<std::vector<Bones>> bones;
    if (!record.description.bones.empty()) bones = record.description.bones;
    a.optional("bones", bones, [](Archive& b, std::vector<Bones>& chains) {
        b.objects("chains", chains, [](Archive& c, Bones& x) { describe(c, x); });
    });
    record.description.bones = bones.value_or(std::vector<Bones>());
    a.list("stiffness", record.description.stiffness);
    a.number("volume", record.description.volume);
    a.list("rest", record.rest);
    a.list("shown", record.shown);
    a.list("gradients", record.gradients);
    a.list("turns_without_faces", record.turns_without_faces);
    a.objects("directions", record.directions, [](Archive& b, Attribute& x) { describe(b, x); });
}

// ---- Hairstyles and curves

template <typename Archive>
void describe(Archive& a, ScalpRecord& scalp) {
    const auto direction = [](Archive& b, Vec3& x) { describe_vector(b, "direction", x); };
    a.optional("up", scalp.up, direction);
    a.optional("front", scalp.front, direction);
    a.number("unit", scalp.unit);
    a.optional("region", scalp.region,
               [](Archive& b, std::vector<Index>& x) { b.list("vertices", x); });
    a.few("hairline", scalp.hairline);
    a.number("softness", scalp.softness);
}

template <typename Archive>
void describe(Archive& a, HairstyleRecord& record) {
    std::vector<std::int64_t> scalp_edit{record.scalp_edit};
    a.integer("head", record.head);
    a.text("style", record.style);
    a.list("tilts", record.tilts);
    a.list("ids", record.ids);
    a.list("edits", record.edits);
    a.list("scalp_edit", scalp_edit);
    if (!scalp_edit.empty()) record.scalp_edit = scalp_edit.front();
    a.list("step_points", record.step_points);
    a.list("step_tags", record.step_tags);
    a.list("step_values", record.step_values);
    a.list("step_weights", record.step_weights);
    a.object("scalp", [&](Archive& b) { describe(b, record.scalp); });
}

template <typename Archive>
void describe(Archive& a, Polyline& polyline) {
    a.list("points", polyline.points);
    a.flag("closed", polyline.closed);
}

// ---- Objects

template <typename Archive>
void describe(Archive& a, ObjectStyle& style) {
    const auto color = [](Archive& b, Vec3& x) { describe_vector(b, "rgb", x); };
    a.optional("color", style.color, color);
    a.flag("vertex_colors", style.vertex_colors);
    a.flag("flat", style.flat);
    a.number("crease", style.crease);
    a.flag("wire", style.wire);
    a.optional("wire_color", style.wire_color, color);
    a.number("wire_width", style.wire_width);
    a.number("line_width", style.line_width);
    a.flag("boundaries", style.boundaries);
    a.text("region", style.region);
    a.flag("handles", style.handles);
    a.number("level", style.level);
}

/// An object of the file; it shows item `item`.
struct ObjectRecord {
    std::string name;
    Index item = 0;
    ObjectLook look;
};

template <typename Archive>
void describe(Archive& a, ObjectRecord& object) {
    a.text("name", object.name);
    a.integer("item", object.item);
    describe_map(a, "transform", object.look.transform);
    a.flag("visible", object.look.visible);
    a.object("style", [&](Archive& b) { describe(b, object.look.style); });
}

}  // namespace lissom
