#include "kernel/mesh/edit/subdivide.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Bytes an element of the result takes while it is made, roughly.
constexpr std::size_t kBytesPerCorner = 100;

// One step of subdivision. New vertices: the old ones, one on every edge, and one in every face
// that is divided into quads.
class Step {
  public:
    Step(const Mesh& mesh, SubdivisionScheme scheme)
        : mesh_(mesh), topology_(mesh.topology()), scheme_(scheme) {
        find_edges();
        number_face_points();
    }

    Mesh subdivided(const Context& context) {
        require_room();
        const auto charge =
            context.charge(4 * corner_edge_.size() * kBytesPerCorner, "subdivision");
        map_vertices();
        context.checkpoint();
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (face_point_[f] == kNoIndex) {
                split_triangle(f);
            } else {
                split_polygon(f);
            }
        }
        context.checkpoint();
        return derive(mesh_, positions(), std::move(faces_), map_, context);
    }

  private:
    // The edge from each corner to the next one of its face.
    void find_edges() {
        const OpenMesh::PolyConnectivity& halfedges = topology_.halfedges();
        corner_edge_.reserve(topology_.corner_count());
        edge_faces_.assign(2 * at(topology_.edge_count()), kNoIndex);
        for (Index f = 0; f < topology_.face_count(); ++f) {
            OpenMesh::HalfedgeHandle h = halfedges.halfedge_handle(OpenMesh::FaceHandle(f));
            for (std::size_t k = 0; k < topology_.face(f).size(); ++k) {
                corner_edge_.push_back(h.idx() / 2);
                edge_faces_[h.idx()] = f;
                h = halfedges.next_halfedge_handle(h);
            }
        }
    }

    bool has_face_point(Index f) const {
        return scheme_ == SubdivisionScheme::catmull_clark || topology_.face(f).size() > 3;
    }

    void number_face_points() {
        face_point_.assign(topology_.face_count(), kNoIndex);
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (has_face_point(f)) face_point_[f] = face_point_count_++;
        }
    }

    void require_room() const {
        const std::int64_t limit = std::numeric_limits<Index>::max();
        const std::int64_t vertices =
            std::int64_t{topology_.vertex_count()} + topology_.edge_count() + face_point_count_;
        if (vertices <= limit && 4 * std::int64_t{topology_.corner_count()} <= limit) return;
        throw Error(ErrorCode::out_of_range,
                    "the subdivided mesh would have more elements than can be numbered; use fewer "
                    "levels");
    }

    Index edge_point(Index edge) const { return topology_.vertex_count() + edge; }
    Index face_point(Index f) const {
        return topology_.vertex_count() + topology_.edge_count() + face_point_[f];
    }

    void map_vertices() {
        map_.vertices = ElementMap::identity(topology_.vertex_count());
        for (Index e = 0; e < topology_.edge_count(); ++e) {
            const auto [a, b] = topology_.edge(e);
            map_.vertices.add_mean(std::array{a, b});
        }
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (face_point_[f] != kNoIndex) map_.vertices.add_mean(topology_.face(f));
        }
    }

    void split_triangle(Index f) {
        const Index c = topology_.first_corner(f);
        const std::span<const Index> v = topology_.face(f);
        const Index ab = edge_point(corner_edge_[c]), bc = edge_point(corner_edge_[c + 1]),
                    ca = edge_point(corner_edge_[c + 2]);
        add_face(f, {v[0], ab, ca}, {{c, c}, {c, c + 1}, {c, c + 2}});
        add_face(f, {v[1], bc, ab}, {{c + 1, c + 1}, {c + 1, c + 2}, {c, c + 1}});
        add_face(f, {v[2], ca, bc}, {{c + 2, c + 2}, {c, c + 2}, {c + 1, c + 2}});
        add_face(f, {ab, bc, ca}, {{c, c + 1}, {c + 1, c + 2}, {c, c + 2}});
    }

    void add_face(Index f, std::initializer_list<Index> vertices,
                  std::initializer_list<std::pair<Index, Index>> corners) {
        faces_.add(vertices);
        map_.faces.add_copy(f);
        for (const auto& [a, b] : corners) add_corner(a, b);
    }

    void add_corner(Index a, Index b) {
        if (a == b) {
            map_.corners.add_copy(a);
        } else {
            map_.corners.add_mean(std::array{a, b});
        }
    }

    // One quad a corner: the corner, the edge after it, the middle, the edge before it.
    void split_polygon(Index f) {
        const std::span<const Index> v = topology_.face(f);
        const Index first = topology_.first_corner(f), n = count_of(v);
        std::vector<Index> corners;
        for (Index k = 0; k < n; ++k) corners.push_back(first + k);
        for (Index k = 0; k < n; ++k) {
            const Index here = corners[k], next = corners[(k + 1) % n],
                        before = corners[(k + n - 1) % n];
            faces_.add({v[k], edge_point(corner_edge_[here]), face_point(f),
                        edge_point(corner_edge_[before])});
            map_.faces.add_copy(f);
            map_.corners.add_copy(here);
            add_corner(here, next);
            map_.corners.add_mean(corners);
            add_corner(before, here);
        }
    }

    std::vector<Vec3> positions() const {
        std::vector<Vec3> result = blend_positions(mesh_, map_.vertices);
        if (scheme_ == SubdivisionScheme::midpoint) return result;
        const bool is_loop = scheme_ == SubdivisionScheme::loop;
        for (Index e = 0; e < topology_.edge_count(); ++e) {
            const Index left = edge_faces_[2 * e], right = edge_faces_[2 * e + 1];
            if (left == kNoIndex || right == kNoIndex) continue;
            const auto [a, b] = topology_.edge(e);
            const Vec3 ends = mesh_.position(a) + mesh_.position(b);
            if (is_loop) {
                const Vec3 across = opposite(left, a, b) + opposite(right, a, b);
                result[edge_point(e)] = (3.0 * ends + across) / 8.0;
            } else {
                const Vec3 faces = result[face_point(left)] + result[face_point(right)];
                result[edge_point(e)] = (ends + faces) / 4.0;
            }
        }
        for (Index v = 0; v < topology_.vertex_count(); ++v) {
            if (topology_.is_isolated(v)) continue;
            if (topology_.is_boundary(v)) {
                // The neighbours along the boundary are the first and the last of the ring.
                const std::span<const Index> ring = topology_.neighbors(v);
                const Vec3 ends = mesh_.position(ring.front()) + mesh_.position(ring.back());
                result[v] = (6.0 * mesh_.position(v) + ends) / 8.0;
            } else {
                result[v] = is_loop ? loop_vertex(v) : catmull_clark_vertex(v, result);
            }
        }
        return result;
    }

    Vec3 opposite(Index triangle, Index a, Index b) const {
        for (const Index v : topology_.face(triangle)) {
            if (v != a && v != b) return mesh_.position(v);
        }
        return Vec3::Zero();
    }

    Vec3 loop_vertex(Index v) const {
        const std::span<const Index> ring = topology_.neighbors(v);
        const double n = ring.size();
        const double root = 3.0 / 8.0 + std::cos(2.0 * kPi / n) / 4.0;
        const double beta = (5.0 / 8.0 - root * root) / n;
        Vec3 sum = Vec3::Zero();
        for (const Index u : ring) sum += mesh_.position(u);
        return (1.0 - n * beta) * mesh_.position(v) + beta * sum;
    }

    Vec3 catmull_clark_vertex(Index v, const std::vector<Vec3>& result) const {
        const std::span<const Index> ring = topology_.neighbors(v);
        const double n = ring.size();
        Vec3 faces = Vec3::Zero(), edges = Vec3::Zero();
        for (const Index f : topology_.faces_around(v)) faces += result[face_point(f)] / n;
        for (const Index u : ring) edges += (mesh_.position(u) + mesh_.position(v)) / (2.0 * n);
        return (faces + 2.0 * edges + (n - 3.0) * mesh_.position(v)) / n;
    }

    const Mesh& mesh_;
    const Topology& topology_;
    SubdivisionScheme scheme_;
    std::vector<Index> corner_edge_;
    // Faces left and right of each edge.
    std::vector<Index> edge_faces_;
    std::vector<Index> face_point_;
    Index face_point_count_ = 0;
    FaceList faces_;
    MeshMap map_;
};

