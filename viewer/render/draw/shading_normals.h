/// Normals that a surface is lit with.
#pragma once

#include <span>
#include <vector>

#include "kernel/mesh/topology.h"

namespace lissom {

/// Returns the unit normal of every face: of a polygon that is not plane, its mean. Zero if a face
/// has no area.
std::vector<Vec3> face_normals(const Topology& topology, std::span<const Vec3> positions,
                               const Context& context = {});

/// Returns the unit normal at every corner: the mean of the faces around its vertex, weighted by
/// their angle there (Thuermer and Wuethrich 1998). Faces whose normals differ by more than
/// `crease` radians across an edge are on different sides of a crease there, and each side has a
/// mean of its own. Zero if all faces that count have no area.
std::vector<Vec3> corner_normals(const Topology& topology, std::span<const Vec3> positions,
                                 double crease, const Context& context = {});

}  // namespace lissom
