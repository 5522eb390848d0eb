#include "kernel/mesh/edit/subdivide.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Bytes an element of the result takes while it is made, roughly.
constexpr std::size_t kBytesPerCorner = 100;
// Bytes of one source of an element of the result.
constexpr std::size_t kBytesPerSource = 16;

bool has_corner_values(const Mesh& mesh) {
    const auto& all = mesh.attributes().all();
    return std::any_of(all.begin(), all.end(),
                       [](const Attribute& a) { return a.domain == Domain::corner; });
}

// One step of subdivision. New vertices: the old ones, one on every edge, and one in every face
// that is divided into quads.
class Step {
  public:
    /// `split` tells for each face whether it is split.
    Step(const Mesh& mesh, SubdivisionScheme scheme, const std::vector<char>& split)
        : mesh_(mesh),
          topology_(mesh.topology()),
          scheme_(scheme),
          split_(split),
          blends_corners_(has_corner_values(mesh)) {
        find_edges();
        number_edge_points();
        number_face_points();
    }

    Mesh subdivided(const Context& context) {
        require_room();
        const auto charge = context.charge(room(), "subdivision");
        map_vertices();
        context.checkpoint();
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (!split_[at(f)]) {
                fit_face(f);
            } else if (face_point_[f] == kNoIndex) {
                split_triangle(f);
            } else {
                split_polygon(f);
            }
        }
        context.checkpoint();
        const std::span<const Vec3> old = mesh_.positions();
        Mesh result =
            derive(mesh_, places({old.begin(), old.end()}), std::move(faces_), map_, context);
        set_morphs(result,
                   mapped_morphs(mesh_, [&](const std::vector<Vec3>& x) { return places(x); }));
        return result;
    }

    /// For each new face whether the face that it was made from was split.
    std::vector<char> made_by_splitting() const {
        std::vector<char> made;
        for (Index f = 0; f < map_.faces.size(); ++f) {
            made.push_back(split_[at(map_.faces.main_source(f))]);
        }
        return made;
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

    // Edges with a split face beside them get a point.
    void number_edge_points() {
        edge_point_.assign(at(topology_.edge_count()), kNoIndex);
        for (Index e = 0; e < topology_.edge_count(); ++e) {
            if (is_split(edge_faces_[2 * e]) || is_split(edge_faces_[2 * e + 1])) {
                edge_point_[at(e)] = edge_point_count_++;
            }
        }
    }

    bool is_split(Index face) const { return face != kNoIndex && split_[at(face)] != 0; }

    bool has_face_point(Index f) const {
        return scheme_ == SubdivisionScheme::catmull_clark || topology_.face(f).size() > 3;
    }

    void number_face_points() {
        face_point_.assign(topology_.face_count(), kNoIndex);
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (split_[at(f)] && has_face_point(f)) face_point_[f] = face_point_count_++;
        }
    }

    void require_room() const {
        const std::int64_t limit = std::numeric_limits<Index>::max();
        const std::int64_t vertices =
            std::int64_t{topology_.vertex_count()} + edge_point_count_ + face_point_count_;
        if (vertices <= limit && 4 * std::int64_t{topology_.corner_count()} <= limit) return;
        throw Error(ErrorCode::out_of_range,
                    "the subdivided mesh would have more elements than can be numbered; use fewer "
                    "levels");
    }

    // The corners in the middle of a polygon have all of its corners as sources, each of them.
    std::size_t room() const {
        std::size_t sources = 0;
        for (Index f = 0; blends_corners_ && f < topology_.face_count(); ++f) {
            const std::size_t n = topology_.face(f).size();
            if (face_point_[at(f)] != kNoIndex) sources += n * n;
        }
        return 4 * corner_edge_.size() * kBytesPerCorner + sources * kBytesPerSource;
    }

    bool has_point(Index edge) const { return edge_point_[at(edge)] != kNoIndex; }
    Index edge_point(Index edge) const { return topology_.vertex_count() + edge_point_[at(edge)]; }
    Index face_point(Index f) const {
        return topology_.vertex_count() + edge_point_count_ + face_point_[f];
    }

    void map_vertices() {
        map_.vertices = ElementMap::identity(topology_.vertex_count());
        for (Index e = 0; e < topology_.edge_count(); ++e) {
            if (!has_point(e)) continue;
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

    // A face that is not split takes in the points of its edges.
    void fit_face(Index f) {
        const Index first = topology_.first_corner(f), n = count_of(topology_.face(f));
        Index points = 0;
        for (Index k = 0; k < n; ++k) points += has_point(corner_edge_[first + k]) ? 1 : 0;
        if (n == 3 && points > 0) {
            fit_triangle(f, points);
        } else {
            fit_polygon(f);
        }
    }

    void fit_polygon(Index f) {
        const std::span<const Index> v = topology_.face(f);
        const Index first = topology_.first_corner(f), n = count_of(v);
        std::vector<Index> vertices;
        for (Index k = 0; k < n; ++k) {
            const Index here = first + k;
            vertices.push_back(v[k]);
            add_corner(here, here);
            if (!has_point(corner_edge_[here])) continue;
            vertices.push_back(edge_point(corner_edge_[here]));
            add_corner(here, first + (k + 1) % n);
        }
        faces_.add(vertices);
        map_.faces.add_copy(f);
    }

    // Bank, Sherman and Weiser 1983: one point halves it, of two points the diagonal that is left
    // is the shorter one.
    void fit_triangle(Index f, Index points) {
        if (points == 3) return split_triangle(f);
        const Index first = topology_.first_corner(f);
        const auto divided = [&](Index k) { return has_point(corner_edge_[first + k % 3]); };
        Index k = 0;
        while (!(divided(k) && (points == 1 || divided(k + 1)))) ++k;
        const std::span<const Index> v = topology_.face(f);
        const Index ca = first + k, cb = first + (k + 1) % 3, cc = first + (k + 2) % 3;
        const Index a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
        const Index ab = edge_point(corner_edge_[ca]);
        if (points == 1) {
            add_face(f, {a, ab, c}, {{ca, ca}, {ca, cb}, {cc, cc}});
            add_face(f, {ab, b, c}, {{ca, cb}, {cb, cb}, {cc, cc}});
            return;
        }
        const Index bc = edge_point(corner_edge_[cb]);
        add_face(f, {ab, b, bc}, {{ca, cb}, {cb, cb}, {cb, cc}});
        const auto length = [&](Index from, Index p, Index q) {
            const Vec3 middle = 0.5 * (mesh_.position(p) + mesh_.position(q));
            return (mesh_.position(from) - middle).squaredNorm();
        };
        if (length(a, b, c) <= length(c, a, b)) {
            add_face(f, {a, ab, bc}, {{ca, ca}, {ca, cb}, {cb, cc}});
            add_face(f, {a, bc, c}, {{ca, ca}, {cb, cc}, {cc, cc}});
        } else {
            add_face(f, {a, ab, c}, {{ca, ca}, {ca, cb}, {cc, cc}});
            add_face(f, {ab, bc, c}, {{ca, cb}, {cb, cc}, {cc, cc}});
        }
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
            // Many corners have many sources; without values at corners nobody asks for them.
            if (blends_corners_) {
                map_.corners.add_mean(corners);
            } else {
                map_.corners.add_copy(here);
            }
            add_corner(before, here);
        }
    }

    // The scheme's weights applied to positions, or displacements, of the old vertices.
    std::vector<Vec3> places(const std::vector<Vec3>& x) const {
        std::vector<Vec3> result = blend_points(x, map_.vertices);
        if (scheme_ == SubdivisionScheme::midpoint) return result;
        const bool is_loop = scheme_ == SubdivisionScheme::loop;
        for (Index e = 0; e < topology_.edge_count(); ++e) {
            const Index left = edge_faces_[2 * e], right = edge_faces_[2 * e + 1];
            if (!is_split(left) || !is_split(right)) continue;
            const auto [a, b] = topology_.edge(e);
            const Vec3 ends = x[at(a)] + x[at(b)];
            if (is_loop) {
                const Vec3 across = opposite(x, left, a, b) + opposite(x, right, a, b);
                result[edge_point(e)] = (3.0 * ends + across) / 8.0;
            } else {
                const Vec3 faces = result[face_point(left)] + result[face_point(right)];
                result[edge_point(e)] = (ends + faces) / 4.0;
            }
        }
        for (Index v = 0; v < topology_.vertex_count(); ++v) {
            if (topology_.is_isolated(v) || !is_smoothed(v)) continue;
            if (topology_.is_boundary(v)) {
                // The neighbours along the boundary are the first and the last of the ring.
                const std::span<const Index> ring = topology_.neighbors(v);
                const Vec3 ends = x[at(ring.front())] + x[at(ring.back())];
                result[v] = (6.0 * x[at(v)] + ends) / 8.0;
            } else {
                result[v] = is_loop ? loop_vertex(x, v) : catmull_clark_vertex(x, v, result);
            }
        }
        return result;
    }

    bool is_smoothed(Index v) const {
        const auto faces = topology_.faces_around(v);
        return std::all_of(faces.begin(), faces.end(), [&](Index f) { return is_split(f); });
    }

    Vec3 opposite(const std::vector<Vec3>& x, Index triangle, Index a, Index b) const {
        for (const Index v : topology_.face(triangle)) {
            if (v != a && v != b) return x[at(v)];
        }
        return Vec3::Zero();
    }

    Vec3 loop_vertex(const std::vector<Vec3>& x, Index v) const {
        const std::span<const Index> ring = topology_.neighbors(v);
        const double n = ring.size();
        const double root = 3.0 / 8.0 + std::cos(2.0 * kPi / n) / 4.0;
        const double beta = (5.0 / 8.0 - root * root) / n;
        Vec3 sum = Vec3::Zero();
        for (const Index u : ring) sum += x[at(u)];
        return (1.0 - n * beta) * x[at(v)] + beta * sum;
    }

    Vec3 catmull_clark_vertex(const std::vector<Vec3>& x, Index v,
                              const std::vector<Vec3>& result) const {
        const std::span<const Index> ring = topology_.neighbors(v);
        const double n = ring.size();
        Vec3 faces = Vec3::Zero(), edges = Vec3::Zero();
        for (const Index f : topology_.faces_around(v)) faces += result[face_point(f)] / n;
        for (const Index u : ring) edges += (x[at(u)] + x[at(v)]) / (2.0 * n);
        return (faces + 2.0 * edges + (n - 3.0) * x[at(v)]) / n;
    }

    const Mesh& mesh_;
    const Topology& topology_;
    SubdivisionScheme scheme_;
    const std::vector<char>& split_;
    bool blends_corners_;
    std::vector<Index> corner_edge_;
    // Faces left and right of each edge.
    std::vector<Index> edge_faces_;
    std::vector<Index> edge_point_, face_point_;
    Index edge_point_count_ = 0, face_point_count_ = 0;
    FaceList faces_;
    MeshMap map_;
};

