/// The names of vertex attributes in glTF and in a mesh; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/geometry.h"

namespace lissom {

/// Kinds of values of glTF's attributes.
enum class GltfSemantic { unknown, position, normal, tangent, uv, color, joints, weights, custom };

/// An attribute of a primitive.
struct GltfAttributeName {
    GltfSemantic semantic = GltfSemantic::unknown;
    /// The n of TEXCOORD_n, COLOR_n, JOINTS_n, WEIGHTS_n.
    Index set = 0;
    /// The attribute's name in a mesh.
    std::string name;
};

/// Takes apart the name of an attribute in a primitive, such as "TEXCOORD_1" or "_AREA".
GltfAttributeName parse_gltf_attribute(std::string_view name);

/// Takes apart the name of an attribute of a mesh; `semantic` is unknown for those with another
/// place in glTF (morph targets).
GltfAttributeName parse_mesh_attribute(std::string_view name);

/// Returns the name under which a mesh's attribute stands in a primitive; not for joints and
/// weights.
std::string gltf_attribute_name(const GltfAttributeName& attribute);

/// The parts of "morph.N.position", N from 1; 0 if `name` is none.
struct MorphName {
    Index target = 0;
    GltfSemantic semantic = GltfSemantic::unknown;
};
MorphName parse_morph_name(std::string_view name);
std::string morph_name(Index target, GltfSemantic semantic);

}  // namespace lissom
