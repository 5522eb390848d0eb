/// Attributes that are directions (normals, tangents and offsets of morph targets) while the shape
/// under them changes.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// True for attributes whose values turn when the surface turns.
bool is_direction(const Attribute& attribute);

/// Turns the directions of a mesh with its surface. Make it before the change of positions, call
/// `follow` after: each value is rotated as the vertex's normal was, by the smallest rotation.
/// Displacements of morph targets stay: mapped_morphs (morph_maps.h) gives them the change's own
/// map. Costs nothing if there is no such attribute.
class DirectionCarrier {
  public:
    explicit DirectionCarrier(const Mesh& mesh);
    void follow(Mesh& mesh) const;

  private:
    std::vector<Vec3> before_;
};

/// Applies the linear map of positions to directions: offsets of morph targets to positions follow
/// it, tangents keep their length, normals stay at right angles to the surface. `linear` must not
/// be singular.
void map_directions(AttributeSet& attributes, const Mat3& linear);

/// Turns every custom normal the other way.
void negate_normals(AttributeSet& attributes);

}  // namespace lissom
