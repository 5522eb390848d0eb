/// The hairline and how far inside it the vertices of a head are; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/scalp/head_frame.h"
#include "kernel/hair/scalp/skull_over_ears.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/shapes/hairline.h"

namespace lissom {

/// Data for testing a vertex against a hairline.
struct HairlineTest {
    const HeadFrame& frame;
    const std::vector<HairlinePoint>& hairline;
    /// Width of the band in which hair thins out, in the mesh's unit; 0 is a sharp line.
    double softness = 0.0;
    SkullOverEars skull = {};

    /// Returns whether a vertex of this margin lies above the hairline.
    static bool inside(double margin);
    /// Returns whether a margin is that of a vertex on which no hair grows wherever the hairline
    /// is.
    static bool bald(double margin);
    /// Distance of a point of the head above the hairline in units of the softness.
    double margin_at(const Vec3& point) const;
};

/// Errors: invalid_argument without points, for azimuths that do not ascend within [0, pi], or
/// elevations outside [-pi / 2, pi / 2].
void require_hairline(const std::vector<HairlinePoint>& hairline);

/// For each vertex its distance above the hairline in units of the softness, -1000 to 1000 (as
/// Scalp::margins). Ears, the neck and shoulders, faces towards the center of the head and parts
/// not connected to its top count as outside.
std::vector<double> margins_of_hairline(const Mesh& head, const std::vector<Vec3>& normals,
                                        const HairlineTest& test);

/// Returns the same by the distance along edges from the vertices of `region` at its outline, which
/// are at 0; open boundaries of the mesh are no outline.
std::vector<double> margins_of_region(const Mesh& head, const Region& region, double softness);

}  // namespace lissom
