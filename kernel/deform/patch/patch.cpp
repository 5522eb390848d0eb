#include "kernel/deform/patch/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace lissom {
namespace {

// A quad with a corner flatter than this, relative to its area, counts as not convex.
constexpr double kConvexRatio = 1e-3;

// A triangle has no area if its height is below this fraction of its longest edge.
constexpr double kZeroAreaRatio = 1e-12;

// Faces around the vertices within `rings` rings of the region, ascending.
std::vector<Index> faces_within(const Topology& topology, const Region& region, Index rings) {
    std::vector<char> vertex_seen(topology.vertex_count(), 0);
    std::vector<char> face_seen(topology.face_count(), 0);
    std::vector<Index> front = region.vertices(), next, faces;
    for (const Index v : front) vertex_seen[v] = 1;
    for (Index ring = 0; ring <= rings; ++ring) {
        next.clear();
        for (const Index v : front) {
            for (const Index f : topology.faces_around(v)) {
                if (std::exchange(face_seen[f], 1)) continue;
                faces.push_back(f);
                for (const Index u : topology.face(f)) {
                    if (!std::exchange(vertex_seen[u], 1)) next.push_back(u);
                }
            }
        }
        front.swap(next);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// Vertices of the faces and of the region (which may have vertices without faces), ascending.
std::vector<Index> vertices_of(const Topology& topology, const std::vector<Index>& faces,
                               const Region& region) {
    std::vector<char> seen(topology.vertex_count(), 0);
    for (const Index v : region.vertices()) seen[v] = 1;
    for (const Index f : faces) {
        for (const Index v : topology.face(f)) seen[v] = 1;
    }
    std::vector<Index> vertices;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (seen[v]) vertices.push_back(v);
    }
    return vertices;
}

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return (b - a).cross(c - a).norm() > kZeroAreaRatio * longest;
}

void find_zero_areas(Patch& patch) {
    std::vector<char> has(patch.real_count, 0);
    std::vector<char> has_face(patch.real_count, 0);
    for (const Triangle& t : patch.triangles.triangle) {
        const bool positive = has_area(patch.rest[t[0]], patch.rest[t[1]], patch.rest[t[2]]);
        patch.zero_area_faces += positive ? 0 : 1;
        for (const Index v : t) {
            has_face[v] = 1;
            has[v] |= positive;
        }
    }
    for (const Index v : patch.of_region) {
        if (has_face[v] && !has[v]) patch.zero_area_vertices.add(patch.mesh_vertex[v]);
    }
}

// Convex seen along its normal, with room to spare for both diagonals.
bool is_convex_quad(std::span<const Vec3> positions, std::span<const Index> face) {
    const Vec3 &a = positions[face[0]], &b = positions[face[1]];
    const Vec3 &c = positions[face[2]], &d = positions[face[3]];
    const Vec3 normal = (c - a).cross(d - b);
    const double least = kConvexRatio * normal.squaredNorm();
    const auto turns_left = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
        return (q - p).cross(r - p).dot(normal) > least;
    };
    return turns_left(a, b, c) && turns_left(b, c, d) && turns_left(c, d, a) && turns_left(d, a, b);
}

// Splits triangles at edges of real vertices that were named before.
class EdgeSplitter {
  public:
    explicit EdgeSplitter(WeightedTriangles& triangles) : triangles_(triangles) {}

    void name(Index a, Index b) { around_[std::minmax(a, b)]; }

    // To be called when all edges are named.
    void find_triangles() {
        if (around_.empty()) return;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const Triangle& t = triangles_.triangle[i];
            for (int k = 0; k < 3; ++k) {
                if (auto* list = named(t[k], t[(k + 1) % 3])) list->push_back(i);
            }
        }
    }

    // Splits all triangles at the edge (a, b) at the vertex `middle`; false if there are none.
    bool split(Index a, Index b, Index middle) {
        const std::vector<std::size_t> there = std::exchange(*named(a, b), {});
        for (const std::size_t i : there) {
            Triangle& first = triangles_.triangle[i];
            Triangle second = first;
            *std::find(first.begin(), first.end(), a) = middle;
            *std::find(second.begin(), second.end(), b) = middle;
            for (const Index c : second) {
                if (c == a || c == middle) continue;
                if (auto* list = named(a, c)) {
                    std::erase(*list, i);
                    list->push_back(triangles_.size());
                }
            }
            triangles_.add(second, triangles_.weight[i], triangles_.face[i]);
        }
        return !there.empty();
    }

  private:
    std::vector<std::size_t>* named(Index a, Index b) {
        const auto found = around_.find(std::minmax(a, b));
        return found == around_.end() ? nullptr : &found->second;
    }

    WeightedTriangles& triangles_;
    // The triangles at each edge, ascending.
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> around_;
};

// The vertex of the region nearest to the mean of all. Positions relative to a vertex are exact
// for large coordinates, so that a mesh far from the origin of its coordinates has the same patch
// as one that was brought back.
Index middle_vertex(std::span<const Vec3> positions, const Region& region) {
    const Vec3& first = positions[region.vertices().front()];
    Vec3 mean = Vec3::Zero();
    for (const Index v : region.vertices()) mean += (positions[v] - first) / region.size();
    const auto distance = [&](Index v) { return (positions[v] - first - mean).squaredNorm(); };
    Index middle = region.vertices().front();
    for (const Index v : region.vertices()) {
        if (distance(v) < distance(middle)) middle = v;
    }
    return middle;
}

}  // namespace

Index Rings::entry(Index i, Index j) const {
    const auto first = neighbor.begin() + begin[i], last = neighbor.begin() + begin[i + 1];
    return index_of(std::lower_bound(first, last, j) - neighbor.begin());
}

