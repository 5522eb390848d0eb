#include "kernel/io/gltf/mesh/mesh_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "kernel/io/gltf/file/draco.h"
#include "kernel/io/gltf/file/extras.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/mesh/fans.h"
#include "kernel/io/gltf/mesh/told_morphs.h"
#include "kernel/io/gltf/mesh/values.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

// Vertices of a pool that a primitive uses, each once.
std::vector<Index> used_vertices(const std::vector<Index>& corners, std::size_t pool_size) {
    std::vector<char> used(pool_size, 0);
    for (const Index v : corners) used[v] = 1;
    std::vector<Index> list;
    for (std::size_t v = 0; v < pool_size; ++v) {
        if (used[v]) list.push_back(index_of(v));
    }
    return list;
}

// The name of a target without offsets.
constexpr const char* kNoOffsets = "nothing";

// Least number of each component, and the size of the widest range.
struct NumberRange {
    std::vector<float> least;
    float size = 0.0f;
};

NumberRange range_of(const WrittenNumbers& numbers) {
    NumberRange range;
    const auto width = static_cast<std::size_t>(numbers.width);
    for (std::size_t k = 0; k < width && k < numbers.values.size(); ++k) {
        double least = numbers.values[k], greatest = least;
        for (std::size_t i = k; i < numbers.values.size(); i += width) {
            least = std::min(least, numbers.values[i]);
            greatest = std::max(greatest, numbers.values[i]);
        }
        range.least.push_back(static_cast<float>(least));
        range.size = std::max(range.size, static_cast<float>(greatest - least));
    }
    return range;
}

// Makes numbers the shortest integers that stand for -1 to 1, or 0 to 1, in their step or finer.
// Returns false, without a change, if there are none.
bool narrow(WrittenNumbers& numbers) {
    struct Form {
        ScalarType type;
        double largest, least;
    };
    constexpr Form kForms[] = {{ScalarType::int8, 127.0, -1.0},
                               {ScalarType::uint8, 255.0, 0.0},
                               {ScalarType::int16, 32767.0, -1.0},
                               {ScalarType::uint16, 65535.0, 0.0}};
    if (numbers.step <= 0.0 || numbers.values.empty()) return false;
    const auto [least, greatest] =
        std::minmax_element(numbers.values.begin(), numbers.values.end());
    for (const Form& form : kForms) {
        const bool holds = *least >= form.least && *greatest <= 1.0;
        if (!holds || 1.0 / form.largest > numbers.step) continue;
        for (double& value : numbers.values) value = std::round(value * form.largest) + 0.0;
        numbers.type = form.type;
        numbers.normalized = true;
        numbers.step = 0.0;
        return true;
    }
    return false;
}

// Accessors written before, by their contents.
using Written = std::map<std::string, std::size_t>;

}  // namespace

// One mesh while it is written.
class MeshWriter::Object {
  public:
    Object(MeshWriter& writer, const VertexPool& pool, const ObjectPlace& place)
        : writer_(writer),
          pool_(pool),
          place_(place),
          values_(writer.parts_.mesh(), pool, place.to_node) {
        mesh_ = place.mesh;
        kept_primitives_ = mesh_.value("primitives", Json::array());
        mesh_["primitives"] = Json::array();
        find_targets();
        find_joints();
        find_steps();
    }

    // A primitive compressed by Draco holds its own vertices: those where materials meet are in
    // several primitives, and their places tell that they are one.
    void expect_primitives(const SurfaceObject& object, const VertexPools& pools) {
        is_packed_ = writer_.uses_draco;
        is_split_ = is_packed_ && object.primitives.size() > 1;
        if (!is_split_ || (!writer_.states_copies && tells_apart(object, pools))) return;
        is_packed_ = is_split_ = false;
        ++writer_.uncompressed_;
    }

