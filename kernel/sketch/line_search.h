/// Lines near a pixel among very many, as strands of hair: one look at every point, without a tree
/// that would have to follow each change.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Points first .. last of a line, both counted from 0 in it.
struct LineRun {
    Index line = 0, first = 0, last = 0;

    bool operator==(const LineRun&) const = default;
};

/// Returns the lines that may be seen nearer to `cursor` than `radius` pixels, across and up or
/// down, in ascending order: all of those that are, and few others. Each has the shortest run with
/// all of its segments that may be. Line i has the points offsets[i] .. offsets[i + 1] - 1 of
/// `points`, x y z of each; lines with a point that is not finite are left out. Errors:
/// invalid_argument for a radius that is negative or not finite; cancelled.
std::vector<LineRun> lines_near(std::span<const float> points, std::span<const Index> offsets,
                                const Affine& to_world, const View& view, const Vec2& cursor,
                                double radius, const Context& context = {});

}  // namespace lissom
