/// The surface of a mesh as glTF has it: objects, each with a pool of vertices and a primitive for
/// each material; private to kernel/io.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/gltf/mesh/names.h"
#include "kernel/io/record/saved_parts.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// An attribute that is written, under its name in glTF.
struct WrittenAttribute {
    const Attribute* attribute = nullptr;
    GltfAttributeName name;
    /// The narrowest form that holds the values: float32, or an integer type of at most 16 bits.
    ScalarType type = ScalarType::float32;
    bool normalized = false;
};

/// Offsets of a morph target.
struct WrittenMorph {
    const Attribute* attribute = nullptr;
    MorphName name;
};

/// The attributes that glTF can hold, taken from the parts.
struct WrittenAttributes {
    std::vector<WrittenAttribute> plain;
    std::vector<WrittenMorph> morphs;
    /// Both or none.
    const Attribute* joints = nullptr;
    const Attribute* weights = nullptr;

    /// Returns the attributes of corners.
    std::vector<const Attribute*> of_corners() const;
};

WrittenAttributes take_attributes(SavedParts& parts);

/// Faces of one material, in order.
struct SurfacePrimitive {
    /// Number in the labels "material", or kNoIndex.
    Index material = kNoIndex;
    std::vector<Index> faces;
};

/// Faces of one label "object", or of several that have vertices in common.
struct SurfaceObject {
    /// The first in the labels "object", or kNoIndex.
    Index label = kNoIndex;
    /// Whether there are several.
    bool is_joined = false;
    std::vector<SurfacePrimitive> primitives;
};

/// Returns the objects in order of their first faces. `pool_of_face` receives the object of each
/// face.
std::vector<SurfaceObject> divide_surface(const Mesh& mesh, const FaceLabels* objects,
                                          const FaceLabels* materials,
                                          std::vector<Index>& pool_of_face);

}  // namespace lissom
