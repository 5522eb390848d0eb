#include "kernel/scene/file/item_records.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/io/style_file.h"

namespace lissom {
namespace {

void require_valid(bool condition, const char* message) {
    require(condition, message, ErrorCode::file_syntax);
}

// ---- Meshes

FaceList faces_of(MeshRecord& record) {
    const std::vector<Index>& offsets = record.offsets;
    require_valid(!offsets.empty() && offsets.front() == 0 &&
                      std::is_sorted(offsets.begin(), offsets.end()) &&
                      at(offsets.back()) == record.corners.size(),
                  "the faces of a mesh of the scene do not fit each other");
    return {std::move(record.offsets), std::move(record.corners)};
}

void require_labels(const LabelRecord& record) {
    const Index count = count_of(record.labels.names);
    for (const Index label : record.labels.of_face) {
        require_valid(label >= kNoIndex && label < count, "a face of the scene has no such label");
    }
}

void add_all(Mesh& mesh, std::vector<Attribute> attributes) {
    constexpr Index kWidest = 4096;
    for (Attribute& attribute : attributes) {
        require_valid(attribute.width > 0 && attribute.width <= kWidest,
                      "an attribute of the scene has a wrong width");
        mesh.attributes().add(std::move(attribute));
    }
}

bool is_direction(const Attribute& attribute) {
    const AttributeRole role = role_of(attribute);
    return role == AttributeRole::normal || role == AttributeRole::tangent ||
           role == AttributeRole::morph_position || role == AttributeRole::morph_normal ||
           role == AttributeRole::morph_tangent;
}

// ---- Deformations

// The mesh as it was at rest, as far as the deformation knows.
Mesh rest_mesh(const RestShape& rest, const Mesh& mesh) {
    Mesh result = mesh;
    try {
        write_rest(rest, result);
    } catch (const Error& error) {
        // If the mesh has changed around the region nothing can be carried.
        if (error.code() != ErrorCode::topology_mismatch) throw;
        const std::span<Vec3> positions = result.edit_positions();
        for (std::size_t row = 0; row < rest.positions.size(); ++row) {
            positions[at(rest.region().vertices()[row])] = rest.positions[row];
        }
    }
    return result;
}

std::shared_ptr<DeformFrame> shown_of(DeformRecord& record) {
    auto shown = std::make_shared<DeformFrame>();
    shown->positions = std::move(record.shown);
    shown->gradients = std::move(record.gradients);
    shown->turns_without_faces = std::move(record.turns_without_faces);
    return shown;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

// ---- Hairstyles

// Visits the tilts of the dividing curves.
template <typename Curves, typename Visit>
void for_each_tilt(Curves& curves, const Visit& visit) {
    for (auto& curve : curves) {
        if (auto* dividing = std::get_if<DividingCurve>(&curve.shape)) {
            visit(dividing->options.left);
            visit(dividing->options.right);
        }
    }
}

ScalpRecord record_of(const Scalp& scalp) {
    const ScalpOptions& options = scalp.options();
    ScalpRecord record{options.hints.up, options.hints.front, options.unit, {}, {},
                       options.softness};
    if (!scalp.guessed()) record.region = scalp.region().vertices();
    for (const HairlinePoint& point : options.hairline) {
        record.hairline.insert(record.hairline.end(), {point.azimuth, point.elevation});
    }
    return record;
}

std::shared_ptr<const Scalp> scalp_of(const ScalpRecord& record, const Mesh& head,
                                      const Context& context) {
    ScalpOptions options;
    options.hints = {record.up, record.front};
    options.unit = record.unit;
    options.softness = record.softness;
    if (record.region) options.region = Region(head.shared_topology(), *record.region);
    require_valid(record.hairline.size() % 2 == 0, "a hairline of the scene lacks a number");
    options.hairline.clear();
    for (std::size_t i = 0; i < record.hairline.size(); i += 2) {
        options.hairline.push_back({record.hairline[i], record.hairline[i + 1]});
    }
    return std::make_shared<const Scalp>(head, options, context);
}

// Puts the tilts back to the bit.
StyleContent style_content_of(const HairstyleRecord& record) {
    StyleContent content = decode_style(record.style);
    std::size_t next = 0;
    for_each_tilt(content.curves, [&](DividingOptions::Tilt& tilt) {
        require_valid(next + 2 <= record.tilts.size(), "a hairstyle of the scene lacks a tilt");
        tilt = {record.tilts[next], record.tilts[next + 1]};
        next += 2;
    });
    return content;
}

StyleInputs inputs_of(const HairstyleRecord& record, StyleContent content) {
    std::vector<StyleCurve>& curves = content.curves;
    const std::size_t steps = record.step_points.size();
    require_valid(record.ids.size() == curves.size() && record.edits.size() == curves.size() &&
                      record.step_values.size() == steps && record.step_weights.size() == steps &&
                      record.step_tags.size() == steps,
                  "the curves of a hairstyle of the scene do not fit their numbers");
    StyleInputs inputs;
    inputs.masks = std::move(content.masks);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        inputs.curves.push_back({{record.ids[i]}, std::move(curves[i]), record.edits[i]});
    }
    for (std::size_t i = 0; i < steps; ++i) {
        inputs.scalp_step.push_back({record.step_points[i], record.step_values[i],
                                     record.step_weights[i], record.step_tags[i]});
    }
    inputs.scalp_edit = record.scalp_edit;
    return inputs;
}

}  // namespace

MeshRecord record_of(const Mesh& mesh) {
    MeshRecord record;
    record.positions.assign(mesh.positions().begin(), mesh.positions().end());
    record.offsets = mesh.topology().faces().offsets;
    record.corners = mesh.topology().faces().vertices;
    record.attributes = mesh.attributes().all();
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        record.labels.push_back({kind, labels});
    }
    for (const auto& [name, region] : mesh.regions()) {
        record.regions.push_back({name, region.vertices()});
    }
    record.material_libraries = mesh.material_libraries();
    record.findings = mesh.report().findings();
    return record;
}

