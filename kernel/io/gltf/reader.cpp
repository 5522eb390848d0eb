#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "kernel/io/gltf/asset.h"
#include "kernel/io/gltf/file/accessor.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/io/gltf/file/extensions.h"
#include "kernel/io/gltf/file/extras.h"
#include "kernel/io/gltf/gltf.h"
#include "kernel/io/gltf/mesh/attributes.h"
#include "kernel/io/gltf/mesh/blocks.h"
#include "kernel/io/gltf/mesh/primitives.h"
#include "kernel/io/gltf/mesh/transform.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/mesh/edit/label_adder.h"

namespace lissom {
namespace {

using Primitive = tinygltf::Primitive;

class SurfaceReader {
  public:
    SurfaceReader(GltfDocument& document, const AccessorReader& accessors, GltfBudget& budget,
                  const Context& context)
        : document_(document),
          accessors_(accessors),
          budget_(budget),
          context_(context),
          vertices_(accessors, budget, skipped_) {}

    MeshData read(const std::vector<GltfInstance>& instances,
                  const std::vector<std::string>& materials) {
        material_labels_.names = materials;
        only_points_ = !has_faces(instances);
        Progress progress(context_, "read glTF");
        for (std::size_t i = 0; i < instances.size(); ++i) {
            progress.update(i, instances.size());
            read_instance(instances[i]);
        }
        finish();
        return std::move(mesh_);
    }

  private:
    const tinygltf::Mesh& mesh_of(const GltfInstance& instance) const {
        return document_.model.meshes[instance.mesh];
    }

    bool has_faces(const std::vector<GltfInstance>& instances) const {
        return std::any_of(instances.begin(), instances.end(), [&](const GltfInstance& instance) {
            const auto& primitives = mesh_of(instance).primitives;
            return std::any_of(primitives.begin(), primitives.end(), [](const Primitive& p) {
                return shape_of_mode(p.mode) == PrimitiveShape::faces;
            });
        });
    }

    // Primitives to read; the others are counted.
    std::vector<const Primitive*> primitives_of(const GltfInstance& instance) {
        const PrimitiveShape wanted = only_points_ ? PrimitiveShape::points : PrimitiveShape::faces;
        std::vector<const Primitive*> result;
        for (const Primitive& primitive : mesh_of(instance).primitives) {
            const PrimitiveShape shape = shape_of_mode(primitive.mode);
            const char* what = shape == PrimitiveShape::points  ? "primitives of points"
                               : shape == PrimitiveShape::lines ? "primitives of lines"
                                                                : "primitives without positions";
            if (shape == wanted && primitive.attributes.contains("POSITION")) {
                result.push_back(&primitive);
            } else {
                skipped_.add(what);
            }
        }
        return result;
    }

    void read_instance(const GltfInstance& instance) {
        const NodeTransform transform(instance.transform);
        const std::vector<const Primitive*> primitives = primitives_of(instance);
        const std::size_t first_vertex = vertices_.positions().size();
        const Index first_face = mesh_.faces.size();
        std::map<const Primitive*, FaceList> faces;
        for (VertexBlock& block : blocks_of(primitives)) {
            context_.checkpoint();
            read_block(block, transform, faces);
        }
        if (!only_points_) {
            for (const Primitive* primitive : primitives) add_faces(*primitive, faces[primitive]);
            label_faces(instance.label, first_face);
            if (mesh_.faces.size() > first_face) ++surface_instances_;
        }
        read_extras(instance, first_vertex, first_face);
    }

    std::vector<Index> corners_of(const Primitive& primitive, std::size_t vertex_count) const {
        if (primitive.indices >= 0) return accessors_.indices(primitive.indices, vertex_count);
        budget_.charge(vertex_count);
        std::vector<Index> all(vertex_count);
        for (std::size_t i = 0; i < vertex_count; ++i) all[i] = index_of(i);
        return all;
    }

    // The vertices of a block, and the faces of its primitives.
    void read_block(VertexBlock& block, const NodeTransform& transform,
                    std::map<const Primitive*, FaceList>& faces) {
        const std::size_t first = vertices_.positions().size();
        vertices_.add_positions(block, transform);
        for (const Primitive* primitive : block.primitives) {
            std::vector<Index> corners = corners_of(*primitive, block.vertex_count);
            // They tell which primitive uses which vertex; a single one uses all that matter.
            if (block.primitives.size() > 1) block.corners.push_back(corners);
            if (only_points_) continue;
            faces[primitive] =
                joined_faces(*primitive, std::move(corners), first, transform.mirrors());
        }
        vertices_.add_attributes(block, transform);
    }

