#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "kernel/io/gltf.h"
#include "kernel/io/gltf_accessor.h"
#include "kernel/io/gltf_asset.h"
#include "kernel/io/gltf_columns.h"
#include "kernel/io/gltf_document.h"
#include "kernel/io/gltf_extensions.h"
#include "kernel/io/gltf_extras.h"
#include "kernel/io/gltf_names.h"
#include "kernel/io/gltf_nodes.h"
#include "kernel/io/gltf_primitives.h"
#include "kernel/io/gltf_transform.h"
#include "kernel/io/read_error.h"

namespace lissom {
namespace {

using Primitive = tinygltf::Primitive;
using Accessors = std::map<std::string, int>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What was left out, by what it was.
class Skipped {
  public:
    void add(FindingKind kind, const std::string& what, std::size_t count = 1) {
        if (count > 0) counts_[kind][what] += count;
    }
    void report(Report& report) const {
        for (const auto& [kind, things] : counts_) {
            std::size_t total = 0;
            std::string text;
            for (const auto& [what, count] : things) {
                total += count;
                text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
            }
            report.add(kind, total, text);
        }
    }

  private:
    std::map<FindingKind, std::map<std::string, std::size_t>> counts_;
};

// Primitives of one mesh that have their vertices in common.
struct Block {
    Accessors attributes;
    std::vector<Accessors> targets;
    std::vector<const Primitive*> primitives;
    std::size_t vertex_count = 0;
};

bool share_vertices(const Block& block, const Primitive& primitive) {
    if (block.targets != primitive.targets) return false;
    for (const auto& [name, accessor] : primitive.attributes) {
        const auto same = block.attributes.find(name);
        if (same == block.attributes.end() ? name == "POSITION" : same->second != accessor) {
            return false;
        }
    }
    return primitive.attributes.contains("POSITION");
}

std::vector<Block> blocks_of(const std::vector<const Primitive*>& primitives) {
    // Only the latest are tried, so that many primitives do not take quadratic time.
    constexpr int kTried = 16;
    std::vector<Block> blocks;
    // By accessor of positions.
    std::map<int, std::vector<std::size_t>> candidates;
    for (const Primitive* primitive : primitives) {
        const int position = primitive->attributes.at("POSITION");
        std::vector<std::size_t>& list = candidates[position];
        const auto begin = list.size() > kTried ? list.end() - kTried : list.begin();
        const auto found = std::find_if(begin, list.end(), [&](std::size_t b) {
            return share_vertices(blocks[b], *primitive);
        });
        if (found == list.end()) {
            list.push_back(blocks.size());
            blocks.push_back({primitive->attributes, primitive->targets, {primitive}, 0});
        } else {
            Block& block = blocks[*found];
            block.attributes.insert(primitive->attributes.begin(), primitive->attributes.end());
            block.primitives.push_back(primitive);
        }
    }
    return blocks;
}

Index expected_width(GltfSemantic semantic) {
    switch (semantic) {
        case GltfSemantic::uv:
            return 2;
        case GltfSemantic::position:
        case GltfSemantic::normal:
            return 3;
        case GltfSemantic::tangent:
        case GltfSemantic::joints:
        case GltfSemantic::weights:
            return 4;
        default:
            return 0;
    }
}

// The type that values have in a mesh, where fractions are numbers of their own.
ScalarType type_in_mesh(GltfSemantic semantic, const AccessorValues& read) {
    const bool keeps_integers = semantic == GltfSemantic::joints ||
                                (semantic == GltfSemantic::color && read.normalized) ||
                                (semantic == GltfSemantic::custom && !read.normalized);
    return keeps_integers ? read.type : ScalarType::float32;
}

class SurfaceReader {
  public:
    SurfaceReader(GltfDocument& document, const AccessorReader& accessors, GltfBudget& budget,
                  const Context& context)
        : document_(document), accessors_(accessors), budget_(budget), context_(context) {}

    MeshData read(const std::vector<GltfInstance>& instances,
                  const std::vector<std::string>& materials) {
        material_labels_.names = materials;
        only_points_ = !has_faces(instances);
        Progress progress(context_, "read glTF");
        for (std::size_t i = 0; i < instances.size(); ++i) {
            progress.update(double(i) / double(instances.size()));
            read_instance(instances[i]);
        }
        finish();
        return std::move(mesh_);
    }

  private:
    const tinygltf::Mesh& mesh_of(const GltfInstance& instance) const {
        return document_.model.meshes[static_cast<std::size_t>(instance.mesh)];
    }

    bool has_faces(const std::vector<GltfInstance>& instances) const {
        return std::any_of(instances.begin(), instances.end(), [&](const GltfInstance& instance) {
            const auto& primitives = mesh_of(instance).primitives;
            return std::any_of(primitives.begin(), primitives.end(), [](const Primitive& p) {
                return shape_of_mode(p.mode) == PrimitiveShape::faces;
            });
        });
    }

