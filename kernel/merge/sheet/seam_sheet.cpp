#include "kernel/merge/sheet/seam_sheet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Angles that differ by less are equal, so that rounding does not decide.
constexpr double kSheetAngle = 1e-7;

// The faces of a mesh that become a sheet.
struct SheetFaces {
    const Mesh& mesh;
    /// Ascending.
    std::vector<Index> sorted;

    SheetFaces(const Mesh& of, std::vector<Index> faces) : mesh(of), sorted(std::move(faces)) {
        std::sort(sorted.begin(), sorted.end());
    }
    bool contains(Index f) const { return std::binary_search(sorted.begin(), sorted.end(), f); }
};

// Vertices of the sheet by those of the mesh.
std::unordered_map<Index, Index> local_vertices(const SheetTriangles& sheet) {
    std::unordered_map<Index, Index> local;
    for (Index v = 0; v < sheet.vertex_count(); ++v) local.emplace(sheet.mesh_vertex[v], v);
    return local;
}

void take_faces(const Mesh& mesh, std::span<const Index> faces, SheetTriangles& sheet,
                SheetRest& rest) {
    const Triangulation parts = triangulate_faces(mesh.topology(), mesh.positions(), faces);
    std::unordered_map<Index, Index> local;
    for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = parts.triangles[t][k];
            const auto [found, made] = local.emplace(v, sheet.vertex_count());
            triangle[k] = found->second;
            if (made) sheet.add_vertex(mesh.position(v), v);
        }
        sheet.add_empty(1);
        sheet.enter(index_of(t), triangle);
    }
    rest.face = parts.face;
    rest.corners = parts.corners;
    rest.vertices = parts.triangles;
}

// Edges none of whose faces are in the sheet, so that the sheet's own may go and come back.
void find_outer_edges(const SheetFaces& faces, SheetTriangles& sheet) {
    const Topology& topology = faces.mesh.topology();
    const std::unordered_map<Index, Index> local = local_vertices(sheet);
    const auto is_of_sheet = [&](Index f) { return f != kNoIndex && faces.contains(f); };
    for (Index v = 0; v < sheet.vertex_count(); ++v) {
        const Index u = sheet.mesh_vertex[v];
        for (const Index w : topology.neighbors(u)) {
            const auto other = local.find(w);
            if (other == local.end() || other->second < v) continue;
            if (is_of_sheet(face_left_of(topology, u, w)) ||
                is_of_sheet(face_left_of(topology, w, u))) {
                continue;
            }
            sheet.outer_edges.insert(edge_key(v, other->second));
        }
    }
}

// After a flip that the sheet begins with.
void keep_corners(const SheetTriangles& sheet, const SheetQuad& quad, SheetRest& rest) {
    std::array<std::pair<Index, Index>, 6> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = {rest.vertices[quad.left][k], rest.corners[quad.left][k]};
        corners[3 + k] = {rest.vertices[quad.right][k], rest.corners[quad.right][k]};
    }
    for (const Index f : {quad.left, quad.right}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = sheet.mesh_vertex[sheet.triangles[f][k]];
            const auto found = std::find_if(corners.begin(), corners.end(),
                                            [&](const auto& corner) { return corner.first == v; });
            rest.vertices[f][k] = v;
            rest.corners[f][k] = found->second;
        }
    }
}

// Diagonals of the sheet's polygons that join vertices which an edge of the mesh joins too.
void separate_diagonals(const Mesh& mesh, SheetTriangles& sheet, SheetRest& rest) {
    for (std::size_t f = 0; f < sheet.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = sheet.triangles[f][k], c = sheet.triangles[f][(k + 1) % 3];
            const std::optional<SheetQuad> quad = quad_at(sheet, a, c);
            if (!quad || rest.face[quad->left] != rest.face[quad->right]) continue;
            const auto joined = mesh.topology().neighbors(sheet.mesh_vertex[a]);
            if (std::find(joined.begin(), joined.end(), sheet.mesh_vertex[c]) == joined.end()) {
                continue;
            }
            if (sheet.is_joined(quad->b, quad->d)) continue;
            turn_diagonal(sheet, *quad);
            keep_corners(sheet, *quad, rest);
        }
    }
}

void fix_border(const SheetFaces& faces, SheetTriangles& sheet) {
    const Mesh& mesh = faces.mesh;
    for (const Triangle& t : sheet.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (sheet.left_of(b, a) != kNoIndex) continue;
            sheet.fixed[a] = sheet.fixed[b] = 1;
            const Index beyond =
                face_left_of(mesh.topology(), sheet.mesh_vertex[b], sheet.mesh_vertex[a]);
            if (beyond != kNoIndex) {
                sheet.beyond.emplace(edge_key(a, b), clear_area_vector(mesh, beyond));
            }
        }
    }
    // A vertex with faces outside the sheet that touches it in one point stays as well.
    for (Index v = 0; v < sheet.vertex_count(); ++v) {
        for (const Index f : mesh.topology().faces_around(sheet.mesh_vertex[v])) {
            if (!faces.contains(f)) sheet.fixed[v] = 1;
        }
    }
}

