/// Navigation: how a camera is moved by hand. Every function takes a view and returns the camera
/// after the move; nothing is remembered in between, so that a drag is replayed from its beginning.
/// The camera moves about its target, which lies at the depth of the object looked at.
#pragma once

#include "kernel/core/geometry.h"
#include "kernel/sketch/camera.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Turns the camera about its target as a turntable does: a drag to the right across the height of
/// the picture turns it by half a turn about the camera's up, a drag down by half a turn over the
/// top, stopping a thousandth of a degree short of `up`. Errors: not_finite.
Camera orbited(const View& view, const Vec2& drag);

/// Moves the camera beside itself so that points at the depth of the target follow the cursor.
/// Errors: not_finite.
Camera panned(const View& view, const Vec2& drag);

/// Comes nearer by `factor` (2: half the distance, or half the height that a camera without
/// perspective sees) and keeps the point under the cursor, at the depth of the target, there.
/// Distances stay between 1e-6 and 1e6 times `size`, the size of the object looked at. Errors:
/// invalid_argument for a factor or a size that is not above 0; not_finite.
Camera zoomed(const View& view, const Vec2& cursor, double factor, double size);

/// Returns the camera with or without perspective that shows as much at the depth of the target.
/// With perspective, `fov` is its opening angle.
Camera with_perspective(const Camera& camera, double fov = kPi / 6.0);
Camera without_perspective(const Camera& camera);

/// Returns the camera that looks as `camera` does, in direction, turn and perspective, and frames
/// `box`, as large as the margin allows for all of its corners. Errors: invalid_argument for an
/// empty box.
Camera framed(const View& view, const Box& box, double margin = 0.06);

}  // namespace lissom
