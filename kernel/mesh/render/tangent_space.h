/// Tangent spaces by the rule of MikkTSpace, which tools bake normal maps for: M. S. Mikkelsen,
/// Simulation of Wrinkled Surfaces Revisited (2008), section 3.3.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

struct Tangent {
    /// Unit vector along the first texture coordinate, at right angles to the normal.
    Vec3 direction = Vec3::UnitX();
    /// The bitangent is `sign` times the cross product of normal and direction.
    double sign = -1.0;
};

/// Vertices of one place, one normal and one pair of texture coordinates count as the same.
struct TangentInput {
    std::span<const Vec3> positions, normals;
    std::span<const Vec2> uvs;
    std::span<const Triangle> triangles;
};

/// Returns three tangents a triangle, one for each of its corners. Triangles whose texture
/// coordinates have no area take the tangents of their neighbours; corners without any neighbour
/// get the default.
std::vector<Tangent> corner_tangents(const TangentInput& input);

}  // namespace lissom
