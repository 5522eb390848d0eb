/// Polyline: a free curve of a scene.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A curve through points in space, for instance a drawn stroke or a guide.
struct Polyline {
    std::vector<Vec3> points;
    /// The last point is joined to the first.
    bool closed = false;

    bool operator==(const Polyline&) const = default;
};

}  // namespace lissom
