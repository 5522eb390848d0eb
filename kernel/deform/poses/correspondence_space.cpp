#include "kernel/deform/poses/correspondence_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Weights of unit normals, and of places in sizes of the mesh, beside harmonic functions.
constexpr double kNormalWeight = 0.05, kPlaceWeight = 0.05;

// Number of the part of each vertex, or kNoIndex.
std::vector<Index> part_of_vertex(const Mesh& mesh, const std::vector<const Region*>& parts) {
    std::vector<Index> part(at(mesh.vertex_count()), kNoIndex);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        for (const Index v : parts[k]->vertices()) part[at(v)] = index_of(k);
    }
    return part;
}

void require_reached(const Mesh& mesh, const PoseTriangles& triangles,
                     const std::vector<Index>& part) {
    const std::vector<Index>& components = mesh.topology().components();
    std::vector<char> reached(triangles.base.size(), 0);
    for (std::size_t v = 0; v < part.size(); ++v) {
        if (part[v] != kNoIndex) reached[at(components[v])] = 1;
    }
    for (std::size_t v = 0; v < part.size(); ++v) {
        const Index component = components[v];
        if (mesh.topology().is_isolated(index_of(v)) || reached[at(component)] ||
            reached[at(triangles.base[at(component)])]) {
            continue;
        }
        throw Error(ErrorCode::unconstrained,
                    "a component has no part of a pair; give one that lies on it",
                    {ElementKind::vertex, 1, {index_of(v)}});
    }
}

// The harmonic functions at the vertices: one column a part.
std::vector<double> harmonic_functions(const PoseTriangles& triangles,
                                       const std::vector<Index>& part, std::size_t parts,
                                       const Context& context) {
    const std::size_t vertices = part.size();
    std::vector<Index> row(vertices, kNoIndex);
    Index rows = 0;
    // Vertices without a weight are in no row.
    for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
        for (const Index v : triangles.triangles[t]) {
            if (part[at(v)] == kNoIndex && row[at(v)] == kNoIndex) row[at(v)] = rows++;
        }
    }
    std::vector<Triplet> entries;
    std::vector<double> values(at(rows) * parts, 0.0);
    const auto join = [&](Index own, Index other, double weight) {
        const Index r = row[at(own)];
        if (r == kNoIndex) return;
        entries.push_back({r, r, weight});
        if (row[at(other)] != kNoIndex) {
            if (r > row[at(other)]) entries.push_back({r, row[at(other)], -weight});
        } else if (part[at(other)] != kNoIndex) {
            values[at(part[at(other)]) * at(rows) + at(r)] += weight;
        }
    };
    for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangles.triangles[t][k], b = triangles.triangles[t][(k + 1) % 3];
            if (triangles.weight[t][k] == 0.0) continue;
            join(a, b, triangles.weight[t][k]);
            join(b, a, triangles.weight[t][k]);
        }
    }
    if (rows > 0) {
        const SymmetricMatrix matrix = symmetric_from_triplets(rows, entries);
        SparseSystem system;
        system.analyze(matrix, context);
        system.factor(matrix, context);
        system.solve(values, values, index_of(parts));
    }
    std::vector<double> result(vertices * parts, 0.0);
    for (std::size_t v = 0; v < vertices; ++v) {
        for (std::size_t k = 0; k < parts; ++k) {
            result[k * vertices + v] = row[v] != kNoIndex ? values[k * at(rows) + at(row[v])]
                                                          : double(part[v] == index_of(k));
        }
    }
    return result;
}

}  // namespace

PartCoordinates part_coordinates(const Mesh& mesh, const PoseTriangles& triangles,
                                 const std::vector<const Region*>& parts, const Context& context) {
    const std::vector<Index> part = part_of_vertex(mesh, parts);
    require_reached(mesh, triangles, part);
    const std::vector<double> functions =
        harmonic_functions(triangles, part, parts.size(), context);
    const Vec3 center = surface_centroid(mesh);
    const double size = std::max(surface_radius(mesh), std::numeric_limits<double>::min());
    PartCoordinates result{parts.size() + 6, {}};
    for (Index t = 0; t < triangles.surface_count(); ++t) {
        const Triangle& triangle = triangles.triangles[at(t)];
        Vec3 middle = Vec3::Zero();
        for (const Index v : triangle) middle += mesh.position(v) / 3.0;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            double sum = 0.0;
            for (const Index v : triangle) sum += functions[k * part.size() + at(v)];
            result.values.push_back(sum / 3.0);
        }
        const TriangleEdges edges = edges_of(triangle, mesh.positions());
        const Vec3 normal = kNormalWeight * edges.first.cross(edges.second).stableNormalized();
        const Vec3 place = kPlaceWeight / size * (middle - center);
        result.values.insert(result.values.end(), normal.begin(), normal.end());
        result.values.insert(result.values.end(), place.begin(), place.end());
    }
    return result;
}

NearestParts::NearestParts(const PartCoordinates& points)
    : points_(points), order_(at(points.count())), axis_(at(points.count())) {
    std::iota(order_.begin(), order_.end(), 0);
    build(0, points.count());
}

std::size_t NearestParts::widest(Index begin, Index end) const {
    std::size_t best = 0;
    double greatest = -1.0;
    for (std::size_t k = 0; k < points_.width; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (Index i = begin; i < end; ++i) {
            const double value = points_.at(order_[at(i)])[k];
            low = std::min(low, value);
            high = std::max(high, value);
        }
        if (high - low <= greatest) continue;
        greatest = high - low;
        best = k;
    }
    return best;
}

void NearestParts::build(Index begin, Index end) {
    if (end - begin < 1) return;
    const Index middle = begin + (end - begin) / 2;
    const std::size_t axis = widest(begin, end);
    const auto less = [&](Index a, Index b) {
        const double x = points_.at(a)[axis], y = points_.at(b)[axis];
        return x != y ? x < y : a < b;
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, less);
    axis_[at(middle)] = axis;
    build(begin, middle);
    build(middle + 1, end);
}

std::vector<NearestParts::Hit> NearestParts::nearest(std::span<const double> place,
                                                     std::size_t count) const {
    std::vector<Hit> hits;
    search(0, count_of(order_), place, count, hits);
    return hits;
}

// `hits` is a heap, the farthest on top.
void NearestParts::search(Index begin, Index end, std::span<const double> place, std::size_t count,
                          std::vector<Hit>& hits) const {
    if (end - begin < 1) return;
    const Index middle = begin + (end - begin) / 2, point = order_[at(middle)];
    const std::span<const double> own = points_.at(point);
    double squares = 0.0;
    for (std::size_t k = 0; k < points_.width; ++k) {
        squares += (own[k] - place[k]) * (own[k] - place[k]);
    }
    if (hits.size() < count || squares < hits.front().squared_distance) {
        if (hits.size() == count) {
            std::pop_heap(hits.begin(), hits.end());
            hits.pop_back();
        }
        hits.push_back({squares, point});
        std::push_heap(hits.begin(), hits.end());
    }
    const std::size_t axis = axis_[at(middle)];
    const double beside = place[axis] - own[axis];
    const bool is_below = beside < 0.0;
    search(is_below ? begin : middle + 1, is_below ? middle : end, place, count, hits);
    if (hits.size() == count && beside * beside >= hits.front().squared_distance) return;
    search(is_below ? middle + 1 : begin, is_below ? end : middle, place, count, hits);
}

}  // namespace lissom
