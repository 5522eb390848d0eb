#include "kernel/merge/sew/seam_patch.h"

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

SeamPatch::SeamPatch(const Mesh& mesh, Index first_source_face,
                     std::span<const Index> loop_vertices)
    : mesh_(mesh), first_source_face_(first_source_face) {
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

const Vec3& SeamPatch::position(Index v) const {
    const auto found = moved_.find(v);
    return found == moved_.end() ? mesh_.position(v) : found->second;
}

Index SeamPatch::left_of(Index from, Index to, std::size_t side) const {
    const auto found = edges_[side].find(key(from, to));
    return found == edges_[side].end() ? kNoIndex : found->second;
}

Index SeamPatch::left_of(Index from, Index to) const {
    const Index face = left_of(from, to, 0);
    return face == kNoIndex ? left_of(from, to, 1) : face;
}

bool SeamPatch::has_edge(Index a, Index b) const {
    return left_of(a, b) != kNoIndex || left_of(b, a) != kNoIndex;
}

std::size_t SeamPatch::side_of(Index v) const {
    return mesh_.topology().faces_around(v).front() >= first_source_face_ ? 1 : 0;
}

bool SeamPatch::is_complete(Index v) const {
    return complete_.contains(v);
}

void SeamPatch::enter(Index face) {
    const std::vector<SeamCorner>& corners = faces_[face].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index from = corners[k].vertex, to = corners[(k + 1) % corners.size()].vertex;
        edges_of(faces_[face])[key(from, to)] = face;
        faces_at_[from].push_back(face);
    }
}

void SeamPatch::leave(Index face) {
    const std::vector<SeamCorner>& corners = faces_[face].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index from = corners[k].vertex, to = corners[(k + 1) % corners.size()].vertex;
        auto& edges = edges_of(faces_[face]);
        const auto found = edges.find(key(from, to));
        if (found != edges.end() && found->second == face) edges.erase(found);
        std::erase(faces_at_[from], face);
    }
}

Index SeamPatch::add(SeamFace face) {
    faces_.push_back(std::move(face));
    const auto index = static_cast<Index>(faces_.size()) - 1;
    enter(index);
    return index;
}

void SeamPatch::replace(Index face, std::vector<SeamCorner> corners) {
    leave(face);
    faces_[face].corners = std::move(corners);
    enter(face);
}

void SeamPatch::remove(const std::set<Index>& origins) {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        if (origins.contains(faces_[i].origin)) replace(static_cast<Index>(i), {});
    }
}

void SeamPatch::triangulate(Index face) {
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

void SeamPatch::split_edge(Index from, Index to, std::span<const Index> vertices,
                           std::span<const double> fractions) {
    // The other side may by now have an edge between the same two vertices, across a corner.
    const std::size_t side = side_of(from);
    triangulate(left_of(from, to, side));
    const Index face = left_of(from, to, side);
    const std::vector<SeamCorner> old = faces_[face].corners;
    std::size_t k = 0;
    while (old[k].vertex != from) ++k;
    const SeamCorner start = old[k], end = old[(k + 1) % 3], apex = old[(k + 2) % 3];
    SeamCorner last = start;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const SeamCorner next{vertices[i], start.first, end.first, fractions[i]};
        if (i == 0) {
            replace(face, {last, next, apex});
        } else {
            add({{last, next, apex}, faces_[face].origin});
        }
        last = next;
    }
    add({{last, end, apex}, faces_[face].origin});
}

void SeamPatch::merge_vertex(Index v, Index into) {
    for (const Index face : std::vector<Index>(faces_at_[v])) {
        std::vector<SeamCorner> corners = faces_[face].corners;
        for (SeamCorner& corner : corners) {
            if (corner.vertex == v) corner.vertex = into;
        }
        replace(face, std::move(corners));
    }
    faces_at_.erase(v);
}

void SeamPatch::close(std::span<const std::vector<Index>> seams) {
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            const Index a = seam[k], b = seam[(k + 1) % seam.size()];
            seam_edges_.insert(key(std::min(a, b), std::max(a, b)));
        }
        seam_vertices_.insert(seam_vertices_.end(), seam.begin(), seam.end());
    }
    std::sort(seam_vertices_.begin(), seam_vertices_.end());
    separate_inner_edges();
}

// Where the seam's vertices are joined by an edge inside both sides, that edge would have four
// faces. It is flipped on one side.
void SeamPatch::separate_inner_edges() {
    for (const Index a : seam_vertices_) {
        for (const Index c : neighbors(a)) {
            const bool shared = a < c && !seam_edges_.contains(key(a, c)) &&
                                left_of(a, c, 0) != kNoIndex && left_of(a, c, 1) != kNoIndex;
            if (!shared) continue;
            bool done = false;
            for (const std::size_t side : {1, 0}) {
                for (const auto& [x, y] : {std::pair(a, c), std::pair(c, a)}) {
                    const Index face = left_of(x, y, side);
                    if (face != kNoIndex) triangulate(face);
                }
                Diagonal diagonal;
                done = find_diagonal(a, c, side, diagonal) && can_flip(diagonal);
                if (!done) continue;
                flip(diagonal);
                break;
            }
            if (done) continue;
            throw Error(ErrorCode::nonmanifold_edge,
                        "both sides of a seam have an inner edge between the same two of its "
                        "vertices; subdivide one of the meshes near the seam",
                        {ElementKind::vertex, 2, {a, c}});
        }
    }
}

std::vector<Index> SeamPatch::neighbors(Index v) const {
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

bool SeamPatch::is_open(Index v) const {
    for (const Index w : neighbors(v)) {
        if (left_of(v, w) == kNoIndex || left_of(w, v) == kNoIndex) return true;
    }
    return false;
}

}  // namespace lissom
