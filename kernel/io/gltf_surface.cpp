#include "kernel/io/gltf_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernel/io/scalar.h"

namespace lissom {
namespace {

constexpr Index kMaximumTargets = 10000;

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
        return !(value == value) || static_cast<double>(static_cast<float>(value)) == value;
    });
}

// True where all values are whole multiples of 1 / largest, or none.
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
        if (morph.target > 0 && morph.target <= kMaximumTargets && attribute.width == 3) {
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

std::vector<SurfaceObject> divide_surface(const Mesh& mesh, const FaceLabels* objects,
                                          const FaceLabels* materials,
                                          std::vector<Index>& pool_of_face) {
    std::vector<SurfaceObject> result;
    std::map<Index, Index> object_of_label;
    std::map<std::pair<Index, Index>, Index> primitive_of;
    pool_of_face.clear();
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index label = objects ? objects->of_face[f] : kNoIndex;
        const Index material = materials ? materials->of_face[f] : kNoIndex;
        const Index o = number_of(object_of_label, label, [&] {
            result.push_back({label, {}});
            return static_cast<Index>(result.size()) - 1;
        });
        std::vector<SurfacePrimitive>& primitives = result[o].primitives;
        const Index p = number_of(primitive_of, std::pair(o, material), [&] {
            primitives.push_back({material, {}});
            return static_cast<Index>(primitives.size()) - 1;
        });
        primitives[p].faces.push_back(f);
        pool_of_face.push_back(o);
    }
    return result;
}

}  // namespace lissom
