#include "kernel/io/gltf/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

constexpr Index kMaxTargets = 10000;

bool has_width(const GltfAttributeName& name, Index width) {
    switch (name.semantic) {
        case GltfSemantic::uv:
            return width == 2;
        case GltfSemantic::normal:
            return width == 3;
        case GltfSemantic::tangent:
            return width == 4;
        case GltfSemantic::color:
            return width == 3 || width == 4;
        default:
            return name.semantic == GltfSemantic::custom && width <= 4;
    }
}

// Whole numbers that a float would change are not written.
bool survives(const Attribute& attribute) {
    if (attribute.type != ScalarType::int32 && attribute.type != ScalarType::uint32) return true;
    return std::all_of(attribute.values.begin(), attribute.values.end(), [](double value) {
        return !(value == value) || (static_cast<float>(value)) == value;
    });
}

// True if all values are whole multiples of 1 / largest, or none.
bool are_multiples(const std::vector<double>& values, double largest) {
    constexpr double kRounding = 1e-6;
    return std::all_of(values.begin(), values.end(), [&](double x) {
        const double scaled = x * largest;
        return !(x == x) ||
               (x >= 0.0 && x <= 1.0 && std::abs(scaled - std::round(scaled)) < kRounding);
    });
}

bool is_short(ScalarType type) {
    return is_integer(type) && size_of(type) <= 2;
}

bool are_whole(const Attribute& attribute) {
    const ScalarRange range = range_of(attribute.type);
    return std::all_of(attribute.values.begin(), attribute.values.end(), [&](double x) {
        return x == std::round(x) && x >= range.min && x <= range.max;
    });
}

// Colors are fractions of whole numbers, and others whole numbers.
void choose_form(WrittenAttribute& written) {
    const Attribute& attribute = *written.attribute;
    const bool is_color = written.name.semantic == GltfSemantic::color;
    const bool is_unsigned =
        attribute.type == ScalarType::uint8 || attribute.type == ScalarType::uint16;
    if (is_color && is_unsigned && are_multiples(attribute.values, range_of(attribute.type).max)) {
        written.type = attribute.type;
        written.normalized = true;
    }
    const bool is_custom = written.name.semantic == GltfSemantic::custom;
    if (is_custom && is_short(attribute.type) && are_whole(attribute)) {
        written.type = attribute.type;
    }
}

void take_joints(SavedParts& parts, WrittenAttributes& result) {
    const AttributeSet& all = parts.mesh().attributes();
    const Attribute *joints = all.find("joints"), *weights = all.find("weights");
    const bool good = joints && weights && joints->domain == Domain::vertex &&
                      weights->domain == Domain::vertex && joints->width == weights->width &&
                      joints->width % 4 == 0;
    if (!good) return;
    parts.take(*joints);
    parts.take(*weights);
    result.joints = joints;
    result.weights = weights;
}

template <typename Key, typename Find>
Index& number_of(std::map<Key, Index>& numbers, const Key& key, const Find& add) {
    const auto [entry, is_new] = numbers.emplace(key, kNoIndex);
    if (is_new) entry->second = add();
    return entry->second;
}

}  // namespace

std::vector<const Attribute*> WrittenAttributes::of_corners() const {
    std::vector<const Attribute*> result;
    const auto add = [&](const Attribute* attribute) {
        if (attribute->domain == Domain::corner) result.push_back(attribute);
    };
    for (const WrittenAttribute& written : plain) add(written.attribute);
    for (const WrittenMorph& morph : morphs) add(morph.attribute);
    return result;
}

WrittenAttributes take_attributes(SavedParts& parts) {
    WrittenAttributes result;
    for (const Attribute& attribute : parts.mesh().attributes().all()) {
        if (attribute.domain == Domain::face) continue;
        const MorphName morph = parse_morph_name(attribute.name);
        if (morph.target > 0 && morph.target <= kMaxTargets && attribute.width == 3) {
            result.morphs.push_back({&attribute, morph});
            parts.take(attribute);
            continue;
        }
        const GltfAttributeName name = parse_mesh_attribute(attribute.name);
        if (!has_width(name, attribute.width) || !survives(attribute)) continue;
        result.plain.push_back({&attribute, name, ScalarType::float32, false});
        choose_form(result.plain.back());
        parts.take(attribute);
    }
    take_joints(parts, result);
    return result;
}

namespace {

// The label that stands for all that are connected with a label; the last number is no label.
class ConnectedLabels {
  public:
    ConnectedLabels(const Mesh& mesh, const FaceLabels* labels)
        : labels_(labels), parent_(labels ? labels->names.size() + 1 : 1) {
        std::iota(parent_.begin(), parent_.end(), 0);
        if (!labels) return;
        std::vector<Index> label_at(mesh.vertex_count(), kNoIndex);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            for (const Index v : mesh.topology().face(f)) {
                if (label_at[v] == kNoIndex) label_at[v] = number(f);
                parent_[root(label_at[v])] = root(number(f));
            }
        }
    }

    Index of_face(Index f) { return root(number(f)); }

  private:
    Index number(Index f) const {
        const Index label = labels_ ? labels_->of_face[f] : kNoIndex;
        return label == kNoIndex ? count_of(parent_) - 1 : label;
    }

    Index root(Index label) {
        while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
        return label;
    }

    const FaceLabels* labels_;
    std::vector<Index> parent_;
};

}  // namespace

std::vector<SurfaceObject> divide_surface(const Mesh& mesh, const FaceLabels* objects,
                                          const FaceLabels* materials,
                                          std::vector<Index>& pool_of_face) {
    std::vector<SurfaceObject> result;
    std::map<Index, Index> object_of_label;
    std::map<std::pair<Index, Index>, Index> primitive_of;
    ConnectedLabels connected(mesh, objects);
    pool_of_face.clear();
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index material = materials ? materials->of_face[f] : kNoIndex;
        const Index o = number_of(object_of_label, connected.of_face(f), [&] {
            result.push_back({objects ? objects->of_face[f] : kNoIndex, false, {}});
            return count_of(result) - 1;
        });
        result[o].is_joined =
            result[o].is_joined || (objects && objects->of_face[f] != result[o].label);
        std::vector<SurfacePrimitive>& primitives = result[o].primitives;
        const Index p = number_of(primitive_of, std::pair(o, material), [&] {
            primitives.push_back({material, {}});
            return count_of(primitives) - 1;
        });
        primitives[p].faces.push_back(f);
        pool_of_face.push_back(o);
    }
    return result;
}

}  // namespace lissom