Mesh mesh_of(MeshRecord record, const Context& context,
             const std::shared_ptr<const Topology>& known) {
    FaceList faces = faces_of(record);
    const bool same = known && known->vertex_count() == count_of(record.positions) &&
                      known->faces().offsets == faces.offsets &&
                      known->faces().vertices == faces.vertices;
    Mesh mesh = same ? Mesh(std::move(record.positions), known)
                     : Mesh(std::move(record.positions), std::move(faces), context);
    add_all(mesh, std::move(record.attributes));
    for (LabelRecord& labels : record.labels) {
        require_labels(labels);
        mesh.attributes().labels()[labels.kind] = std::move(labels.labels);
    }
    mesh.attributes().recount();
    require_complete_attributes(mesh);
    for (RegionRecord& region : record.regions) {
        mesh.set_region(region.name, Region(mesh.shared_topology(), std::move(region.vertices)));
    }
    mesh.material_libraries() = std::move(record.material_libraries);
    Report report;
    for (Finding& finding : record.findings) report.add(std::move(finding));
    mesh.set_report(std::move(report));
    return mesh;
}

StrandsRecord record_of(const Strands& strands) {
    return {frame_of(strands), {strands.points().begin(), strands.points().end()}};
}

Strands strands_of(StrandsRecord record, const Context& context) {
    Strands strands(std::move(record.points), std::move(record.offsets), context.memory());
    set_frame(strands, std::move(record));
    return strands;
}

DeformRecord record_of(const DeformSnapshot& snapshot, const Mesh& mesh) {
    const RestShape& rest = *snapshot.rest;
    const DeformFrame& shown = *snapshot.shown;
    DeformRecord record;
    record.region = rest.region().vertices();
    record.options = rest.options();
    record.description = describe(snapshot);
    record.rest = rest.positions;
    record.shown = shown.positions;
    record.gradients = shown.gradients.value();
    record.turns_without_faces = shown.turns_without_faces;
    const Mesh at_rest = rest_mesh(rest, mesh);
    std::copy_if(at_rest.attributes().all().begin(), at_rest.attributes().all().end(),
                 std::back_inserter(record.directions), is_direction);
    return record;
}

Deformer deformer_of(DeformRecord record, const Mesh& mesh, const Context& context) {
    Mesh at_rest = mesh;
    const Region region(mesh.shared_topology(), std::move(record.region));
    const std::size_t count = at(region.size());
    require_valid(record.rest.size() == count && record.shown.size() == count &&
                      record.gradients.size() == count,
                  "the shapes of a deformation of the scene do not fit its region");
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (std::size_t row = 0; row < count; ++row) {
        positions[at(region.vertices()[row])] = record.rest[row];
    }
    at_rest.set_positions(std::move(positions));
    add_all(at_rest, std::move(record.directions));
    require_complete_attributes(at_rest);
    Deformer deformer(at_rest, region, record.options, context);
    DeformSnapshot snapshot = snapshot_of(record.description, rest_of(deformer));
    snapshot.shown = shown_of(record);
    deformer.restore(snapshot);
    return deformer;
}

DeformSnapshot snapshot_of(DeformRecord record, const Deformer& deformer) {
    std::shared_ptr<const RestShape> rest = rest_of(deformer);
    require_valid(record.region == region_of(*rest).vertices() &&
                      record.rest.size() == record.region.size() &&
                      record.shown.size() == record.region.size() &&
                      record.gradients.size() == record.region.size(),
                  "the shapes of a deformation of the scene do not fit its region");
    if (!same_bits(record.rest, positions_of(*rest))) {
        DeformFrame frame = rest_frame(*rest);
        frame.positions = std::move(record.rest);
        rest = rebased(*rest, frame);
    }
    DeformSnapshot snapshot = snapshot_of(record.description, std::move(rest));
    snapshot.shown = shown_of(record);
    return snapshot;
}

HairstyleRecord record_of(const Hairstyle& style, const StyleInputs& inputs) {
    HairstyleRecord record;
    const StyleContent content = content_of(inputs, style.options());
    for (const PlacedCurve& placed : inputs.curves) {
        record.ids.push_back(placed.id.value);
        record.edits.push_back(placed.edit);
    }
    record.style = encode_style(content);
    for_each_tilt(content.curves, [&](const DividingOptions::Tilt& tilt) {
        record.tilts.insert(record.tilts.end(), {tilt.start, tilt.end});
    });
    record.scalp_edit = inputs.scalp_edit;
    for (const GridConstraint& constraint : inputs.scalp_step) {
        record.step_points.push_back(constraint.point);
        record.step_values.push_back(constraint.value);
        record.step_weights.push_back(constraint.weight);
        record.step_tags.push_back(constraint.tag);
    }
    record.scalp = record_of(style.scalp());
    return record;
}

StyleInputs inputs_of(const HairstyleRecord& record) {
    return inputs_of(record, style_content_of(record));
}

Hairstyle hairstyle_of(const HairstyleRecord& record, const Mesh& head, const Context& context) {
    StyleContent content = style_content_of(record);
    Hairstyle style(head, scalp_of(record.scalp, head, context), content.options, context);
    style.restore(inputs_of(record, std::move(content)));
    return style;
}

}  // namespace lissom