    void add_primitive(const SurfacePrimitive& primitive, const VertexPools& pools,
                       const PlacedMaterial& material) {
        const FanWriter fans = triangulated(primitive, pools);
        std::vector<Index> corners = fans.corners();
        const std::vector<Index> used = used_vertices(corners, pool_.size());
        if (is_split_) begin_part(used, corners);
        Json json = beside_surface(material.number);
        if (material.number >= 0) json["material"] = material.number;
        if (fans.has_polygons()) {
            (*json.emplace("extensions", Json::object()).first)["FB_ngon_encoding"] =
                Json::object();
        }
        json["attributes"] = attributes_of(used, material.uv_count);
        if (Json targets = targets_of(json["attributes"]); !targets.empty()) {
            json["targets"] = std::move(targets);
        }
        json["indices"] = indices(corners);
        if (is_packed_) pack(json, corners);
        mesh_["primitives"].push_back(std::move(json));
    }

    void keep_objects(const FaceLabels& objects) { objects_ = &objects; }

    void add_points() {
        std::vector<Index> all;
        for (std::size_t v = 0; v < pool_.size(); ++v) all.push_back(index_of(v));
        mesh_["primitives"].push_back(
            json_object({{"mode", TINYGLTF_MODE_POINTS}, {"attributes", attributes_of(all, 0)}}));
    }

    Json finish() {
        put_extras(mesh_, extras(), is_split_ ? written_vertices_.size() : pool_.size(),
                   faces_.size());
        return std::move(mesh_);
    }

  private:
    // Whether no other vertex lies where materials meet.
    bool tells_apart(const SurfaceObject& object, const VertexPools& pools) const {
        const Topology& topology = writer_.parts_.mesh().topology();
        const std::vector<char>& shared = writer_.shared_places();
        std::vector<Index> part_of(pool_.size(), kNoIndex);
        for (std::size_t p = 0; p < object.primitives.size(); ++p) {
            for (const Index f : object.primitives[p].faces) {
                for (std::size_t k = 0; k < topology.face(f).size(); ++k) {
                    const Index v = pools.vertex_of_corner(topology.first_corner(f) + index_of(k));
                    const bool meets = part_of[v] != kNoIndex && part_of[v] != index_of(p);
                    if (meets && shared[pool_.vertices[v]]) return false;
                    part_of[v] = index_of(p);
                }
            }
        }
        return true;
    }

    // Numbers the vertices of the next primitive by themselves.
    void begin_part(const std::vector<Index>& used, std::vector<Index>& corners) {
        written_.clear();
        packed_.clear();
        joints_.clear();
        selected_ = used;
        written_vertices_.insert(written_vertices_.end(), used.begin(), used.end());
        std::vector<Index> number(pool_.size(), kNoIndex);
        for (std::size_t i = 0; i < used.size(); ++i) number[used[i]] = index_of(i);
        for (Index& corner : corners) corner = number[corner];
    }

    void select(WrittenNumbers& numbers) const {
        if (!is_split_) return;
        const auto width = static_cast<std::size_t>(numbers.width);
        std::vector<double> values;
        values.reserve(width * selected_.size());
        for (const Index v : selected_) {
            const auto first = numbers.values.begin() + static_cast<std::ptrdiff_t>(at(v) * width);
            values.insert(values.end(), first, first + numbers.width);
        }
        numbers.values = std::move(values);
    }

    bool has_value(const Attribute& attribute, const std::vector<Index>& vertices) const {
        return std::any_of(vertices.begin(), vertices.end(),
                           [&](Index v) { return values_.has_value(attribute, v); });
    }

    bool has_value(const Attribute& attribute) const {
        for (std::size_t v = 0; v < pool_.size(); ++v) {
            if (values_.has_value(attribute, v)) return true;
        }
        return false;
    }

    void find_targets() {
        for (const WrittenMorph& morph : writer_.attributes_.morphs) {
            if (!can_read(*morph.attribute) || !has_value(*morph.attribute)) continue;
            target_count_ = std::max(target_count_, at(morph.name.target));
            morphs_[at(morph.name.target)].push_back(&morph);
        }
        // Names, weights and animations of weights are of as many targets as there were.
        if (target_count_ > 0) target_count_ = std::max(target_count_, told_morph_count(mesh_));
        fit_morphs(mesh_, target_count_);
    }

