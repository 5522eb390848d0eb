#include "kernel/hair/field/closed_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

namespace lissom {
namespace {

bool before(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

using Edge = std::pair<Index, Index>;

// The edges of open boundaries, each in the direction of its face, with one vertex standing for all
// at its place.
std::vector<Edge> boundary_edges(const Mesh& mesh) {
    std::vector<Index> vertices;
    for (const auto& loop : mesh.topology().boundary_loops()) {
        vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    std::sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
        if (before(mesh.position(a), mesh.position(b))) return true;
        return mesh.position(a) == mesh.position(b) && a < b;
    });
    std::map<Index, Index> standing;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const bool same = i > 0 && mesh.position(vertices[i]) == mesh.position(vertices[i - 1]);
        standing[vertices[i]] = same ? standing[vertices[i - 1]] : vertices[i];
    }
    std::vector<Edge> edges;
    for (const auto& loop : mesh.topology().boundary_loops()) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index a = standing[loop[i]], b = standing[loop[(i + 1) % loop.size()]];
            if (a != b) edges.emplace_back(a, b);
        }
    }
    return edges;
}

// The edges that no other edge runs back along.
std::vector<Edge> without_seams(const std::vector<Edge>& edges) {
    std::map<Edge, Index> balance;
    for (const auto& [a, b] : edges) {
        ++balance[{a, b}];
        --balance[{b, a}];
    }
    std::vector<Edge> open;
    for (const auto& [edge, count] : balance) open.insert(open.end(), std::max(0, count), edge);
    return open;
}

// Returns the hole of each edge, as the smallest vertex connected by its edges.
std::vector<Index> holes_of(const std::vector<Edge>& edges) {
    std::map<Index, Index> parent;
    for (const auto& [a, b] : edges) parent[a] = a, parent[b] = b;
    const auto root = [&](Index v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const auto& [a, b] : edges) {
        const Index low = std::min(root(a), root(b));
        parent[std::max(root(a), root(b))] = low;
    }
    std::vector<Index> holes;
    for (const auto& [a, b] : edges) holes.push_back(root(a));
    return holes;
}

void add_caps(const Mesh& mesh, ClosedSurface& surface) {
    const std::vector<Edge> edges = without_seams(boundary_edges(mesh));
    const std::vector<Index> holes = holes_of(edges);
    struct Rim {
        Vec3 sum = Vec3::Zero();
        double length = 0.0;
        Index center = kNoIndex;
    };
    std::map<Index, Rim> rims;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const Vec3 &a = mesh.position(edges[e].first), &b = mesh.position(edges[e].second);
        Rim& rim = rims[holes[e]];
        rim.sum += 0.5 * (a - b).norm() * (a + b);
        rim.length += (a - b).norm();
    }
    for (auto& [hole, rim] : rims) {
        rim.center = count_of(surface.positions);
        surface.positions.emplace_back(rim.length > 0.0 ? Vec3(rim.sum / rim.length)
                                                        : mesh.position(hole));
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
        surface.triangles.push_back({edges[e].second, edges[e].first, rims.at(holes[e]).center});
    }
}

double enclosed_volume(const ClosedSurface& surface) {
    const Vec3& o = surface.positions[surface.triangles.front()[0]];
    double sum = 0.0;
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 u = surface.positions[a] - o, v = surface.positions[b] - o;
        sum += u.cross(v).dot(surface.positions[c] - o) / 6.0;
    }
    return sum;
}

}  // namespace

ClosedSurface close_surface(const Mesh& mesh) {
    if (mesh.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "the head has no faces");
    }
    ClosedSurface surface;
    surface.positions.assign(mesh.positions().begin(), mesh.positions().end());
    surface.triangles = triangulate_faces(mesh.topology(), mesh.positions()).triangles;
    surface.first_cap = surface.triangles.size();
    add_caps(mesh, surface);
    surface.volume = enclosed_volume(surface);
    return surface;
}

}  // namespace lissom