    // Those that are read; the others are counted.
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
                skipped_.add(FindingKind::content_skipped, what);
            }
        }
        return result;
    }

    void read_instance(const GltfInstance& instance) {
        const NodeTransform transform(instance.transform);
        const std::vector<const Primitive*> primitives = primitives_of(instance);
        std::vector<Block> blocks = blocks_of(primitives);
        const std::size_t first_vertex = mesh_.positions.size();
        const Index first_face = mesh_.faces.size();
        std::map<const Primitive*, std::pair<std::size_t, std::vector<Index>>> corners;
        for (Block& block : blocks) {
            context_.checkpoint();
            const std::size_t first = mesh_.positions.size();
            read_positions(block, transform);
            for (const Primitive* primitive : block.primitives) {
                corners[primitive] = {first, corners_of(*primitive, block.vertex_count)};
            }
            read_attributes(block, transform, first, corners);
        }
        if (!only_points_) {
            for (const Primitive* primitive : primitives) {
                const auto& [first, indices] = corners[primitive];
                add_faces(*primitive, indices, first, transform.mirrors());
            }
            label_faces(instance.label, first_face);
        }
        read_extras(instance, first_vertex, first_face);
    }

    void read_positions(Block& block, const NodeTransform& transform) {
        const AccessorValues read = read_values("POSITION", block.attributes.at("POSITION"), 3);
        block.vertex_count = read.count;
        constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
        if (read.count > kMaximum - mesh_.positions.size()) {
            refuse(ErrorCode::file_too_large,
                   "the file has more than " + std::to_string(kMaximum) + " vertices; split it");
        }
        mesh_.positions.reserve(mesh_.positions.size() + read.count);
        for (std::size_t i = 0; i < read.count; ++i) {
            const double* p = read.values.data() + 3 * i;
            mesh_.positions.push_back(transform.position(Vec3(p[0], p[1], p[2])));
        }
    }

    // `width` 0 for any.
    AccessorValues read_values(const std::string& name, int accessor, Index width) const {
        AccessorValues read = accessors_.values(accessor);
        if (width == 0 || read.width == width) return read;
        refuse(ErrorCode::file_syntax, "accessor " + std::to_string(accessor) + " of " + name +
                                           " has " + std::to_string(read.width) +
                                           " numbers an element instead of " +
                                           std::to_string(width));
    }

    std::vector<Index> corners_of(const Primitive& primitive, std::size_t vertex_count) const {
        if (primitive.indices >= 0) return accessors_.indices(primitive.indices, vertex_count);
        budget_.charge(vertex_count);
        std::vector<Index> all(vertex_count);
        for (std::size_t i = 0; i < vertex_count; ++i) all[i] = static_cast<Index>(i);
        return all;
    }

    template <typename Corners>
    void read_attributes(const Block& block, const NodeTransform& transform, std::size_t first,
                         const Corners& corners) {
        std::map<std::string, AccessorValues> joints;
        for (const auto& [name, accessor] : block.attributes) {
            const GltfAttributeName parsed = parse_gltf_attribute(name);
            if (parsed.semantic == GltfSemantic::position) continue;
            if (parsed.semantic == GltfSemantic::unknown) {
                skipped_.add(FindingKind::content_skipped, "attributes " + in_quotes(name));
                continue;
            }
            AccessorValues read = read_values(name, accessor, expected_width(parsed.semantic));
            require_count(block, accessor, read);
            clean(parsed, read, transform);
            erase_unused(block, name, read, corners);
            if (parsed.semantic == GltfSemantic::joints ||
                parsed.semantic == GltfSemantic::weights) {
                add_joint_set(parsed, read, joints[parsed.name]);
            } else {
                add_column(parsed.name, type_in_mesh(parsed.semantic, read), first, read);
            }
        }
        add_joints(joints, first);
        for (std::size_t t = 0; t < block.targets.size(); ++t) {
            read_target(block, static_cast<Index>(t) + 1, transform, first);
        }
    }

    static void require_count(const Block& block, int accessor, const AccessorValues& read) {
        if (read.count == block.vertex_count) return;
        refuse(ErrorCode::file_syntax, "accessor " + std::to_string(accessor) + " has " +
                                           std::to_string(read.count) + " elements for " +
                                           std::to_string(block.vertex_count) + " positions");
    }

    // Makes the values those of a mesh.
    void clean(const GltfAttributeName& name, AccessorValues& read,
               const NodeTransform& transform) {
        drop_not_finite(name.name, read);
        const bool is_color = name.semantic == GltfSemantic::color;
        if (is_color && read.width != 3 && read.width != 4) {
            refuse(ErrorCode::file_syntax,
                   "a color has " + std::to_string(read.width) + " numbers instead of 3 or 4");
        }
        const auto width = static_cast<std::size_t>(read.width);
        for (std::size_t i = 0; i < read.count; ++i) {
            const std::span<double> value(read.values.data() + i * width, width);
            if (name.semantic == GltfSemantic::uv) value[1] = 1.0 - value[1];
            if (name.semantic == GltfSemantic::normal) transform.turn_normal(value);
            if (name.semantic == GltfSemantic::tangent) transform.turn_tangent(value);
        }
    }

    // An element with a value that is none has none.
    void drop_not_finite(const std::string& name, AccessorValues& read) {
        if (read.type != ScalarType::float32 && read.type != ScalarType::float64) return;
        const auto width = static_cast<std::size_t>(read.width);
        std::size_t count = 0;
        for (std::size_t i = 0; i < read.count; ++i) {
            const std::span<double> value(read.values.data() + i * width, width);
            const bool good =
                std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
            if (good) continue;
            ++count;
            std::fill(value.begin(), value.end(), kNone);
        }
        skipped_.add(FindingKind::values_not_finite, "of " + in_quotes(name), count);
    }

    // Vertices that only primitives without the attribute use have no value of it.
    template <typename Corners>
    static void erase_unused(const Block& block, const std::string& name, AccessorValues& read,
                             const Corners& corners) {
        const auto has = [&](const Primitive* p) { return p->attributes.contains(name); };
        if (std::all_of(block.primitives.begin(), block.primitives.end(), has)) return;
        std::vector<char> used(block.vertex_count, 0);
        for (const Primitive* primitive : block.primitives) {
            if (!has(primitive)) continue;
            for (const Index v : corners.at(primitive).second) used[v] = 1;
        }
        const auto width = static_cast<std::size_t>(read.width);
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (!used[v])
                std::fill_n(read.values.begin() + static_cast<std::ptrdiff_t>(v * width), width,
                            kNone);
        }
    }

    void add_column(const std::string& name, ScalarType type, std::size_t first,
                    const AccessorValues& read) {
        constexpr std::size_t kNumbersPerElement = 16;
        columns_.add(name, read.width, type, first, read.values);
        budget_.require(columns_.number_count(mesh_.positions.size()) / kNumbersPerElement);
    }

    // Puts four joints or weights beside those of the sets before.
    static void add_joint_set(const GltfAttributeName& name, const AccessorValues& read,
                              AccessorValues& all) {
        const Index width = std::max<Index>(all.width, 4 * (name.set + 1));
        const bool is_first = all.values.empty();
        if (is_first) all.values.assign(read.count * static_cast<std::size_t>(width), 0.0);
        if (!is_first && width > all.width) all.values = widened(all.values, all.width, width, 0.0);
        all.count = read.count;
        all.width = width;
        all.type = type_in_mesh(name.semantic, read);
        for (std::size_t v = 0; v < read.count; ++v) {
            std::copy_n(read.values.begin() + static_cast<std::ptrdiff_t>(4 * v), 4,
                        all.values.begin() +
                            static_cast<std::ptrdiff_t>(v * static_cast<std::size_t>(width)) +
                            4 * name.set);
        }
    }

    void add_joints(std::map<std::string, AccessorValues>& sets, std::size_t first) {
        Index width = 0;
        for (const auto& [name, read] : sets) width = std::max(width, read.width);
        for (auto& [name, read] : sets) {
            if (read.width < width) read.values = widened(read.values, read.width, width, 0.0);
            read.width = width;
            add_column(name, read.type, first, read);
        }
    }

    void read_target(const Block& block, Index target, const NodeTransform& transform,
                     std::size_t first) {
        for (const auto& [name, accessor] : block.targets[static_cast<std::size_t>(target - 1)]) {
            const GltfSemantic semantic = parse_gltf_attribute(name).semantic;
            const bool is_known = semantic == GltfSemantic::position ||
                                  semantic == GltfSemantic::normal ||
                                  semantic == GltfSemantic::tangent;
            if (!is_known) {
                skipped_.add(FindingKind::content_skipped,
                             "attributes " + in_quotes(name) + " of morph targets");
                continue;
            }
            AccessorValues read = read_values(name, accessor, 3);
            require_count(block, accessor, read);
            drop_not_finite(morph_name(target, semantic), read);
            for (std::size_t v = 0; v < read.count; ++v) {
                transform.turn_delta(semantic, {read.values.data() + 3 * v, 3});
            }
            add_column(morph_name(target, semantic), ScalarType::float32, first, read);
        }
    }

    void add_faces(const Primitive& primitive, const std::vector<Index>& corners, std::size_t first,
                   bool mirrored) {
        const PrimitiveJoin join{primitive.mode, primitive.extensions.contains("FB_ngon_encoding")};
        std::size_t left_over = 0;
        FaceList faces = join_primitive(corners, join, left_over);
        skipped_.add(FindingKind::content_skipped, "indices that make no triangle", left_over);
        budget_.charge(faces.vertices.size());
        const auto offset = static_cast<Index>(first);
        for (Index& v : faces.vertices) v += offset;
        for (Index f = 0; f < faces.size(); ++f) {
            Index* const begin = faces.vertices.data() + faces.offsets[f];
            if (mirrored) std::reverse(begin + 1, faces.vertices.data() + faces.offsets[f + 1]);
            add_face(mesh_.faces, faces[f]);
        }
        const bool has_material =
            primitive.material >= 0 &&
            static_cast<std::size_t>(primitive.material) < material_labels_.names.size();
        material_labels_.of_face.resize(static_cast<std::size_t>(mesh_.faces.size()),
                                        has_material ? primitive.material : kNoIndex);
    }

    void label_faces(const std::string& label, Index first_face) {
        if (mesh_.faces.size() == first_face) return;
        object_labels_.names.push_back(label);
        object_labels_.of_face.resize(static_cast<std::size_t>(mesh_.faces.size()),
                                      static_cast<Index>(object_labels_.names.size()) - 1);
    }

    void read_extras(const GltfInstance& instance, std::size_t first_vertex, Index first_face) {
        const Json& json = document_.json["meshes"][static_cast<std::size_t>(instance.mesh)];
        if (!json.contains("extras")) return;
        Json mesh{{"extras", json["extras"]}};
        bool fits = true;
        const MeshExtras extras =
            take_extras(mesh, mesh_.positions.size() - first_vertex,
                        static_cast<std::size_t>(mesh_.faces.size() - first_face), fits);
        if (!fits) {
            skipped_.add(FindingKind::content_skipped,
                         "regions and groups that no longer fit the surface");
        }
        for (const auto& [kind, labels] : extras.labels) add_labels(kind, labels, first_face);
        turn_faces(extras.turns, first_face);
        corner_attributes_.insert(extras.corners.begin(), extras.corners.end());
        for (const auto& [name, vertices] : extras.regions) {
            std::vector<Index>& region = mesh_.regions[name];
            for (const Index v : vertices) region.push_back(v + static_cast<Index>(first_vertex));
        }
    }

    // Makes the corner at place `turns[i]` of face `first_face` + i its first.
    void turn_faces(const std::vector<Index>& turns, Index first_face) {
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const auto f = static_cast<std::size_t>(first_face) + i;
            const auto begin = mesh_.faces.vertices.begin() + mesh_.faces.offsets[f];
            const auto end = mesh_.faces.vertices.begin() + mesh_.faces.offsets[f + 1];
            if (turns[i] < end - begin) std::rotate(begin, begin + turns[i], end);
        }
    }

    // Gives the values of vertices to corners.
    void move_to_corners(Attribute& attribute) const {
        std::vector<double> values;
        values.reserve(mesh_.faces.vertices.size() * static_cast<std::size_t>(attribute.width));
        for (const Index v : mesh_.faces.vertices) {
            const std::span<const double> value = std::as_const(attribute).at(v);
            values.insert(values.end(), value.begin(), value.end());
        }
        attribute.values = std::move(values);
        attribute.domain = Domain::corner;
    }

    void add_labels(const std::string& kind, const FaceLabels& labels, Index first_face) {
        FaceLabels& all = mesh_.attributes.labels()[kind];
        all.of_face.resize(static_cast<std::size_t>(first_face), kNoIndex);
        std::vector<Index> renumbered;
        for (const std::string& name : labels.names) renumbered.push_back(all.add(name));
        for (const Index label : labels.of_face) {
            all.of_face.push_back(label == kNoIndex ? kNoIndex : renumbered[label]);
        }
    }

    void finish() {
        columns_.finish(mesh_.attributes, mesh_.positions.size());
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
            list.of_face.resize(static_cast<std::size_t>(mesh_.faces.size()), kNoIndex);
        }
        skipped_.report(mesh_.report);
    }

    GltfDocument& document_;
    const AccessorReader& accessors_;
    GltfBudget& budget_;
    const Context& context_;
    MeshData mesh_;
    AttributeColumns columns_;
    FaceLabels object_labels_, material_labels_;
    Skipped skipped_;
    std::set<std::string> corner_attributes_;
    bool only_points_ = false;
};

MeshData read_document(const FileInput& file, const Context& context) {
    Report report;
    GltfDocument document = open_gltf(file, report, context);
    GltfBudget budget(document.bytes_read);
    const AccessorReader accessors(document, budget);
    expand_instancing(document.json, accessors, budget);
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
