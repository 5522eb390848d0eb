/// SnapshotBounds: the box around the shown objects. The next picture usually has the
/// same meshes and strands, which are not looked at again.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/geometry.h"
#include "viewer/render/draw/snapshot.h"

namespace lissom::window {

class SnapshotBounds {
  public:
    /// Around all points of the next snapshot that are finite, in the world.
    Box of(const Snapshot& snapshot);

  private:
    // Bounds of one object at its place in the last snapshot.
    struct Known {
        std::weak_ptr<const void> object;
        Affine transform;
        double unit = 1.0;
        Box box;
    };
    template <typename Find>
    void extend(Box& box, Known object, const Find& find);

    std::vector<Known> known_, next_;
};

}  // namespace lissom::window
