/// Morph targets while the shape under them is smoothed, refined or fitted: their offsets go
/// through the linear map of the positions. Private to the kernel.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Displacements by vertex, to those of the vertices after an operation: the operation's weights,
/// as the mesh's own shape gave them, applied to displacements in place of positions.
using MorphMap = std::function<std::vector<Vec3>(std::vector<Vec3>)>;

/// True for the displacements of a morph target on vertices or corners.
bool is_morph_position(const Attribute& attribute);

/// Returns how many morph targets of `mesh` have displacements.
Index morph_count(const Mesh& mesh);

/// Returns the displacement of each vertex by a morph target: the mean over its corners that have
/// values, zero without any.
std::vector<Vec3> morph_displacements(const Mesh& mesh, const Attribute& attribute);

/// Gives each vertex a displacement. Values of corners keep their differences at a vertex; a
/// missing value stays missing if the displacement is zero.
void set_morph_displacements(const Mesh& mesh, Attribute& attribute,
                             const std::vector<Vec3>& displacements);

/// The displacements of every morph target, by the name of its attribute.
using MorphColumns = std::map<std::string, std::vector<Vec3>>;

/// Returns the map of the displacements of every morph target of `mesh`.
MorphColumns mapped_morphs(const Mesh& mesh, const MorphMap& map);

/// Gives a mesh such displacements. It has the attributes of the mesh that they are from, as
/// `derive` carries them, or is that mesh.
void set_morphs(Mesh& mesh, const MorphColumns& columns);

}  // namespace lissom
