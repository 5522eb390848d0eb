/// Extinction of light in a drawing with strands, on a grid.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/strands/view_grid.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom {

/// Resolution of the light.
struct LightDetail {
    /// Maximum number of points of the grid.
    double max_points = 2.5e6;
    /// Segments that are looked at; of more, every so many strands stand for all.
    double max_segments = 3e6;
};

/// Light is looked up this many steps of the grid nearer to the light: the grid blurs strands into
/// the air.
inline constexpr float kTowardsLight = 0.9f;

/// Returns a grid around the strands, and so much of the meshes as they may shade; without hair one
/// point.
ViewGrid fit_grid(std::span<const ViewStrands> strands, std::span<const ViewTriangle> triangles,
                  const LightDetail& detail = {});

/// Returns the extinction of the strands at each grid point, per unit of length.
std::vector<float> hair_extinction(const ViewGrid& grid, std::span<const ViewStrands> strands,
                                   const LightDetail& detail = {}, const Context& context = {});
/// Adds that of meshes: a layer below their surface that lets hardly any light through.
void add_mesh_extinction(const ViewGrid& grid, std::vector<float>& extinction,
                         std::span<const ViewTriangle> triangles);
/// Copies that hair_extinction works with at one time.
inline constexpr Index kExtinctionParts = 4;

/// Blend of the scalp with the colour of hair at each grid point, 0 to 1: high if roots are nearly
/// as dense as at most places, and hair covers the skin there: few wide strands as well as many
/// thin ones.
std::vector<float> scalp_tint(const ViewGrid& grid, std::span<const ViewStrands> strands);
/// Returns the linear colour of scalps with hair.
Eigen::Array3f mean_root_color(std::span<const ViewStrands> strands);

/// A direction to the surroundings; not of unit length.
struct AmbientDirection {
    Eigen::Vector3f direction;
    /// Part of the light from all around that comes from there.
    float weight;
};

/// Returns the corners of an icosahedron, turned a little out of the axes; y is up.
std::vector<AmbientDirection> ambient_directions();

}  // namespace lissom