    void find_joints() {
        const WrittenAttributes& all = writer_.attributes_;
        has_joints_ = all.joints && has_value(*all.joints);
    }

    // Points have no corners.
    bool can_read(const Attribute& attribute) const {
        return attribute.domain == Domain::vertex || pool_.size() == 0 ||
               pool_.corners[0] != kNoIndex;
    }

    // Returns the contents of this material's primitive beside the surface.
    Json beside_surface(int material) const {
        for (const Json& kept : kept_primitives_) {
            if (kept.value("material", -1) != material) continue;
            Json json = kept;
            json.erase("material");
            return json;
        }
        return Json::object();
    }

    FanWriter triangulated(const SurfacePrimitive& primitive, const VertexPools& pools) {
        const Mesh& mesh = writer_.parts_.mesh();
        const Topology& topology = mesh.topology();
        FanWriter fans;
        if (std::any_of(primitive.faces.begin(), primitive.faces.end(),
                        [&](Index f) { return topology.face(f).size() > 3; })) {
            fans.expect_polygons();
        }
        std::vector<Index> vertices;
        std::vector<Vec3> points;
        for (const Index f : primitive.faces) {
            vertices.clear();
            points.clear();
            for (const Index v : topology.face(f)) {
                const auto k = count_of(vertices);
                vertices.push_back(pools.vertex_of_corner(topology.first_corner(f) + k));
                points.push_back(mesh.position(v));
            }
            look_at_loss(f, points);
            if (place_.to_node.mirrors()) {
                std::reverse(vertices.begin() + 1, vertices.end());
                std::reverse(points.begin() + 1, points.end());
            }
            FanWriter::Added added = fans.add(vertices, points);
            if (place_.to_node.mirrors() && added.turn != 0) {
                added.turn = count_of(vertices) - added.turn;
            }
            faces_.push_back(f);
            turns_.push_back(added.turn);
            parts_.push_back(added.parts);
        }
        return fans;
    }

    void look_at_loss(Index f, const std::vector<Vec3>& points) {
        placed_.clear();
        for (const Vec3& p : points) placed_.push_back(place_.to_node.position(p));
        writer_.float_loss_.look_at(f, placed_);
    }

    // The steps of positions and of directions, powers of two.
    void find_steps() {
        if (writer_.quantize == 0) return;
        constexpr int kMinBits = 8;
        Box box;
        for (const Index v : pool_.vertices) {
            box.extend(place_.to_node.position(writer_.parts_.mesh().position(v)));
        }
        const double size = box.empty() ? 1.0 : (box.max - box.min).maxCoeff();
        const int exponent = size > 0.0 && std::isfinite(size) ? std::ilogb(size) : 0;
        position_step_ = std::ldexp(1.0, exponent - writer_.quantize);
        uv_step_ = std::ldexp(1.0, -writer_.quantize);
        direction_step_ = std::ldexp(1.0, -std::max(kMinBits, writer_.quantize / 2));
    }

    double step_of(GltfSemantic semantic) const {
        switch (semantic) {
            case GltfSemantic::position:
                return position_step_;
            case GltfSemantic::normal:
            case GltfSemantic::tangent:
                return direction_step_;
            case GltfSemantic::uv:
                return uv_step_;
            default:
                return 0.0;
        }
    }

    // Returns the accessor of the values with this name, made when first asked for.
    template <typename Make>
    std::size_t once(const std::string& name, GltfSemantic semantic, const Make& make) {
        const auto known = written_.find(name);
        if (known != written_.end()) return known->second;
        WrittenNumbers numbers = make();
        if (numbers.type == ScalarType::float32) numbers.step = step_of(semantic);
        if (writer_.writes_integers && may_be_integers(name, semantic)) {
            writer_.has_integers_ = narrow(numbers) || writer_.has_integers_;
        }
        round_to_step(numbers);
        // Of the whole object, so that a vertex is the same in all primitives.
        const NumberRange range = range_of(numbers);
        select(numbers);
        return written_[name] = add_numbers(name, semantic, std::move(numbers), range);
    }

