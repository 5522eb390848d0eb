#include "kernel/io/gltf/mesh/pool.h"

#include <algorithm>
#include <map>

#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

// A few values are compared one by one; beyond, they are sorted.
constexpr std::size_t kFew = 32;

using Tuple = std::vector<float>;

float as_written(double value) {
    return value == value ? static_cast<float>(value) + 0.0f : 0.0f;
}

// A flag whether there is a value goes before the numbers.
Tuple tuple_at(const std::vector<const Attribute*>& attributes, Index corner) {
    Tuple tuple;
    for (const Attribute* attribute : attributes) {
        for (const double value : attribute->at(corner)) {
            tuple.push_back(value == value ? 1.0f : 0.0f);
            tuple.push_back(as_written(value));
        }
    }
    return tuple;
}

bool same_at(const std::vector<const Attribute*>& attributes, Index a, Index b) {
    return std::all_of(attributes.begin(), attributes.end(), [&](const Attribute* attribute) {
        const std::span<const double> x = attribute->at(a), y = attribute->at(b);
        return std::equal(x.begin(), x.end(), y.begin(), [](double p, double q) {
            return as_written(p) == as_written(q) && (p == p) == (q == q);
        });
    });
}

// Corners sorted by vertex: those of v start at begin[v].
struct CornersByVertex {
    std::vector<Index> begin, corners;
};

CornersByVertex corners_by_vertex(const Topology& topology) {
    const std::vector<Index>& vertices = topology.faces().vertices;
    CornersByVertex sorted;
    sorted.begin.assign(at(topology.vertex_count()) + 1, 0);
    for (const Index v : vertices) ++sorted.begin[at(v) + 1];
    for (std::size_t v = 1; v < sorted.begin.size(); ++v) sorted.begin[v] += sorted.begin[v - 1];
    std::vector<Index> next(sorted.begin.begin(), sorted.begin.end() - 1);
    sorted.corners.resize(vertices.size());
    for (std::size_t c = 0; c < vertices.size(); ++c) {
        sorted.corners[next[vertices[c]]++] = index_of(c);
    }
    return sorted;
}

std::vector<Index> faces_of_corners(const Topology& topology) {
    std::vector<Index> face(topology.corner_count());
    for (Index f = 0; f < topology.face_count(); ++f) {
        std::fill_n(face.begin() + topology.first_corner(f), topology.face(f).size(), f);
    }
    return face;
}

}  // namespace

VertexPools::VertexPools(const Mesh& mesh, const std::vector<Index>& pool_of_face, Index pool_count,
                         const std::vector<const Attribute*>& split_by)
    : pools_(pool_count), vertex_of_corner_(mesh.topology().corner_count(), kNoIndex) {
    const Topology& topology = mesh.topology();
    const CornersByVertex sorted = corners_by_vertex(topology);
    const std::vector<Index> face_of_corner = faces_of_corners(topology);
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        const std::span<const Index> corners(sorted.corners.data() + sorted.begin[v],
                                             sorted.corners.data() + sorted.begin[v + 1]);
        std::map<std::pair<Index, Tuple>, Index> known;
        std::map<Index, std::size_t> first_of_pool;
        for (const Index corner : corners) {
            const Index number = pool_of_face[face_of_corner[corner]];
            VertexPool& pool = pools_[number];
            const std::size_t first = first_of_pool.emplace(number, pool.size()).first->second;
            if (corners.size() <= kFew || split_by.empty()) {
                vertex_of_corner_[corner] = find_or_add(pool, v, corner, first, split_by);
                continue;
            }
            const auto [entry, is_new] =
                known.emplace(std::pair(number, tuple_at(split_by, corner)), count_of(pool));
            if (is_new) {
                pool.vertices.push_back(v);
                pool.corners.push_back(corner);
            }
            vertex_of_corner_[corner] = entry->second;
        }
    }
}

Index VertexPools::find_or_add(VertexPool& pool, Index vertex, Index corner, std::size_t first,
                               const std::vector<const Attribute*>& split_by) {
    for (std::size_t i = first; i < pool.size(); ++i) {
        if (same_at(split_by, pool.corners[i], corner)) return index_of(i);
    }
    pool.vertices.push_back(vertex);
    pool.corners.push_back(corner);
    return count_of(pool) - 1;
}

bool seams_are_ambiguous(const Mesh& mesh, const VertexPools& pools, Index pool_count) {
    for (Index number = 0; number < pool_count; ++number) {
        const std::vector<Index>& vertices = pools.pool(number).vertices;
        ValuePool<3> places;
        Index count = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Index v = vertices[i];
            if (i > 0 && vertices[i - 1] == v) continue;
            const bool has_copies = i + 1 < vertices.size() && vertices[i + 1] == v;
            if (!has_copies && !mesh.topology().is_boundary(v)) continue;
            const Vec3& p = mesh.position(v);
            const Index place =
                places.add({as_written(p.x()), as_written(p.y()), as_written(p.z())});
            if (place < count) return true;
            count = place + 1;
        }
    }
    return false;
}

VertexPool pool_of_points(const Mesh& mesh) {
    VertexPool pool;
    for (Index v = 0; v < mesh.vertex_count(); ++v) pool.vertices.push_back(v);
    pool.corners.assign(pool.vertices.size(), kNoIndex);
    return pool;
}

}  // namespace lissom