    FaceList joined_faces(const Primitive& primitive, std::vector<Index> corners, std::size_t first,
                          bool mirrored) {
        const PrimitiveJoin join{primitive.mode, primitive.extensions.contains("FB_ngon_encoding")};
        std::size_t left_over = 0;
        FaceList faces = join_primitive(std::move(corners), join, left_over);
        skipped_.add("indices that make no triangle", left_over);
        budget_.charge(faces.vertices.size());
        if (first > 0) {
            for (Index& v : faces.vertices) v += index_of(first);
        }
        for (Index f = 0; mirrored && f < faces.size(); ++f) {
            std::reverse(faces.vertices.data() + faces.offsets[f] + 1,
                         faces.vertices.data() + faces.offsets[f + 1]);
        }
        return faces;
    }

    void add_faces(const Primitive& primitive, FaceList& faces) {
        constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
        if (mesh_.faces.size() == 0 && faces.vertices.size() <= kMaximum) {
            mesh_.faces = std::move(faces);
        } else {
            for (Index f = 0; f < faces.size(); ++f) add_face(mesh_.faces, faces[f]);
        }
        const bool has_material =
            primitive.material >= 0 && at(primitive.material) < material_labels_.names.size();
        material_labels_.of_face.resize(mesh_.faces.size(),
                                        has_material ? primitive.material : kNoIndex);
    }

    void label_faces(const std::string& label, Index first_face) {
        if (mesh_.faces.size() == first_face) return;
        object_labels_.names.push_back(label);
        object_labels_.of_face.resize(mesh_.faces.size(), count_of(object_labels_.names) - 1);
    }

    void read_extras(const GltfInstance& instance, std::size_t first_vertex, Index first_face) {
        const Json& json = document_.json["meshes"][instance.mesh];
        if (!json.contains("extras")) return;
        Json mesh = json_object({{"extras", json["extras"]}});
        bool fits = true;
        const MeshExtras extras = take_extras(mesh, vertices_.positions().size() - first_vertex,
                                              mesh_.faces.size() - first_face, fits);
        fits = fits && join_parts(extras.parts, first_face);
        if (!fits) {
            skipped_.add("regions and groups that no longer fit the surface");
            return;
        }
        know_copies(extras.copies, first_vertex);
        for (const auto& [kind, labels] : extras.labels) {
            if (kind == "object") {
                relabel_objects(labels, first_face);
            } else {
                add_labels(kind, labels, first_face);
            }
        }
        turn_faces(extras.turns, first_face);
        corner_attributes_.insert(extras.corners.begin(), extras.corners.end());
        for (const auto& [name, vertices] : extras.regions) {
            std::vector<Index>& region = mesh_.regions[name];
            for (const Index v : vertices) region.push_back(v + index_of(first_vertex));
        }
    }

    // Puts together the faces that were parts of polygons. Returns false, without a change, if some
    // do not make one.
    bool join_parts(const std::vector<Index>& parts, Index first_face) {
        if (parts.empty()) return true;
        material_labels_.of_face.resize(mesh_.faces.size(), kNoIndex);
        FaceList joined;
        std::vector<Index> materials, outline;
        Index f = first_face;
        for (const Index count : parts) {
            if (!outline_of(mesh_.faces, f, count, outline)) return false;
            joined.add(outline);
            materials.push_back(material_labels_.of_face[f]);
            f += count;
        }
        mesh_.faces.offsets.resize(at(first_face) + 1);
        mesh_.faces.vertices.resize(mesh_.faces.offsets.back());
        for (Index g = 0; g < joined.size(); ++g) mesh_.faces.add(joined[g]);
        material_labels_.of_face.resize(first_face);
        material_labels_.of_face.insert(material_labels_.of_face.end(), materials.begin(),
                                        materials.end());
        object_labels_.of_face.resize(mesh_.faces.size());
        return true;
    }

    // Vertices in a row at one place are one, if the file says so.
    void know_copies(const std::vector<Index>& copies, std::size_t first_vertex) {
        if (copies.empty()) return;
        const std::vector<Vec3>& positions = vertices_.positions();
        std::size_t v = first_vertex;
        std::vector<Index> same_as;
        for (const Index count : copies) {
            for (Index k = 0; k < count; ++k) {
                if (positions[v + k] != positions[v]) return;
                same_as.push_back(index_of(v));
            }
            v += count;
        }
        fill_same_as(first_vertex);
        mesh_.same_as.insert(mesh_.same_as.end(), same_as.begin(), same_as.end());
        ++known_instances_;
    }

    // Up to `vertex_count`, vertices are only the same as themselves.
    void fill_same_as(std::size_t vertex_count) {
        while (mesh_.same_as.size() < vertex_count)
            mesh_.same_as.push_back(count_of(mesh_.same_as));
    }