// True if the fan from the mean of the face's vertices covers it without folds.
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

std::vector<Index> faces_to_triangulate(const Mesh& mesh, SubdivisionScheme scheme,
                                        const std::vector<char>& split) {
    std::vector<Index> faces;
    if (scheme == SubdivisionScheme::catmull_clark) return faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!split[at(f)] || mesh.topology().face(f).size() == 3) continue;
        if (scheme == SubdivisionScheme::loop || !sees_itself(mesh, f)) faces.push_back(f);
    }
    return faces;
}

// Triangulates the faces that the scheme cannot split, and follows the flags of the faces.
void prepare_faces(Mesh& mesh, SubdivisionScheme scheme, std::vector<char>& split,
                   const Context& context) {
    const std::vector<Index> faces = faces_to_triangulate(mesh, scheme, split);
    if (faces.empty()) return;
    std::vector<char> flags;
    auto next = faces.begin();
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const bool divided = next != faces.end() && *next == f;
        if (divided) ++next;
        flags.insert(flags.end(), divided ? mesh.topology().face(f).size() - 2 : 1, split[at(f)]);
    }
    triangulate(mesh, faces, context);
    split = std::move(flags);
}

std::vector<char> faces_to_split(const Mesh& mesh, const std::optional<Region>& region) {
    if (!region) return std::vector<char>(at(mesh.face_count()), 1);
    require_same_topology(mesh, region->topology(), "the region");
    std::vector<char> split(at(mesh.face_count()), 0);
    const std::vector<Index> faces = region->faces();
    for (const Index f : faces) split[at(f)] = 1;
    if (!faces.empty()) return split;
    throw Error(ErrorCode::region_empty,
                "the region holds no face to subdivide: mark all vertices of a face");
}

}  // namespace

Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options, const Context& context) try {
    if (options.levels < 0) {
        throw Error(ErrorCode::invalid_argument, "levels of subdivision must be 0 or more");
    }
    Progress progress(context, "subdivide");
    Mesh result = mesh;
    std::vector<char> split = faces_to_split(mesh, options.region);
    for (Index level = 0; level < options.levels; ++level) {
        progress.update(level, options.levels);
        prepare_faces(result, options.scheme, split, context);
        Step step(result, options.scheme, split);
        Mesh finer = step.subdivided(context);
        split = step.made_by_splitting();
        result = std::move(finer);
    }
    return result;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