    // Positions would need a scale in their node.
    static bool may_be_integers(const std::string& name, GltfSemantic semantic) {
        return semantic != GltfSemantic::position || name.starts_with("morph.");
    }

    std::size_t add_numbers(const std::string& name, GltfSemantic semantic, WrittenNumbers numbers,
                            const NumberRange& range) {
        const bool with_bounds = semantic == GltfSemantic::position;
        const bool is_target = name.starts_with("morph.") || name == kNoOffsets;
        if (is_target) return writer_.binary_.add_sparse(numbers, with_bounds);
        if (!is_packed_) return writer_.binary_.add(numbers, BufferUse::vertices, with_bounds);
        const std::size_t number = writer_.binary_.add_without_view(numbers, with_bounds);
        packed_.push_back({number, semantic, std::move(numbers), range});
        return number;
    }

    // Gives a primitive the compressed form of its attributes and indices.
    void pack(Json& json, const std::vector<Index>& corners) {
        std::vector<std::string> bytes;
        for (const Packed& one : packed_) {
            bytes.push_back(encoded(one.numbers, one.numbers.width * size_of(one.numbers.type)));
        }
        std::vector<DracoAttribute> attributes;
        for (std::size_t a = 0; a < packed_.size(); ++a) {
            const WrittenNumbers& numbers = packed_[a].numbers;
            attributes.push_back({bytes[a], numbers.width, numbers.type, numbers.normalized,
                                  packed_[a].semantic == GltfSemantic::position,
                                  bits_of(packed_[a]), packed_[a].range.least,
                                  packed_[a].range.size});
        }
        Json ids = Json::object();
        for (const auto& item : json["attributes"].items()) {
            for (std::size_t a = 0; a < packed_.size(); ++a) {
                if (packed_[a].accessor == item.value()) ids[item.key()] = a;
            }
        }
        const std::vector<std::uint32_t> indices(corners.begin(), corners.end());
        const std::size_t view = writer_.binary_.add_view(encode_draco(indices, attributes));
        Json extension = json_object({{"bufferView", view}, {"attributes", std::move(ids)}});
        json["extensions"]["KHR_draco_mesh_compression"] = std::move(extension);
    }

    struct Packed {
        std::size_t accessor = 0;
        GltfSemantic semantic = GltfSemantic::position;
        WrittenNumbers numbers;
        NumberRange range;
    };

    // Draco divides the range of the numbers, which directions and positions fill.
    int bits_of(const Packed& packed) const {
        if (packed.numbers.step == 0.0) return 0;
        const bool is_direction =
            packed.semantic == GltfSemantic::normal || packed.semantic == GltfSemantic::tangent;
        return is_direction ? 1 - std::ilogb(direction_step_) : writer_.quantize + 1;
    }

    Json attributes_of(const std::vector<Index>& used, Index uv_count) {
        Json json = Json::object();
        json["POSITION"] =
            once("POSITION", GltfSemantic::position, [&] { return values_.positions(); });
        Index sets_of_uv = uv_count, sets_of_color = 0;
        bool has_normal = false;
        for (const WrittenAttribute& written : writer_.attributes_.plain) {
            if (!can_read(*written.attribute) || !has_value(*written.attribute, used)) continue;
            const GltfSemantic semantic = written.name.semantic;
            if (semantic == GltfSemantic::uv)
                sets_of_uv = std::max(sets_of_uv, written.name.set + 1);
            if (semantic == GltfSemantic::color) {
                sets_of_color = std::max(sets_of_color, written.name.set + 1);
            }
            has_normal = has_normal || semantic == GltfSemantic::normal;
            const std::string name = gltf_attribute_name(written.name);
            json[name] = once(name, semantic, [&] { return values_.attribute(written); });
        }
        fill_sets(json, "TEXCOORD_", sets_of_uv, 2);
        fill_sets(json, "COLOR_", sets_of_color, 3);
        // Tangents mean nothing without normals.
        if (!has_normal && json.erase("TANGENT") > 0) ++writer_.lost_tangents_;
        add_joints(json);
        return json;
    }

