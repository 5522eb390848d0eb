/// Selection of vertices and faces by what is drawn over a picture: a rectangle, a lasso, a brush.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/region.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// What is selected where a shape is drawn.
enum class SelectKind {
    /// Vertices that are seen inside.
    vertices,
    /// Faces of which the centroid of a triangle is seen inside, and under a brush those that it
    /// touches; with all their vertices.
    faces
};

struct SelectOptions {
    SelectKind kind = SelectKind::vertices;
    /// Also what surfaces hide.
    bool through = false;
    /// Whether faces count that are seen from behind. If not, they are as if they were not there:
    /// neither selected, nor their vertices, nor hiding anything.
    bool back_faces = true;
    /// Vertices that are known already and not looked at, so that a long stroke costs only what is
    /// new under it: a region for each object of the scene, or null.
    std::span<const Region* const> known = {};
};

/// What is selected of one surface.
struct Selected {
    /// Its number in the scene.
    Index object;
    Region vertices;
    /// The selected faces, ascending; empty if vertices were asked for.
    std::vector<Index> faces;
    /// Vertices inside the shape that are not selected as they are not seen; empty if faces were
    /// asked for. They may be among the known ones as long as neither camera nor surface moves.
    Region unseen;
};

/// What is seen inside a shape, of every surface of the scene in their order. Pixels may lie
/// outside the picture. What is partly behind the camera is selected by what is in front. Errors:
/// not_finite; invalid_argument for a negative radius, a picture without size, or known vertices if
/// faces are selected; topology_mismatch for those of another surface; cancelled.
///
/// The rectangle with two opposite corners `a` and `b`.
std::vector<Selected> select_rectangle(const PickScene& scene, const View& view, const Vec2& a,
                                       const Vec2& b, const SelectOptions& options = {},
                                       const Context& context = {});
/// What the closed outline goes around, in either direction; where it crosses itself, all that it
/// goes around at least once. Fewer than three points enclose nothing.
std::vector<Selected> select_lasso(const PickScene& scene, const View& view,
                                   std::span<const Vec2> outline, const SelectOptions& options = {},
                                   const Context& context = {});

/// A disk that is moved along a polyline; one point is a dab.
struct Brush {
    std::span<const Vec2> stroke;
    /// Pixels.
    double radius = 20.0;
};
std::vector<Selected> select_brush(const PickScene& scene, const View& view, const Brush& brush,
                                   const SelectOptions& options = {}, const Context& context = {});

}  // namespace lissom
