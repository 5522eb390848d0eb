/// Contents of a scene file for each kind of item, as plain values; private to kernel/scene.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/description.h"
#include "kernel/deform/options.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/hair/style_inputs.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/topology.h"
#include "kernel/scene/strand_frame.h"

namespace lissom {

struct LabelRecord {
    std::string kind;
    FaceLabels labels;
};

struct RegionRecord {
    std::string name;
    std::vector<Index> vertices;
};

/// A mesh; its contents of files (its Asset) are not held.
struct MeshRecord {
    std::vector<Vec3> positions;
    std::vector<Index> offsets, corners;
    std::vector<Attribute> attributes;
    std::vector<LabelRecord> labels;
    std::vector<RegionRecord> regions;
    std::vector<std::string> material_libraries;
    std::vector<Finding> findings;
};

struct StrandsRecord : StrandFrame {
    std::vector<float> points;
};

/// A deformation of the mesh that is item `mesh` of the file.
struct DeformRecord {
    Index mesh = 0;
    std::vector<Index> region;
    DeformOptions options;
    DeformDescription description;
    /// Positions of the region's vertices: at rest, and as shown.
    std::vector<Vec3> rest, shown;
    std::vector<Mat3> gradients, turns_without_faces;
    /// Normals and tangents of the mesh at rest.
    std::vector<Attribute> directions;
};

/// Parameters of a scalp, so that it is made again.
struct ScalpRecord {
    std::optional<Vec3> up, front;
    std::optional<double> unit;
    std::optional<std::vector<Index>> region;
    std::vector<double> hairline;
    double softness = 0.0;
};

/// A hairstyle on the head that is item `head` of the file.
struct HairstyleRecord {
    Index head = 0;
    /// Text of a style file (kernel/io/style_file.h).
    std::string style;
    /// Start and end of the left and the right tilt of each dividing curve, in radians: style files
    /// have degrees.
    std::vector<double> tilts;
    std::vector<std::int64_t> ids, edits;
    std::int64_t scalp_edit = 0;
    std::vector<Index> step_points, step_tags;
    std::vector<Vec3> step_values;
    std::vector<double> step_weights;
    ScalpRecord scalp;
};

MeshRecord record_of(const Mesh& mesh);
/// Errors of these: file_syntax; those of the objects' constructors and setters. The mesh has the
/// very topology `known`, which may be null, if its faces are the same.
Mesh mesh_of(MeshRecord record, const Context& context,
             const std::shared_ptr<const Topology>& known = nullptr);

StrandsRecord record_of(const Strands& strands);
Strands strands_of(StrandsRecord record, const Context& context);

/// `mesh` is the one that is deformed, in its present shape.
DeformRecord record_of(const DeformSnapshot& snapshot, const Mesh& mesh);
Deformer deformer_of(DeformRecord record, const Mesh& mesh, const Context& context);
/// Returns a snapshot for `deformer`, which has the same region.
DeformSnapshot snapshot_of(DeformRecord record, const Deformer& deformer);

HairstyleRecord record_of(const Hairstyle& style, const StyleInputs& inputs);
Hairstyle hairstyle_of(const HairstyleRecord& record, const Mesh& head, const Context& context);
StyleInputs inputs_of(const HairstyleRecord& record);

}  // namespace lissom