// True where the fan from the mean of the face's vertices covers it without folds.
bool sees_itself(const Mesh& mesh, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
    for (const Index v : face) middle += mesh.position(v) / count_of(face);
    std::vector<Vec3> fan;
    for (std::size_t k = 0; k < face.size(); ++k) {
        const Vec3 a = mesh.position(face[k]) - middle;
        const Vec3 b = mesh.position(face[(k + 1) % face.size()]) - middle;
        fan.push_back(a.cross(b));
        normal += fan.back();
    }
    for (const Vec3& n : fan) {
        if (n.dot(normal) < 0.0) return false;
    }
    return true;
}

std::vector<Index> faces_to_triangulate(const Mesh& mesh, SubdivisionScheme scheme) {
    std::vector<Index> faces;
    if (scheme == SubdivisionScheme::catmull_clark) return faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (mesh.topology().face(f).size() == 3) continue;
        if (scheme == SubdivisionScheme::loop || !sees_itself(mesh, f)) faces.push_back(f);
    }
    return faces;
}

}  // namespace

Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options, const Context& context) try {
    if (options.levels < 0) {
        throw Error(ErrorCode::invalid_argument, "levels of subdivision must be 0 or more");
    }
    Progress progress(context, "subdivide");
    Mesh result = mesh;
    for (Index level = 0; level < options.levels; ++level) {
        progress.update(level, options.levels);
        triangulate(result, faces_to_triangulate(result, options.scheme), context);
        result = Step(result, options.scheme).subdivided(context);
    }
    return result;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
