/// Snapshot: the drawn state of a scene at one time. Objects that it refers to may not change while
/// somebody holds it, so that one thread can draw a snapshot made by another; changed content is
/// another object in the next snapshot.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "viewer/render/draw/drawing.h"

namespace lissom {

struct Snapshot {
    std::vector<DrawnMesh> meshes = {};
    std::vector<DrawnStrands> strands = {};
    /// Drawn in this order. Unchanged meshes are the same objects as before.
    std::vector<std::shared_ptr<const Overlay>> overlays = {};
    /// The scale for the values of all meshes.
    ValueRange range = {};
    /// Two snapshots of a scene with the same revision are equal. 0: not known, so that they are
    /// compared.
    std::uint64_t revision = 0;
};

/// Calls `visit` with every point of meshes and overlays in the camera's world.
template <typename Visit>
void for_each_point(const Snapshot& snapshot, const Visit& visit) {
    for (const DrawnMesh& drawn : snapshot.meshes) {
        for (const Vec3& p : drawn.mesh->positions()) visit(drawn.transform(p));
    }
    for (const auto& overlay : snapshot.overlays) {
        for (const DrawnLine& line : overlay->lines) {
            for (const Vec3& p : line.points) visit(p);
        }
        for (const DrawnPoint& point : overlay->points) visit(point.position);
    }
}

}  // namespace lissom
