/// Closed lines of the plane as contours of meshes that are laid out there; private to
/// kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Whether a closed line crosses itself.
bool crosses_itself(std::span<const Vec2> line);

/// For each point whether a closed line runs around it.
std::vector<char> lie_inside(std::span<const Vec2> points, std::span<const Vec2> line);

/// Writes a value for every one of `vertices`, which lie at `uv`: above 0 inside the line, and the
/// distance to the line wherever a neighbour lies on its other side. Others count as outside, so
/// `value`, one for every vertex of the topology, is to hold values below 0 for them, or above 0.
/// Then leaves one connected set inside and no islands in it: specks that a coarse mesh cannot show
/// change their sign. Returns false if no vertex is inside.
bool set_line_values(const Topology& topology, std::span<const Index> vertices,
                     std::span<const Vec2> uv, std::span<const Vec2> line,
                     std::vector<double>& value);

}  // namespace lissom
