/// Generated models with features to paste.
#pragma once

#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"

namespace lissom::test {

/// A ball with a bent horn on top.
inline Mesh horned_ball(Index segments = 24) {
    Mesh mesh = make_sphere({1.0, segments, SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) {
        if (p.y() <= 0.0) continue;
        const double rise = std::exp(-14.0 * (p.x() * p.x() + p.z() * p.z()));
        p += Vec3(0.35 * rise * rise, 0.9 * rise, 0.0);
    }
    return mesh;
}
inline Region around_horn(const Mesh& mesh, double radius = 0.9) {
    return select_sphere(mesh, {0, 1.3, 0}, radius);
}

inline Mesh egg(Index segments = 20) {
    Mesh mesh = make_sphere({1.0, segments, SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) p = Vec3(1.4 * p.x(), 2.0 * p.y(), 1.6 * p.z());
    return mesh;
}

/// A plate of 40 by 40 squares of width 0.1 in the plane z = 0, with an arch of square section, 0.4
/// wide, whose feet are around (-0.8, 0, 0) and (0.8, 0, 0).
class ArchedPlate {
  public:
    Mesh build() {
        for (Index y = 0; y <= kCells; ++y) {
            for (Index x = 0; x <= kCells; ++x) {
                positions_.emplace_back(0.1 * x - 2.0, 0.1 * y - 2.0, 0.0);
            }
        }
        for (Index y = 0; y < kCells; ++y) {
            for (Index x = 0; x < kCells; ++x) {
                if (in_foot(x, y) || in_foot(kCells - 1 - x, y)) continue;
                faces_.add(
                    {corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)});
            }
        }
        add_arch();
        const Mesh all(std::move(positions_), std::move(faces_));
        std::vector<Index> faces(at(all.face_count()));
        std::iota(faces.begin(), faces.end(), 0);
        return extract_faces(all, faces).mesh;
    }

  private:
    static constexpr Index kCells = 40, kFirst = 10, kRow = 18, kFoot = 4, kRings = 16;

    static bool in_foot(Index x, Index y) {
        return x >= kFirst && x < kFirst + kFoot && y >= kRow && y < kRow + kFoot;
    }
    static Index corner(Index x, Index y) { return y * (kCells + 1) + x; }

    void add_arch() {
        for (Index k = 0; k < kFoot; ++k) {
            const Index x = kFirst + k, y = kRow + k, far_x = kFirst + kFoot, far_y = kRow + kFoot;
            add_side(corner(x, kRow), corner(x + 1, kRow));
            add_side(corner(far_x, y), corner(far_x, y + 1));
            add_side(corner(x + 1, far_y), corner(x, far_y));
            add_side(corner(kFirst, y + 1), corner(kFirst, y));
        }
    }
    void add_side(Index a, Index b) {
        for (Index ring = 0; ring < kRings; ++ring) {
            faces_.add(
                {on_ring(a, ring), on_ring(b, ring), on_ring(b, ring + 1), on_ring(a, ring + 1)});
        }
    }
    Index on_ring(Index v, Index ring) {
        if (ring == 0) return v;
        if (ring == kRings) return corner(kCells - v % (kCells + 1), v / (kCells + 1));
        const auto [place, is_new] = ring_vertex_.try_emplace({v, ring}, count_of(positions_));
        if (is_new) {
            const Vec3 foot = positions_[at(v)];
            const double angle = kPi * ring / kRings;
            positions_.emplace_back(std::cos(angle) * foot.x(), foot.y(),
                                    -std::sin(angle) * foot.x());
        }
        return place->second;
    }

    std::vector<Vec3> positions_;
    FaceList faces_;
    std::map<std::pair<Index, Index>, Index> ring_vertex_;
};
inline Mesh arched_plate() {
    return ArchedPlate().build();
}

/// The arch, and the plate around each foot within 0.5 of its middle.
inline Region around_arch(const Mesh& plate) {
    std::vector<Index> inside;
    for (Index v = 0; v < plate.vertex_count(); ++v) {
        const Vec3& p = plate.position(v);
        const double from_foot = std::hypot(std::abs(p.x()) - 0.8, p.y());
        if (p.z() > 1e-9 || from_foot < 0.5) inside.push_back(v);
    }
    return {plate.shared_topology(), inside};
}

inline Paste horn_on_egg(const Mesh& horn, const Mesh& target, const PastePlacement& placement,
                         const PasteOptions& options = {}) {
    return Paste(horn, target, around_horn(horn), std::nullopt, std::nullopt, placement, options);
}

}  // namespace lissom::test
