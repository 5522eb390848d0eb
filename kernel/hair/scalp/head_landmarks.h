/// Eyes and the greatest opening of a head; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/head_frame.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A candidate for an eye: an opening of the head or a component beside it.
struct Spot {
    Vec3 center = Vec3::Zero();
    /// Mean distance of its points from the center.
    double radius = 0.0;
};

/// Two spots of about one size, as far apart as eyes are.
struct EyePair {
    Spot one, other;
};

struct Landmarks {
    std::vector<EyePair> pairs;
    /// From the greatest opening to the surface, of length 1; zero if it is small or absent.
    Vec3 from_opening = Vec3::Zero();
    /// Its length over the root of the surface's area: a neck has 1 to 2, the rim of a mask more.
    double opening = 0.0;
};

/// `part`: the vertices of the component that counts; `part_area`: of its faces.
Landmarks landmarks_of(const Mesh& mesh, const std::vector<Index>& part, double part_area);

/// Returns whether two spots lie in a frame as eyes do.
bool are_eyes(const EyePair& pair, const HeadFrame& frame);

}  // namespace lissom
