#include "kernel/mesh/query/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/mesh/measure/directions.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/query/path_smooth.h"
#include "kernel/mesh/query/shortest_path.h"

namespace lissom {
namespace {

void require_enough(std::size_t count, bool closed) {
    const std::size_t least = closed ? 3 : 2;
    if (count >= least) return;
    throw Error(ErrorCode::invalid_argument,
                std::string(closed ? "a closed path needs at least 3" : "a path needs at least 2") +
                    " points; " + std::to_string(count) + " were given");
}

void require_different_neighbors(std::span<const Index> vertices, bool closed) {
    const std::size_t n = vertices.size();
    for (std::size_t i = closed ? 0 : 1; i < n; ++i) {
        const Index v = vertices[i];
        if (v != vertices[(i + n - 1) % n]) continue;
        throw Error(ErrorCode::invalid_argument,
                    "a path stays at vertex " + std::to_string(v) + "; remove the repetition",
                    {ElementKind::vertex, 1, {v}});
    }
}

void require_finite_points(std::span<const Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].allFinite()) continue;
        throw Error(ErrorCode::not_finite,
                    "point " + std::to_string(i) + " of the path is NaN or infinite");
    }
}

double polyline_length(std::span<const Vec3> points, bool closed) {
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return closed ? length + (points.front() - points.back()).norm() : length;
}

PathPoint polyline_nearest(std::span<const Vec3> points, bool closed, const Vec3& p) {
    if (!p.allFinite()) throw Error(ErrorCode::not_finite, "the point is NaN or infinite");
    PathPoint best;
    best.distance = std::numeric_limits<double>::infinity();
    double before = 0.0, at = 0.0;
    const std::size_t segments = closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < segments; ++i) {
        const Vec3& a = points[i];
        const Vec3 along = points[(i + 1) % points.size()] - a;
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
        const Vec3 candidate = a + t * along;
        const double distance = (p - candidate).norm();
        if (distance < best.distance) {
            best = {0.0, index_of(i), candidate, distance};
            at = before + t * std::sqrt(square);
        }
        before += std::sqrt(square);
    }
    best.parameter = before > 0.0 ? std::min(1.0, at / before) : 0.0;
    return best;
}

void smooth_polyline(std::vector<Vec3>& points, bool closed, Index iterations, double strength,
                     const Context& context) {
    if (iterations < 0 || !(strength >= 0.0 && strength <= 1.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "smoothing a path needs iterations of 0 or more and a strength from 0 to 1");
    }
    constexpr Index kIterationsPerReport = 1024;
    Progress progress(context, "smooth path");
    const std::size_t n = points.size();
    std::vector<Vec3> next = points;
    for (Index iteration = 0; iteration < iterations; ++iteration) {
        context.checkpoint();
        if (iteration % kIterationsPerReport == 0) progress.update(iteration, iterations);
        for (std::size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
            const Vec3 middle = 0.5 * (points[(i + n - 1) % n] + points[(i + 1) % n]);
            next[i] = points[i] + strength * (middle - points[i]);
        }
        points = next;
    }
}

}  // namespace

Path::Path(std::shared_ptr<const Topology> topology, std::vector<Index> vertices, bool closed)
    : topology_(std::move(topology)), vertices_(std::move(vertices)), closed_(closed) {
    require_vertices(*topology_, vertices_);
    require_enough(vertices_.size(), closed_);
    require_different_neighbors(vertices_, closed_);
}

Path::Path(std::vector<Vec3> points, bool closed) : points_(std::move(points)), closed_(closed) {
    require_enough(points_.size(), closed_);
    require_finite_points(points_);
}

Index Path::size() const {
    return index_of(on_mesh() ? vertices_.size() : points_.size());
}

bool Path::follows_edges() const {
    if (!on_mesh()) return false;
    for (Index i = 0; i < segment_count(); ++i) {
        const std::span<const Index> ring = topology_->neighbors(vertices_[i]);
        const Index next = vertices_[(i + 1) % size()];
        if (std::find(ring.begin(), ring.end(), next) == ring.end()) return false;
    }
    return true;
}

bool Path::is_boundary() const {
    if (!on_mesh() || !closed_) return false;
    const auto canonical = [](std::vector<Index> loop) {
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        return loop;
    };
    const std::vector<Index> forward = canonical(vertices_);
    const std::vector<Index> backward = canonical({vertices_.rbegin(), vertices_.rend()});
    const auto& loops = topology_->boundary_loops();
    return std::any_of(loops.begin(), loops.end(), [&](const std::vector<Index>& loop) {
        return loop == forward || loop == backward;
    });
}

