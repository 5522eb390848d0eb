#include "kernel/merge/blend/band_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Paths along edges are longer than geodesics, by up to the square root of 2 on a grid; the chart's
// rim, whose coordinates are least certain, lies beyond the band.
constexpr double kChartReach = 1.5;

// Cotangents count as at least this in the harmonic extension, whose values then stay within those
// on the seam.
constexpr double kMinWeight = 0.05;

struct SideFaces {
    std::vector<Index> faces;
    // False if the side goes on beyond them.
    bool whole = true;
};

// The faces of the side that hang together with the seam and have a vertex within `limit`.
SideFaces faces_beside(const Sewn& sewn, std::span<const Index> seam, SeamSide side, double limit,
                       const Context& context) {
    const Mesh& mesh = sewn.mesh;
    const std::vector<double> way = edge_distances(mesh, seam, limit, context);
    std::vector<char> vertex_seen(mesh.vertex_count(), 0);
    std::vector<char> face_seen(mesh.face_count(), 0);
    std::vector<Index> front(seam.begin(), seam.end());
    for (const Index v : front) vertex_seen[v] = 1;
    SideFaces result;
    for (std::size_t next = 0; next < front.size(); ++next) {
        for (const Index f : mesh.topology().faces_around(front[next])) {
            if (sewn.side_of_face[f] != side || std::exchange(face_seen[f], 1)) continue;
            result.faces.push_back(f);
            for (const Index v : mesh.topology().face(f)) {
                const bool near = way[v] <= limit;
                result.whole &= near;
                if (near && !std::exchange(vertex_seen[v], 1)) front.push_back(v);
            }
        }
    }
    return result;
}

// Values at the vertices of `fixed`, extended to all others by the Laplace equation.
std::vector<Vec2> harmonic_extension(const Rings& rings, std::span<const double> cotangent,
                                     std::vector<Vec2> values, std::span<const char> fixed,
                                     const Context& context) {
    std::vector<Index> unknown(values.size(), kNoIndex);
    Index count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!fixed[i]) unknown[i] = count++;
    }
    if (count == 0) return values;
    const std::size_t n = count;
    std::vector<Triplet> entries;
    std::vector<double> b(2 * n, 0.0);
    for (Index i = 0; i < rings.size(); ++i) {
        if (fixed[i]) continue;
        for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
            const Index j = rings.neighbor[e];
            const double weight = std::max(kMinWeight, cotangent[e]);
            entries.push_back({unknown[i], unknown[i], weight});
            if (!fixed[j]) entries.push_back({unknown[i], unknown[j], -weight});
            for (std::size_t k = 0; fixed[j] && k < 2; ++k) {
                b[k * n + unknown[i]] += weight * values[j][k];
            }
        }
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(count, entries);
    SparseSystem system;
    system.analyze(matrix, context);
    system.factor(matrix, context);
    system.solve(b, b, 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!fixed[i]) values[i] = {b[unknown[i]], b[n + unknown[i]]};
    }
    return values;
}

// Fraction of a turn of every vertex of `band`; `on_seam` has that of the seam's.
std::vector<double> angles(const Mesh& band, std::span<const double> on_seam,
                           std::span<const char> fixed, const Context& context) {
    std::vector<Index> faces(band.face_count());
    for (Index f = 0; f < band.face_count(); ++f) faces[f] = f;
    const WeightedTriangles triangles =
        weighted_triangles(band.topology(), band.positions(), faces);
    const Rings rings = build_rings(band.vertex_count(), triangles);
    const RingGeometry geometry = ring_geometry(rings, triangles, band.positions());
    std::vector<Vec2> values(on_seam.size(), Vec2::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double turn = 2.0 * kPi * on_seam[i];
        if (fixed[i]) values[i] = {std::cos(turn), std::sin(turn)};
    }
    values = harmonic_extension(rings, geometry.cotangent, std::move(values), fixed, context);
    std::vector<double> result(on_seam.begin(), on_seam.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double turn = std::atan2(values[i].y(), values[i].x()) / (2.0 * kPi);
        if (!fixed[i]) result[i] = turn < 0.0 ? turn + 1.0 : turn;
    }
    return result;
}

// Times that a loop of the chart's vertices goes around the seam.
double winding(const BandChart& chart, std::span<const Index> loop) {
    double turns = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const double step = chart.angle[loop[(k + 1) % loop.size()]] - chart.angle[loop[k]];
        turns += step - std::round(step);
    }
    return turns;
}

double end_of(const BandChart& chart, const Topology& topology) {
    std::vector<Index> place(topology.vertex_count(), kNoIndex);
    for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
        place[chart.vertex[i]] = index_of(i);
    }
    double end = std::numeric_limits<double>::infinity();
    for (std::vector<Index> loop : topology.boundary_loops()) {
        for (Index& v : loop) v = place[v];
        if (std::find(loop.begin(), loop.end(), kNoIndex) != loop.end()) continue;
        if (std::abs(winding(chart, loop)) < 0.5) continue;
        for (const Index i : loop) end = std::min(end, chart.distance[i]);
    }
    return end;
}

}  // namespace

std::vector<double> loop_fractions(std::span<const Vec3> points) {
    std::vector<double> fraction;
    double length = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        fraction.push_back(length);
        length += (points[(i + 1) % points.size()] - points[i]).norm();
    }
    if (length > 0.0) {
        for (double& f : fraction) f /= length;
    }
    return fraction;
}

BandChart make_band_chart(const Sewn& sewn, std::span<const Index> seam, SeamSide side,
                          double width, const Context& context) {
    const Mesh& mesh = sewn.mesh;
    const SideFaces part = faces_beside(sewn, seam, side, kChartReach * width, context);
    // Attributes stay behind.
    const Mesh shape({mesh.positions().begin(), mesh.positions().end()}, mesh.shared_topology());
    const MeshPart band = extract_faces(shape, part.faces, context);

    std::vector<double> fraction_at(mesh.vertex_count(), -1.0);
    std::vector<Vec3> points;
    for (const Index v : seam) points.push_back(mesh.position(v));
    const std::vector<double> fractions = loop_fractions(points);
    for (std::size_t k = 0; k < seam.size(); ++k) fraction_at[seam[k]] = fractions[k];

    BandChart chart;
    chart.side = side;
    chart.vertex = band.vertex_map;
    std::vector<double> on_seam;
    std::vector<char> fixed;
    std::vector<Index> sources;
    for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
        on_seam.push_back(std::max(0.0, fraction_at[chart.vertex[i]]));
        fixed.push_back(static_cast<char>(fraction_at[chart.vertex[i]] >= 0.0));
        if (fixed.back()) sources.push_back(index_of(i));
    }
    chart.distance = heat_distances(band.mesh, sources, context);
    chart.angle = angles(band.mesh, on_seam, fixed, context);
    chart.triangles = triangulate_faces(band.mesh.topology(), band.mesh.positions()).triangles;
    chart.farthest = part.whole ? *std::max_element(chart.distance.begin(), chart.distance.end())
                                : std::numeric_limits<double>::infinity();
    chart.end = end_of(chart, mesh.topology());
    return chart;
}

}  // namespace lissom
