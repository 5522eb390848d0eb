#include "kernel/merge/blend/relax_faults.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/merge/blend/seam_core.h"
#include "kernel/merge/loop/band_pinch.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

// The angle of a fold, as for the measure of a band (band_quality.cpp).
constexpr double kRelaxFolded = 135.0 * kDegree;
// The band whose thorns count, in radii, as for that measure.
constexpr double kPinchBand = 0.5;
// Steps that make a flap of some faces flat.
constexpr Index kRelaxSteps = 30;
// Rings beside a seam whose faces sewing changes.
constexpr Index kSeamRings = 2;
// More of a band is no place but a shape.
constexpr double kMaxRelaxed = 1.0 / 3.0;

// Marks of the vertices within one radius of a seam.
std::vector<char> band_of_seams(const Sewn& sewn, const Context& context) {
    std::vector<char> near(at(sewn.mesh.vertex_count()), 0);
    for (const std::vector<Index>& seam : sewn.seams) {
        const double radius = loop_radius(sewn.mesh, seam);
        const std::vector<double> distance = edge_distances(sewn.mesh, seam, radius, context);
        for (std::size_t v = 0; v < near.size(); ++v) {
            if (distance[v] <= radius) near[v] = 1;
        }
    }
    return near;
}

double turn_at(const Mesh& mesh, Index a, Index b) {
    const Index left = face_left_of(mesh.topology(), a, b);
    const Index right = face_left_of(mesh.topology(), b, a);
    if (left == kNoIndex || right == kNoIndex) return 0.0;
    const Vec3 n = clear_area_vector(mesh, left), m = clear_area_vector(mesh, right);
    const bool clear = n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0;
    return clear ? angle_between(n, m) : 0.0;
}

void mark_folds(const Mesh& mesh, std::span<const char> near, std::vector<char>& marks) {
    for (Index a = 0; a < mesh.vertex_count(); ++a) {
        if (!near[at(a)]) continue;
        for (const Index b : mesh.topology().neighbors(a)) {
            if (turn_at(mesh, a, b) > kRelaxFolded) marks[at(a)] = marks[at(b)] = 1;
        }
    }
}

void mark_faces(const Mesh& mesh, std::span<const Index> faces, std::span<const char> near,
                std::vector<char>& marks) {
    for (const Index f : faces) {
        for (const Index v : mesh.topology().face(f)) {
            if (near[at(v)]) marks[at(v)] = 1;
        }
    }
}

void mark_pinches(const Sewn& sewn, std::span<const Vec3> rest, std::vector<char>& marks,
                  const Context& context) {
    if (rest.empty()) return;
    for (const std::vector<Index>& seam : sewn.seams) {
        const double reach = kPinchBand * loop_radius(sewn.mesh, seam);
        const std::vector<double> distance = edge_distances(sewn.mesh, seam, reach, context);
        for (const Pinch& pinch : pinches({sewn.mesh, rest, distance, reach})) {
            marks[at(pinch.vertex)] = 1;
        }
    }
}

// Those of `firm` that are more than two rings from the seams, where sewing has changed no face.
std::vector<Index> beyond_seams(const Sewn& sewn, std::span<const Index> firm) {
    const std::vector<Index> ring = seam_rings(sewn.mesh.topology(), sewn.seams, kSeamRings);
    std::vector<Index> result;
    for (const Index v : firm) {
        if (ring[at(v)] == kNoIndex) result.push_back(v);
    }
    return result;
}

// Marks the vertices next to marked ones, `rings` times.
void grow(const Topology& topology, Index rings, std::vector<char>& marks) {
    for (Index i = 0; i < rings; ++i) {
        const std::vector<char> before = marks;
        for (Index v = 0; v < topology.vertex_count(); ++v) {
            if (!before[at(v)]) continue;
            for (const Index n : topology.neighbors(v)) marks[at(n)] = 1;
        }
    }
}

// The marked vertices without `firm` and open boundaries.
std::vector<Index> moving_of(const Topology& topology, std::span<const char> marks,
                             std::span<const Index> firm) {
    std::vector<Index> result;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (!marks[at(v)] || topology.is_boundary(v)) continue;
        if (!std::binary_search(firm.begin(), firm.end(), v)) result.push_back(v);
    }
    return result;
}

}  // namespace

bool relax_faults(Sewn& sewn, const RelaxPlaces& places, Index rings, const Context& context) {
    const std::vector<char> near = band_of_seams(sewn, context);
    std::vector<char> marks(near.size(), 0);
    mark_folds(sewn.mesh, near, marks);
    mark_faces(sewn.mesh, places.crossing, near, marks);
    mark_pinches(sewn, places.rest, marks, context);
    grow(sewn.mesh.topology(), rings, marks);
    const std::vector<Index> moving =
        moving_of(sewn.mesh.topology(), marks, beyond_seams(sewn, places.firm));
    const auto band = static_cast<double>(std::count(near.begin(), near.end(), 1));
    if (moving.empty() || static_cast<double>(moving.size()) > kMaxRelaxed * band) return false;
    SmoothOptions how;
    how.iterations = kRelaxSteps;
    how.region = Region(sewn.mesh.shared_topology(), moving);
    smooth(sewn.mesh, how, context);
    sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    return true;
}

}  // namespace lissom