    // Sets are numbered without gaps.
    void fill_sets(Json& json, const std::string& prefix, Index count, Index width) {
        for (Index set = 0; set < count; ++set) {
            const std::string name = prefix + std::to_string(set);
            if (json.contains(name)) continue;
            json[name] = once(name, GltfSemantic::color, [&] {
                WrittenNumbers numbers = values_.zeros(width);
                if (width > 2) std::fill(numbers.values.begin(), numbers.values.end(), 1.0);
                return numbers;
            });
        }
    }

    void add_joints(Json& json) {
        if (!has_joints_) return;
        if (joints_.empty()) {
            const auto sets = values_.joint_sets(writer_.attributes_, place_.joint_count);
            for (const PoolValues::JointSet& set : sets) {
                const std::string number = std::to_string(joints_.size());
                joints_.emplace_back(
                    once("JOINTS_" + number, GltfSemantic::color, [&] { return set.joints; }),
                    once("WEIGHTS_" + number, GltfSemantic::color, [&] { return set.weights; }));
            }
        }
        for (std::size_t set = 0; set < joints_.size(); ++set) {
            json["JOINTS_" + std::to_string(set)] = joints_[set].first;
            json["WEIGHTS_" + std::to_string(set)] = joints_[set].second;
        }
    }

    // As many for each primitive; a target without offsets adds zeros to the positions.
    Json targets_of(const Json& attributes) {
        Json targets = Json::array();
        for (std::size_t t = 1; t <= target_count_; ++t) {
            Json target = Json::object();
            for (const WrittenMorph* morph : morphs_[t]) {
                const std::string name =
                    gltf_attribute_name({morph->name.semantic, 0, std::string()});
                if (!attributes.contains(name)) continue;
                target[name] = once(morph->attribute->name, morph->name.semantic,
                                    [&] { return values_.morph(*morph); });
            }
            if (target.empty()) {
                target["POSITION"] =
                    once(kNoOffsets, GltfSemantic::position, [&] { return values_.zeros(3); });
            }
            targets.push_back(std::move(target));
        }
        return targets;
    }

    std::size_t indices(const std::vector<Index>& corners) const {
        // The largest number of a type may not be used.
        const bool is_short = (is_split_ ? selected_.size() : pool_.size()) <= 0xffff;
        WrittenNumbers numbers{1, is_short ? ScalarType::uint16 : ScalarType::uint32, false, {}};
        numbers.values.assign(corners.begin(), corners.end());
        if (is_packed_) return writer_.binary_.add_without_view(numbers, false);
        return writer_.binary_.add(numbers, BufferUse::indices);
    }

    void add_labels(const std::string& kind, const FaceLabels& labels, MeshExtras& result) const {
        std::map<Index, Index> numbers;
        FaceLabels own;
        for (const Index f : faces_) {
            const Index label = labels.of_face[f];
            if (label != kNoIndex && numbers.emplace(label, own.names.size()).second) {
                own.names.push_back(labels.names[label]);
            }
            own.of_face.push_back(label == kNoIndex ? kNoIndex : numbers[label]);
        }
        if (!own.names.empty()) result.labels[kind] = std::move(own);
    }

    // How many vertices of the pool each vertex of the surface is.
    std::vector<Index> copies() const {
        std::vector<Index> result;
        for (std::size_t i = 0; i < pool_.size(); ++i) {
            if (i == 0 || pool_.vertices[i] != pool_.vertices[i - 1]) result.push_back(0);
            ++result.back();
        }
        return result;
    }

