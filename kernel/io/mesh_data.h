/// What a reader takes from a file, before a Mesh is made of it; private to kernel/io.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/topology.h"

namespace lissom {

struct MeshData {
    std::vector<Vec3> positions;
    FaceList faces;
    AttributeSet attributes;
    std::vector<std::string> material_libraries;

    std::size_t memory_bytes() const;
};

/// Adds a face. Errors: file_too_large beyond the number of corners that can be numbered.
void add_face(FaceList& faces, std::span<const Index> face);

/// Adds an attribute of faces or vertices; where another domain has one of its name, this one is
/// called "face_<name>", as `face_attribute_name` expects.
void add_without_clash(AttributeSet& attributes, Attribute attribute);

/// The name under which a face attribute stands in a file that tells faces and vertices apart.
std::string face_attribute_name(const AttributeSet& attributes, const Attribute& attribute);

}  // namespace lissom
