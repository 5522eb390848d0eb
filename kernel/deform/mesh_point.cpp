#include "kernel/deform/mesh_point.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Weights may miss 1 by this much, as those that were printed and read again do.
constexpr double kWeightTolerance = 1e-6;

// Weights below this are rounding.
constexpr double kNoWeight = 1e-14;

bool share_a_face(const Topology& topology, const MeshPoint& point) {
    if (point.vertices.size() == 1) return true;
    const std::span<const Index> faces = topology.faces_around(point.vertices.front());
    return std::any_of(faces.begin(), faces.end(), [&](Index f) {
        const std::span<const Index> corners = topology.face(f);
        return std::all_of(point.vertices.begin(), point.vertices.end(), [&](Index v) {
            return std::find(corners.begin(), corners.end(), v) != corners.end();
        });
    });
}

[[noreturn]] void refuse_point(const MeshPoint& point, const std::string& what) {
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : point.vertices) vertices.add(v);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::invalid_argument, "the point of " + names + " " + what,
                std::move(vertices));
}

}  // namespace

Vec3 MeshPoint::position(const Mesh& mesh) const {
    require_vertices(mesh.topology(), vertices);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < vertices.size(); ++i)
        sum += weights[i] * mesh.position(vertices[i]);
    return sum;
}

MeshPoint vertex_point(Index v) {
    return {{v}, {1.0}};
}

MeshPoint edge_point(Index a, Index b, double t) {
    return {{a, b}, {1.0 - t, t}};
}

MeshPoint face_point(const Topology& topology, Index face, std::span<const double> weights) {
    require_faces(topology, std::span(&face, 1));
    const std::span<const Index> corners = topology.face(face);
    if (weights.size() != corners.size()) {
        throw Error(ErrorCode::invalid_argument,
                    "the face has " + std::to_string(corners.size()) + " corners, but " +
                        std::to_string(weights.size()) + " weights are given; give one a corner",
                    {ElementKind::face, 1, {face}});
    }
    return {{corners.begin(), corners.end()}, {weights.begin(), weights.end()}};
}

MeshPoint mesh_point(const SurfacePoint& point) {
    const auto& w = point.barycentric;
    return {{point.triangle.begin(), point.triangle.end()}, {w[0], w[1], w[2]}};
}

std::vector<MeshPoint> path_points(const Mesh& mesh, const Path& path, const Context& context) {
    std::vector<MeshPoint> points;
    if (path.on_mesh()) {
        require_same_topology(mesh, path.topology(), "the path");
        for (const Index v : path.vertices()) points.push_back(vertex_point(v));
    } else {
        const SpatialTree tree(mesh, context);
        for (const Vec3& p : path.points()) {
            context.checkpoint();
            points.push_back(checked_point(mesh.topology(), mesh_point(tree.nearest(p))));
        }
    }
    std::vector<MeshPoint> different;
    for (MeshPoint& point : points) {
        const bool repeated =
            std::find(different.begin(), different.end(), point) != different.end();
        if (!repeated) different.push_back(std::move(point));
    }
    return different;
}

MeshPoint checked_point(const Topology& topology, const MeshPoint& point) {
    require_vertices(topology, point.vertices);
    if (point.weights.size() != point.vertices.size()) {
        refuse_point(point, "needs one weight a vertex");
    }
    std::map<Index, double> weights;
    double sum = 0.0;
    for (std::size_t i = 0; i < point.vertices.size(); ++i) {
        const double w = point.weights[i];
        if (!(w >= -kWeightTolerance)) refuse_point(point, "has a weight below zero");
        weights[point.vertices[i]] += w;
        sum += w;
    }
    if (!(std::abs(sum - 1.0) <= kWeightTolerance)) {
        refuse_point(point, "has weights that do not sum to 1");
    }
    MeshPoint result;
    double kept = 0.0;
    for (const auto& [v, w] : weights) {
        if (w <= kNoWeight) continue;
        result.vertices.push_back(v);
        result.weights.push_back(w);
        kept += w;
    }
    for (double& w : result.weights) w /= kept;
    if (!share_a_face(topology, result)) refuse_point(point, "lies in no face");
    return result;
}

}  // namespace lissom