    // Gives faces of a mesh that was several objects the labels that they had.
    void relabel_objects(const FaceLabels& labels, Index first_face) {
        std::vector<Index> renumbered;
        for (const std::string& name : labels.names) {
            renumbered.push_back(object_adder_.add(name));
        }
        for (std::size_t i = 0; i < labels.of_face.size(); ++i) {
            const Index label = labels.of_face[i];
            object_labels_.of_face[first_face + i] =
                label == kNoIndex ? kNoIndex : renumbered[label];
        }
    }

    // Makes the corner at place `turns[i]` of face `first_face` + i its first.
    void turn_faces(const std::vector<Index>& turns, Index first_face) {
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const auto f = first_face + i;
            const auto begin = mesh_.faces.vertices.begin() + mesh_.faces.offsets[f];
            const auto end = mesh_.faces.vertices.begin() + mesh_.faces.offsets[f + 1];
            if (turns[i] < end - begin) std::rotate(begin, begin + turns[i], end);
        }
    }

    // Gives the values of vertices to corners.
    void move_to_corners(Attribute& attribute) const {
        std::vector<double> values;
        values.reserve(mesh_.faces.vertices.size() * attribute.width);
        for (const Index v : mesh_.faces.vertices) {
            const std::span<const double> value = std::as_const(attribute).at(v);
            values.insert(values.end(), value.begin(), value.end());
        }
        attribute.values = std::move(values);
        attribute.domain = Domain::corner;
    }

    void add_labels(const std::string& kind, const FaceLabels& labels, Index first_face) {
        FaceLabels& all = mesh_.attributes.labels()[kind];
        all.of_face.resize(first_face, kNoIndex);
        std::vector<Index> renumbered;
        LabelAdder& adder = adders_.try_emplace(kind, all).first->second;
        for (const std::string& name : labels.names) renumbered.push_back(adder.add(name));
        for (const Index label : labels.of_face) {
            all.of_face.push_back(label == kNoIndex ? kNoIndex : renumbered[label]);
        }
    }

    void finish() {
        vertices_.finish(mesh_.attributes, mesh_.report);
        mesh_.positions = std::move(vertices_.positions());
        mesh_.seams_are_known = known_instances_ > 0 && known_instances_ == surface_instances_;
        if (known_instances_ > 0) fill_same_as(mesh_.positions.size());
        for (Attribute& attribute : mesh_.attributes.all()) {
            if (corner_attributes_.contains(attribute.name)) move_to_corners(attribute);
        }
        auto& labels = mesh_.attributes.labels();
        if (!object_labels_.names.empty()) labels["object"] = std::move(object_labels_);
        const auto& of_face = material_labels_.of_face;
        const bool has_materials =
            std::any_of(of_face.begin(), of_face.end(), [](Index m) { return m != kNoIndex; });
        if (has_materials) labels["material"] = std::move(material_labels_);
        for (auto& [kind, list] : labels) {
            list.of_face.resize(mesh_.faces.size(), kNoIndex);
        }
        skipped_.finish(mesh_.report);
    }

    GltfDocument& document_;
    const AccessorReader& accessors_;
    GltfBudget& budget_;
    const Context& context_;
    MeshData mesh_;
    FaceLabels object_labels_, material_labels_;
    LabelAdder object_adder_{object_labels_};
    // By kind, of the other labels.
    std::map<std::string, LabelAdder> adders_;
    SkippedContent skipped_;
    VertexReader vertices_;
    std::set<std::string> corner_attributes_;
    bool only_points_ = false;
    // Instances with faces, and those of which the file says which vertices are one.
    std::size_t surface_instances_ = 0, known_instances_ = 0;
};

MeshData read_document(const FileInput& file, const Context& context) {
    Report report;
    GltfDocument document = open_gltf(file, report, context);
    GltfBudget budget(document.bytes_read);
    const AccessorReader accessors(document, budget);
    expand_instancing(document.json, accessors, budget, report);
    const std::vector<GltfInstance> instances = find_instances(document.json, report);
    const std::vector<std::string> materials = material_names(document.json);
    MeshData mesh = SurfaceReader(document, accessors, budget, context).read(instances, materials);
    mesh.asset = keep_asset(document, accessors, instances, materials, report);
    for (const Finding& finding : mesh.report.findings()) report.add(finding);
    mesh.report = std::move(report);
    return mesh;
}

}  // namespace

MeshData read_gltf(const FileInput& file, const Context& context) {
    try {
        return read_document(file, context);
    } catch (const Json::exception& error) {
        refuse(ErrorCode::file_syntax,
               "something in the JSON is of another type than glTF wants: " +
                   std::string(error.what()));
    }
}

}  // namespace lissom
