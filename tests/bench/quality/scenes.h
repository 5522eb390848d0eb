/// The bar and the armadillo with their handles, and what the handles are asked to do.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom::bench {

/// One request to the moved handle.
struct Move {
    std::string name;
    /// Greatest rotation on the way, in degrees.
    double angle = 0.0;
    /// Where the handle is after the given share of the way, 0 to 1.
    std::function<Affine(double share)> at;

    /// Steps of at most 90 degrees in which a rotation beyond 180 degrees is dragged, and 1 for
    /// others.
    int steps() const { return angle > 180.0 ? static_cast<int>((angle + 89.0) / 90.0) : 1; }
};

/// A triangle mesh with a handle that stays and one that moves.
struct QualityScene {
    std::string name;
    Mesh mesh;
    std::vector<Index> still, moved;
    std::vector<Move> moves;

    std::vector<Index> held() const;
};

/// A bar of 1 x 5 x 1 with 24K vertices, along y; its handles are the end faces with the next two
/// rings of vertices. It is twisted about its axis, bent to an arc of constant length along its
/// middle, and its upper end is moved sideways by two widths.
QualityScene bar_scene();

/// The Stanford armadillo, upright along y and facing +z. Points and heights below are shares of
/// its bounding box, radii shares of the size of its surface.
///
/// The left arm is raised about the shoulder: the left hand moves, all within 0.25 of the point
/// (0.97, 0.83, 0.87); feet, below 0.03, and right hand, about (0.05, 0.86, 0.87), stay.
QualityScene arm_scene(const Mesh& armadillo);

/// The body is twisted and bent about the middle of the box: the head moves, all within 0.25 of the
/// point (0.52, 0.82, 0.75); the feet, below 0.03, stay.
QualityScene body_scene(const Mesh& armadillo);

/// The arm as before, of which only arm and shoulder are free, x > 0.68 and y > 0.55: a small
/// region.
QualityScene small_arm_scene(const Mesh& armadillo);

/// The body as before, of which only the waist is free: everything above 0.66 moves, the legs below
/// 0.35 stay, but for the tail (below 0.28 of the depth, above 0.2).
QualityScene waist_scene(const Mesh& armadillo);

}  // namespace lissom::bench