    MeshExtras extras() const {
        MeshExtras result;
        for (const auto& [kind, labels] : writer_.labels_) add_labels(kind, *labels, result);
        if (objects_) add_labels("object", *objects_, result);
        for (const auto& [name, mask] : writer_.regions_) {
            std::vector<Index> inside;
            const std::size_t count = is_split_ ? written_vertices_.size() : pool_.size();
            for (std::size_t i = 0; i < count; ++i) {
                const Index v = is_split_ ? written_vertices_[i] : index_of(i);
                if (mask[pool_.vertices[v]]) inside.push_back(index_of(i));
            }
            if (!inside.empty()) result.regions[name] = std::move(inside);
        }
        if (std::any_of(turns_.begin(), turns_.end(), [](Index t) { return t != 0; })) {
            result.turns = turns_;
        }
        if (std::any_of(parts_.begin(), parts_.end(), [](Index n) { return n != 1; })) {
            result.parts = parts_;
        }
        if (writer_.states_copies && !faces_.empty()) result.copies = copies();
        if (!faces_.empty()) {
            for (const Attribute* attribute : writer_.attributes_.of_corners()) {
                result.corners.push_back(attribute->name);
            }
        }
        return result;
    }

    MeshWriter& writer_;
    const VertexPool& pool_;
    const ObjectPlace& place_;
    PoolValues values_;
    Json mesh_, kept_primitives_;
    Written written_;
    std::vector<std::pair<std::size_t, std::size_t>> joints_;
    std::map<std::size_t, std::vector<const WrittenMorph*>> morphs_;
    std::size_t target_count_ = 0;
    bool has_joints_ = false, is_packed_ = false, is_split_ = false;
    // Vertices of the pool that the primitive at hand has, and those of all primitives in a row, if
    // each has its own.
    std::vector<Index> selected_, written_vertices_;
    double position_step_ = 0.0, direction_step_ = 0.0, uv_step_ = 0.0;
    std::vector<Packed> packed_;
    // Corners of the face at hand, in the node.
    std::vector<Vec3> placed_;
    // The face of the mesh that each polygon read back will be.
    std::vector<Index> faces_;
    // Position of the first corner in each polygon, and the number of its faces.
    std::vector<Index> turns_, parts_;
    // Labels of the objects that the mesh is made of, if there are several.
    const FaceLabels* objects_ = nullptr;
};

MeshWriter::MeshWriter(SavedParts& parts, const WrittenAttributes& attributes, GltfBinary& binary,
                       const Context& context)
    : parts_(parts), attributes_(attributes), binary_(binary), context_(context) {
    for (const auto& [kind, labels] : parts.mesh().attributes().labels()) {
        if (kind == "object" || kind == "material") continue;
        labels_.emplace_back(kind, parts.take_labels(kind));
    }
    for (const auto& [name, region] : parts.take_regions()) {
        regions_.emplace_back(name, region.mask());
    }
}

const std::vector<char>& MeshWriter::shared_places() {
    const Mesh& mesh = parts_.mesh();
    if (!shared_places_.empty()) return shared_places_;
    std::vector<Index> order(mesh.positions().size());
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](Index v) {
        const Eigen::Vector3f p = mesh.position(v).cast<float>();
        return std::array<float, 3>{p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return place(a) < place(b); });
    shared_places_.assign(order.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (place(order[i]) != place(order[i - 1])) continue;
        shared_places_[order[i]] = shared_places_[order[i - 1]] = 1;
    }
    return shared_places_;
}

Json MeshWriter::write(const SurfaceObject& object, const VertexPools& pools, Index number,
                       const ObjectPlace& place, const std::vector<PlacedMaterial>& materials) {
    Object writer(*this, pools.pool(number), place);
    writer.expect_primitives(object, pools);
    if (object.is_joined) writer.keep_objects(*parts_.take_labels("object"));
    for (std::size_t p = 0; p < object.primitives.size(); ++p) {
        context_.checkpoint();
        writer.add_primitive(object.primitives[p], pools, materials[p]);
    }
    return writer.finish();
}

Json MeshWriter::write_points(const ObjectPlace& place) {
    const VertexPool pool = pool_of_points(parts_.mesh());
    Object writer(*this, pool, place);
    writer.add_points();
    return writer.finish();
}

}  // namespace lissom