WeightedTriangles weighted_triangles(const Topology& topology, std::span<const Vec3> positions,
                                     std::span<const Index> faces) {
    WeightedTriangles result;
    std::vector<Index> other;
    for (const Index f : faces) {
        const std::span<const Index> face = topology.face(f);
        if (face.size() != 4 || !is_convex_quad(positions, face)) {
            other.push_back(f);
            continue;
        }
        for (int k = 0; k < 4; ++k) {
            result.add({face[k], face[(k + 1) % 4], face[(k + 2) % 4]}, 0.5, f);
        }
    }
    const Triangulation rest = triangulate_faces(topology, positions, other);
    for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
        result.add(rest.triangles[t], 1.0, rest.face[t]);
    }
    return result;
}

Rings build_rings(Index vertex_count, const WeightedTriangles& triangles) {
    // Every triangle offers both its edges at a vertex; repeats go after sorting each ring.
    std::vector<Index> begin(at(vertex_count) + 1, 0);
    for (const Triangle& t : triangles.triangle) {
        for (const Index v : t) begin[v + 1] += 2;
    }
    for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
    std::vector<Index> offered(begin.back());
    std::vector<Index> fill(begin.begin(), begin.end() - 1);
    for (const Triangle& t : triangles.triangle) {
        for (int k = 0; k < 3; ++k) {
            offered[fill[t[k]]++] = t[(k + 1) % 3];
            offered[fill[t[k]]++] = t[(k + 2) % 3];
        }
    }
    Rings rings;
    rings.begin.reserve(begin.size());
    rings.begin.push_back(0);
    rings.neighbor.reserve(offered.size() / 2 + offered.size() / 16);
    for (Index v = 0; v < vertex_count; ++v) {
        const auto first = offered.begin() + begin[v], last = offered.begin() + begin[v + 1];
        std::sort(first, last);
        rings.neighbor.insert(rings.neighbor.end(), first, std::unique(first, last));
        rings.begin.push_back(count_of(rings.neighbor));
    }
    return rings;
}

// Splits the edge opposite each boundary vertex of valence 2 in the region. One split may serve the
// vertices on both sides.
void insert_virtual_vertices(Patch& patch) {
    const std::size_t real = patch.real_count;
    patch.rest.resize(real);
    patch.in_region.resize(real);
    patch.on_boundary.resize(real);
    patch.vertex_count = patch.real_count;
    patch.split_triangles = patch.triangles;
    patch.surface_count = patch.vertex_count;
    patch.normal_points.clear();
    const auto may_be_lonely = [&](Index v) { return patch.in_region[v] && patch.on_boundary[v]; };
    bool any = false;
    for (Index v = 0; v < patch.real_count; ++v) any = any || may_be_lonely(v);
    if (!any) return;
    const Rings rings = build_rings(patch.real_count, patch.triangles);
    EdgeSplitter splitter(patch.split_triangles);
    std::vector<Index> lonely;
    for (Index v = 0; v < patch.real_count; ++v) {
        if (!may_be_lonely(v) || rings.count(v) != 2) continue;
        lonely.push_back(v);
        splitter.name(rings.ring(v)[0], rings.ring(v)[1]);
    }
    splitter.find_triangles();
    for (const Index v : lonely) {
        const Index a = rings.ring(v)[0], b = rings.ring(v)[1];
        if (!splitter.split(a, b, patch.vertex_count)) continue;
        ++patch.vertex_count;
        patch.rest.push_back(0.5 * (patch.rest[a] + patch.rest[b]));
        patch.in_region.push_back(1);
        patch.on_boundary.push_back(0);
    }
    patch.surface_count = patch.vertex_count;
}

std::vector<Index> near_order(const Region& region, Index rings) {
    const Topology& topology = *region.topology();
    const std::vector<Index> vertices =
        vertices_of(topology, faces_within(topology, region, rings), region);
    std::vector<char> waiting(topology.vertex_count(), 0);
    for (const Index v : vertices) waiting[v] = 1;
    std::vector<Index> order;
    order.reserve(vertices.size());
    for (const Index start : vertices) {
        if (std::exchange(waiting[start], 0)) order.push_back(start);
        for (std::size_t next = order.size() - 1; next < order.size(); ++next) {
            for (const Index n : topology.neighbors(order[next])) {
                if (std::exchange(waiting[n], 0)) order.push_back(n);
            }
        }
    }
    return order;
}

Patch build_patch(const Region& region, std::span<const Vec3> positions, Index rings,
                  std::vector<Index> order) {
    const Topology& topology = *region.topology();
    const std::vector<Index> faces = faces_within(topology, region, rings);
    Patch patch;
    patch.mesh_vertex = order.empty() ? vertices_of(topology, faces, region) : std::move(order);
    patch.real_count = patch.mesh_count();

    std::vector<Index> local(topology.vertex_count(), kNoIndex);
    for (Index i = 0; i < patch.real_count; ++i) local[patch.mesh_vertex[i]] = i;
    for (const Index v : region.vertices()) patch.of_region.push_back(local[v]);
    patch.origin = positions[middle_vertex(positions, region)];
    patch.in_region.assign(patch.real_count, 0);
    for (const Index v : patch.of_region) patch.in_region[v] = 1;
    for (const Index v : patch.mesh_vertex) {
        patch.on_boundary.push_back(topology.is_boundary(v));
        patch.rest.push_back(positions[v] - patch.origin);
    }
    patch.triangles = weighted_triangles(topology, positions, faces);
    for (Triangle& t : patch.triangles.triangle) t = {local[t[0]], local[t[1]], local[t[2]]};
    find_zero_areas(patch);
    insert_virtual_vertices(patch);
    return patch;
}

}  // namespace lissom