std::vector<Vec3> Path::points(const Mesh& mesh) const {
    if (!on_mesh()) return points_;
    require_same_topology(mesh, topology_, "the path");
    std::vector<Vec3> points;
    points.reserve(vertices_.size());
    for (const Index v : vertices_) points.push_back(mesh.position(v));
    return points;
}

const std::vector<Vec3>& Path::points() const {
    if (on_mesh()) {
        throw Error(ErrorCode::invalid_argument,
                    "the path runs through vertices of a mesh; give the mesh too");
    }
    return points_;
}

double Path::length(const Mesh& mesh) const {
    return polyline_length(points(mesh), closed_);
}

double Path::length() const {
    return polyline_length(points(), closed_);
}

PathPoint Path::nearest(const Mesh& mesh, const Vec3& p) const {
    return polyline_nearest(points(mesh), closed_, p);
}

PathPoint Path::nearest(const Vec3& p) const {
    return polyline_nearest(points(), closed_, p);
}

Path Path::reversed() const {
    Path path = *this;
    const std::ptrdiff_t kept = closed_ ? 1 : 0;
    if (on_mesh()) {
        std::reverse(path.vertices_.begin() + kept, path.vertices_.end());
    } else {
        std::reverse(path.points_.begin() + kept, path.points_.end());
    }
    return path;
}

std::vector<Path> boundaries(const Mesh& mesh) {
    std::vector<Path> paths;
    for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
        paths.emplace_back(mesh.shared_topology(), loop, true);
    }
    return paths;
}

Path boundary(const Mesh& mesh) {
    std::vector<Path> all = boundaries(mesh);
    if (all.empty())
        throw Error(ErrorCode::not_a_boundary, "the mesh is closed: it has no boundary");
    if (all.size() > 1) {
        throw Error(ErrorCode::boundary_conflict, "the mesh has " + std::to_string(all.size()) +
                                                      " boundaries; take one of boundaries(mesh)");
    }
    return std::move(all.front());
}

std::vector<Path> boundaries(const Region& region) {
    std::vector<Path> paths;
    for (std::vector<Index>& loop : region.boundaries()) {
        paths.emplace_back(region.topology(), std::move(loop), true);
    }
    return paths;
}

Path path_through(const Mesh& mesh, std::span<const Index> vertices, bool closed,
                  const Context& context) {
    require_vertices(mesh.topology(), vertices);
    if (vertices.size() < 2) {
        throw Error(ErrorCode::invalid_argument, "a path needs at least 2 vertices to go through");
    }
    require_different_neighbors(vertices, closed);
    ShortestPaths search(mesh);
    std::vector<Index> path{vertices[0]};
    const std::size_t legs = closed ? vertices.size() : vertices.size() - 1;
    for (std::size_t i = 0; i < legs; ++i) {
        const std::vector<Index> leg =
            search.between(vertices[i], vertices[(i + 1) % vertices.size()], context);
        path.insert(path.end(), leg.begin() + 1, leg.end());
    }
    if (closed) path.pop_back();
    return {mesh.shared_topology(), std::move(path), closed};
}

void smooth_path(Mesh& mesh, const Path& path, Index iterations, double strength,
                 const Context& context) {
    if (!path.on_mesh()) {
        throw Error(
            ErrorCode::invalid_argument,
            "the path has points of its own and none of the mesh; smooth it without a mesh");
    }
    std::vector<Vec3> points = path.points(mesh);
    smooth_polyline(points, path.closed(), iterations, strength, context);
    const MorphColumns morphs = mapped_morphs(mesh, [&](std::vector<Vec3> x) {
        std::vector<Vec3> line;
        for (const Index v : path.vertices()) line.push_back(x[at(v)]);
        smooth_polyline(line, path.closed(), iterations, strength, context);
        for (std::size_t i = 0; i < line.size(); ++i) x[at(path.vertices()[i])] = line[i];
        return x;
    });
    const DirectionCarrier directions(mesh);
    const std::span<Vec3> positions = mesh.edit_positions();
    for (std::size_t i = 0; i < points.size(); ++i) positions[path.vertices()[i]] = points[i];
    set_morphs(mesh, morphs);
    directions.follow(mesh);
}

void smooth_path(Path& path, Index iterations, double strength, const Context& context) {
    std::vector<Vec3> points = path.points();
    smooth_polyline(points, path.closed(), iterations, strength, context);
    path = Path(std::move(points), path.closed());
}

void smooth_path(Mesh& mesh, const Path& path, Index iterations, double strength) {
    smooth_path(mesh, path, iterations, strength, Context());
}

void smooth_path(Path& path, Index iterations, double strength) {
    smooth_path(path, iterations, strength, Context());
}

}  // namespace lissom
