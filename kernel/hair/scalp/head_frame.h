/// Place, orientation and size of a head, guessed from its bald shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A frame on a head. Width and length are those of the horizontal slice with a depth below the top
/// of half its width: it lies above the ears of any head, for any unit.
struct HeadFrame {
    /// On the axis of the slice, 0.65 widths below the top: about the middle between the ears.
    Vec3 center = Vec3::Zero();
    /// Columns: the head's left (+x), up (+y) and front (+z), orthonormal.
    Mat3 axes = Mat3::Identity();
    /// Width and length of the slice, in the mesh's unit.
    double width = 0.0, length = 0.0;
    /// Deviation of the shape from a head: the mean distance of the head to its mirror image and
    /// of the slice to an ellipse, as fractions of the width. Heads have less than 0.05 of each.
    double asymmetry = 0.0, roughness = 0.0;
    /// Excess of the face's reach forward over the neck's backward, as a fraction of the
    /// length: positive for heads, about 0 if front and back are alike.
    double forwardness = 0.0;
    /// Share of the directions above the center that the surface lies in: 1 for a whole head.
    double coverage = 0.0;
    /// Confidence of the guess, 0 to 1: near 1 for the shape of a whole head without another
    /// direction that fits nearly as well, 0 for masks, halves of heads and other shapes.
    /// Directions that were given are not doubted.
    double confidence = 0.0;
    /// Main reason of a low confidence, as words that follow "because"; empty if there is none.
    std::string doubt = {};

    Vec3 left() const { return axes.col(0); }
    Vec3 up() const { return axes.col(1); }
    Vec3 front() const { return axes.col(2); }
    /// A point or direction of the mesh in the frame, in the mesh's unit, and back.
    Vec3 local(const Vec3& point) const { return axes.transpose() * (point - center); }
    Vec3 world(const Vec3& local) const { return center + axes * local; }
};

/// Known properties of a head. Directions need not have unit length; front is made upright to up.
struct HeadHints {
    std::optional<Vec3> up = std::nullopt, front = std::nullopt;
};

/// Guesses the frame of a bald head, bust or body. Tries the directions along the mesh's axes and
/// takes the ones that make the top of the head round, its halves alike and the face look forward;
/// of equally good ones those nearest to up = +y, front = +z. Only the component with the largest
/// area counts. If the head has them, these count as well: its eyes, two openings or further
/// components that are alike and lie as eyes do, also if the line through them is along no axis;
/// its greatest opening, which is the neck or, around a mask, looks away from the face. Errors:
/// mesh_empty without faces; invalid_argument for hints without length or parallel, and if no
/// direction has a slice as wide as twice its depth; not_finite for hints; cancelled.
HeadFrame guess_head_frame(const Mesh& mesh, const HeadHints& hints = {},
                           const Context& context = {});

/// Vertices and faces of the component of `mesh` that has the largest area.
std::vector<Index> largest_component(const Mesh& mesh);

}  // namespace lissom