void fix_seams(std::span<const std::vector<Index>> seams, SheetTriangles& sheet) {
    const std::unordered_map<Index, Index> local = local_vertices(sheet);
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            const auto a = local.find(seam[k]), b = local.find(seam[(k + 1) % seam.size()]);
            if (a == local.end()) continue;
            sheet.fixed[a->second] = 1;
            if (b != local.end()) sheet.seam.insert(edge_key(a->second, b->second));
        }
    }
}

bool same_values(const Mesh& mesh, Index p, Index q) {
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (attribute.domain != Domain::corner) continue;
        for (Index k = 0; k < attribute.width; ++k) {
            const double x = attribute.at(p)[k], y = attribute.at(q)[k];
            if (std::isnan(x) && std::isnan(y)) continue;
            if (!(std::abs(x - y) <= 1e-9 * (std::abs(x) + std::abs(y)))) return false;
        }
    }
    return true;
}

// The corner of the mesh that a first triangle has at a vertex.
Index corner_at(const SheetTriangles& sheet, const SheetRest& rest, Index f, Index v) {
    std::size_t k = 0;
    while (sheet.triangles[f][k] != v) ++k;
    return rest.corners[f][k];
}

// Whether labels or attributes of corners differ across the edge between two first triangles.
bool is_chart_border(const Mesh& mesh, const SheetTriangles& sheet, const SheetRest& rest,
                     std::array<Index, 2> sides, std::array<Index, 2> ends) {
    const auto [left, right] = sides;
    if (rest.face[left] == rest.face[right]) return false;
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        if (labels.of_face[rest.face[left]] != labels.of_face[rest.face[right]]) return true;
    }
    for (const Index v : ends) {
        if (!same_values(mesh, corner_at(sheet, rest, left, v), corner_at(sheet, rest, right, v)))
            return true;
    }
    return false;
}

void mark_features(const Mesh& mesh, const SheetRest& rest, double sharp, SheetTriangles& sheet) {
    for (Index f = 0; f < count_of(sheet.triangles); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = sheet.triangles[f][k], c = sheet.triangles[f][(k + 1) % 3];
            const Index other = sheet.left_of(c, a);
            if (other == kNoIndex || other < f) continue;
            const Vec3 &n = sheet.normal[f], &m = sheet.normal[other];
            const bool is_sharp =
                !n.isZero(0.0) && !m.isZero(0.0) && angle_between(n, m) > sharp + kSheetAngle;
            if (is_sharp || is_chart_border(mesh, sheet, rest, {f, other}, {a, c})) {
                sheet.add_feature(a, c);
            }
        }
    }
}

std::vector<Vec3> corner_points(const SheetTriangles& sheet) {
    std::vector<Vec3> points;
    for (const Triangle& t : sheet.triangles) {
        for (const Index v : t) points.push_back(sheet.x[v]);
    }
    return points;
}

}  // namespace

SeamSheet::SeamSheet(const Mesh& mesh, std::vector<Index> faces,
                     std::span<const std::vector<Index>> seams, double sharp,
                     const Context& context)
    : mesh_(mesh), faces_(std::move(faces)) {
    const SheetFaces of_sheet(mesh_, faces_);
    take_faces(mesh_, faces_, now_, rest_);
    find_outer_edges(of_sheet, now_);
    separate_diagonals(mesh_, now_, rest_);
    fix_border(of_sheet, now_);
    fix_seams(seams, now_);
    mark_features(mesh_, rest_, sharp, now_);
    rest_.set_points(corner_points(now_), context);
}

Index SeamSheet::flip_edges(const SheetLimits& limits, const Context& context) {
    return lissom::flip_edges(now_, memory_, limits, context);
}

void SeamSheet::remesh(const SheetSize& size, const SheetLimits& limits, const SheetLimits& flips,
                       const Context& context) {
    lissom::remesh(now_, rest_, memory_, size, limits, flips, context);
}

bool SeamSheet::has_moved(Index v) const {
    return mesh_vertex(v) == kNoIndex || position(v) != mesh_.position(mesh_vertex(v));
}

std::vector<Triangle> SeamSheet::triangles() const {
    std::vector<Triangle> result;
    for (const Triangle& t : now_.triangles) {
        if (t[0] != kNoIndex) result.push_back(t);
    }
    return result;
}

Vec3 SeamSheet::middle(const Triangle& t) const {
    return (position(t[0]) + position(t[1]) + position(t[2])) / 3.0;
}

std::vector<ElementMap::Source> SeamSheet::vertex_sources(Index v) const {
    return rest_.vertex_sources(position(v));
}

Index SeamSheet::face_source(const Triangle& t) const {
    return rest_.face_source(middle(t));
}

std::vector<ElementMap::Source> SeamSheet::corner_sources(const Triangle& t, std::size_t k) const {
    return rest_.corner_sources(position(t[k]), middle(t));
}

}  // namespace lissom
