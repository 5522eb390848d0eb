#include "kernel/merge/sew/seam_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// The vertices at most `rings` edges away from `seeds`.
std::vector<Index> within_rings(const Topology& topology, std::span<const Index> seeds,
                                Index rings) {
    std::vector<Index> found(seeds.begin(), seeds.end());
    std::unordered_set<Index> seen(seeds.begin(), seeds.end());
    std::size_t begin = 0;
    for (Index ring = 0; ring < rings; ++ring) {
        const std::size_t end = found.size();
        for (; begin < end; ++begin) {
            for (const Index w : topology.neighbors(found[begin])) {
                if (seen.insert(w).second) found.push_back(w);
            }
        }
    }
    return found;
}

}  // namespace

SeamFaces::SeamFaces(const Mesh& mesh, Index first_source_face,
                     std::span<const Index> loop_vertices)
    : mesh_(&mesh), first_source_face_(first_source_face) {
    const Topology& topology = mesh.topology();
    for (const Index v : within_rings(topology, loop_vertices, kRings)) {
        complete_.insert(v);
        const std::span<const Index> around = topology.faces_around(v);
        origins_.insert(origins_.end(), around.begin(), around.end());
    }
    std::sort(origins_.begin(), origins_.end());
    origins_.erase(std::unique(origins_.begin(), origins_.end()), origins_.end());
    for (const Index f : origins_) {
        SeamFace face{{}, f};
        Index corner = topology.first_corner(f);
        for (const Index v : topology.face(f)) face.corners.push_back({v, corner++, kNoIndex, 0.0});
        add(std::move(face));
    }
}

const Vec3& SeamFaces::position(Index v) const {
    const auto found = moved_.find(v);
    return found == moved_.end() ? mesh_->position(v) : found->second;
}

Index SeamFaces::left_of(Index from, Index to, std::size_t side) const {
    const auto found = edges_[side].find(key(from, to));
    return found == edges_[side].end() ? kNoIndex : found->second;
}

Index SeamFaces::left_of(Index from, Index to) const {
    const Index face = left_of(from, to, 0);
    return face == kNoIndex ? left_of(from, to, 1) : face;
}

bool SeamFaces::has_edge(Index a, Index b) const {
    return left_of(a, b) != kNoIndex || left_of(b, a) != kNoIndex;
}

std::size_t SeamFaces::side_of(Index v) const {
    return mesh_->topology().faces_around(v).front() >= first_source_face_ ? 1 : 0;
}

void SeamFaces::enter(Index face) {
    const std::vector<SeamCorner>& corners = faces_[face].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index from = corners[k].vertex, to = corners[(k + 1) % corners.size()].vertex;
        edges_of(faces_[face])[key(from, to)] = face;
        faces_at_[from].push_back(face);
    }
}

void SeamFaces::leave(Index face) {
    const std::vector<SeamCorner>& corners = faces_[face].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index from = corners[k].vertex, to = corners[(k + 1) % corners.size()].vertex;
        auto& edges = edges_of(faces_[face]);
        const auto found = edges.find(key(from, to));
        if (found != edges.end() && found->second == face) edges.erase(found);
        std::erase(faces_at_[from], face);
    }
}

Index SeamFaces::add(SeamFace face) {
    faces_.push_back(std::move(face));
    const auto index = count_of(faces_) - 1;
    enter(index);
    return index;
}

void SeamFaces::replace(Index face, std::vector<SeamCorner> corners) {
    leave(face);
    faces_[face].corners = std::move(corners);
    enter(face);
}

void SeamFaces::replace_both(Index face, std::vector<SeamCorner> corners, Index other,
                             std::vector<SeamCorner> other_corners) {
    leave(face);
    leave(other);
    faces_[face].corners = std::move(corners);
    faces_[other].corners = std::move(other_corners);
    enter(face);
    enter(other);
}

void SeamFaces::triangulate(Index face) {
    const SeamFace old = faces_[face];
    if (old.corners.size() == 3) return;
    std::vector<Vec3> points;
    for (const SeamCorner& corner : old.corners) points.push_back(position(corner.vertex));
    std::vector<Triangle> triangles;
    triangulate_polygon(points, triangles);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::vector<SeamCorner> corners;
        for (const Index k : triangles[t]) corners.push_back(old.corners[k]);
        if (t == 0) {
            replace(face, std::move(corners));
        } else {
            add({std::move(corners), old.origin});
        }
    }
}

std::vector<Index> SeamFaces::neighbors(Index v) const {
    std::vector<Index> found;
    const auto around = faces_at_.find(v);
    if (around == faces_at_.end()) return found;
    for (const Index face : around->second) {
        const std::vector<SeamCorner>& corners = faces_[face].corners;
        const std::size_t n = corners.size();
        for (std::size_t k = 0; k < n; ++k) {
            if (corners[k].vertex != v) continue;
            found.push_back(corners[(k + 1) % n].vertex);
            found.push_back(corners[(k + n - 1) % n].vertex);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::vector<Index> SeamFaces::faces_at(Index v) const {
    const auto found = faces_at_.find(v);
    return found == faces_at_.end() ? std::vector<Index>() : found->second;
}

Vec3 SeamFaces::area_vector(const SeamFace& face) const {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = position(face.corners[0].vertex);
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
        sum += (position(face.corners[k].vertex) - origin)
                   .cross(position(face.corners[k + 1].vertex) - origin);
    }
    return sum;
}

bool SeamFaces::same_values(const SeamCorner& p, const SeamCorner& q) const {
    for (const Attribute& attribute : mesh_->attributes().all()) {
        if (attribute.domain != Domain::corner) continue;
        for (Index k = 0; k < attribute.width; ++k) {
            const auto value = [&](const SeamCorner& corner) {
                const double first = attribute.at(corner.first)[k];
                if (corner.second == kNoIndex) return first;
                return (1.0 - corner.t) * first + corner.t * attribute.at(corner.second)[k];
            };
            const double x = value(p), y = value(q);
            if (std::isnan(x) && std::isnan(y)) continue;
            if (!(std::abs(x - y) <= 1e-9 * (std::abs(x) + std::abs(y)))) return false;
        }
    }
    return true;
}

}  // namespace lissom
