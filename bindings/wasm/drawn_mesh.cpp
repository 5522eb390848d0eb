#include "bindings/wasm/drawn_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace lissom::wasm {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector unit(const Vector& a) {
    const double length = std::sqrt(dot(a, a));
    return length > 0.0 ? Vector{a[0] / length, a[1] / length, a[2] / length} : Vector{};
}

Vector position(const Surface& surface, std::uint32_t vertex) {
    const double* p = surface.positions.data() + std::size_t{3} * vertex;
    return {p[0], p[1], p[2]};
}

Vector edge(const Surface& surface, std::size_t corner, std::size_t step) {
    const std::size_t triangle = corner / 3 * 3;
    const auto& corners = surface.corners;
    return minus(position(surface, corners[triangle + (corner + step) % 3]),
                 position(surface, corners[corner]));
}

double angle(const Surface& surface, std::size_t corner) {
    const Vector a = edge(surface, corner, 1), b = edge(surface, corner, 2);
    const Vector c = cross(a, b);
    return std::atan2(std::sqrt(dot(c, c)), dot(a, b));
}

lissom_status read_surface(lissom_context* context, lissom_mesh mesh, Surface& surface) {
    const auto vertices = static_cast<std::size_t>(lissom_mesh_vertex_count(context, mesh));
    const auto triangles = static_cast<std::size_t>(lissom_mesh_triangle_count(context, mesh));
    surface.positions.resize(3 * vertices);
    surface.corners.resize(3 * triangles);
    const lissom_output places{surface.positions.data(), vertices, 0, LISSOM_FLOAT64};
    const lissom_output corners{surface.corners.data(), triangles, 0, LISSOM_UINT32};
    const lissom_status status = lissom_mesh_read_positions(context, mesh, &places);
    return status == LISSOM_OK ? lissom_mesh_read_triangles(context, mesh, &corners) : status;
}

// The corners of all faces, and the place of the first of each.
struct Faces {
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> first;
};

lissom_status read_faces(lissom_context* context, lissom_mesh mesh, Faces& faces) {
    const auto corner_count = static_cast<std::size_t>(lissom_mesh_corner_count(context, mesh));
    const auto face_count = static_cast<std::size_t>(lissom_mesh_face_count(context, mesh));
    std::vector<std::uint32_t> sizes(face_count);
    faces.corners.resize(corner_count);
    const lissom_output all{faces.corners.data(), corner_count, 0, LISSOM_UINT32};
    const lissom_output counts{sizes.data(), face_count, 0, LISSOM_UINT32};
    const lissom_status status = lissom_mesh_read_faces(context, mesh, &all, &counts);
    faces.first.assign(face_count + 1, 0);
    for (std::size_t f = 0; f < face_count; ++f) faces.first[f + 1] = faces.first[f] + sizes[f];
    return status;
}

// The face of each triangle: those of a face with n sides are n - 2, one after the other.
lissom_status find_faces(lissom_context* context, lissom_mesh mesh, Surface& surface) {
    surface.face.clear();
    Faces faces;
    const lissom_status status = read_faces(context, mesh, faces);
    for (std::size_t f = 0; f + 1 < faces.first.size(); ++f) {
        const std::size_t sides = faces.first[f + 1] - faces.first[f];
        surface.face.insert(surface.face.end(), std::max(sides, std::size_t{2}) - 2,
                            static_cast<std::uint32_t>(f));
    }
    surface.face.resize(surface.corners.size() / 3);
    return status;
}

void find_normals(Surface& surface) {
    std::vector<Vector> sums(surface.face.empty() ? 0 : std::size_t{surface.face.back()} + 1);
    for (std::size_t t = 0; t < surface.face.size(); ++t) {
        const Vector area = cross(edge(surface, 3 * t, 1), edge(surface, 3 * t, 2));
        for (std::size_t i = 0; i < 3; ++i) sums[surface.face[t]][i] += area[i];
    }
    surface.normals.resize(surface.face.size());
    for (std::size_t t = 0; t < surface.normals.size(); ++t) {
        surface.normals[t] = unit(sums[surface.face[t]]);
    }
}

void sort_corners(Surface& surface) {
    surface.first.assign(surface.positions.size() / 3 + 1, 0);
    for (const std::uint32_t v : surface.corners) ++surface.first[v + 1];
    for (std::size_t v = 1; v < surface.first.size(); ++v) surface.first[v] += surface.first[v - 1];
    surface.around.resize(surface.corners.size());
    std::vector<std::uint32_t> next(surface.first.begin(), surface.first.end() - 1);
    for (std::size_t c = 0; c < surface.corners.size(); ++c) {
        surface.around[next[surface.corners[c]]++] = static_cast<std::uint32_t>(c);
    }
}

std::uint32_t next_vertex(const Surface& surface, std::size_t corner, std::size_t step) {
    return surface.corners[corner / 3 * 3 + (corner + step) % 3];
}

// Whether two corners of a vertex are neighbours over an edge that is no crease. A face without
// area has no side of its own.
bool are_joined(const Surface& surface, std::size_t a, std::size_t b, double least_cosine) {
    if (next_vertex(surface, a, 1) != next_vertex(surface, b, 2) &&
        next_vertex(surface, a, 2) != next_vertex(surface, b, 1)) {
        return false;
    }
    if (surface.face[a / 3] == surface.face[b / 3]) return true;
    const Vector &p = surface.normals[a / 3], &q = surface.normals[b / 3];
    return dot(p, p) == 0.0 || dot(q, q) == 0.0 || dot(p, q) >= least_cosine;
}

// The first of the corners that hang together with the one at `place`.
std::size_t first_of(std::vector<std::size_t>& group, std::size_t place) {
    while (group[place] != place) place = group[place] = group[group[place]];
    return place;
}

// Writes normals of the corners of a vertex: the means of faces between creases, weighted by
// angles, as corner_normals in viewer/render/draw.
void put_normals(const Surface& surface, std::uint32_t vertex, double least_cosine,
                 std::vector<Vector>& normals) {
    const std::uint32_t* around = surface.around.data() + surface.first[vertex];
    const std::size_t count = surface.first[vertex + 1] - surface.first[vertex];
    std::vector<std::size_t> group(count);
    for (std::size_t i = 0; i < count; ++i) {
        group[i] = i;
        for (std::size_t j = 0; j < i; ++j) {
            if (!are_joined(surface, around[i], around[j], least_cosine)) continue;
            group[first_of(group, j)] = first_of(group, i);
        }
    }
    std::vector<Vector> sums(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double weight = angle(surface, around[i]);
        const Vector& normal = surface.normals[around[i] / 3];
        Vector& sum = sums[first_of(group, i)];
        for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * normal[k];
    }
    for (std::size_t i = 0; i < count; ++i) normals[around[i]] = unit(sums[first_of(group, i)]);
}

void put_corners(const Surface& surface, double least_cosine, DrawnMesh& drawn) {
    const std::size_t count = surface.corners.size();
    std::vector<Vector> normals(count);
    for (std::uint32_t v = 0; v + 1 < surface.first.size(); ++v) {
        put_normals(surface, v, least_cosine, normals);
    }
    drawn.positions.resize(3 * count);
    drawn.normals.resize(3 * count);
    for (std::size_t c = 0; c < count; ++c) {
        const Vector place = position(surface, surface.corners[c]);
        for (std::size_t i = 0; i < 3; ++i) {
            drawn.positions[3 * c + i] = static_cast<float>(place[i]);
            drawn.normals[3 * c + i] = static_cast<float>(normals[c][i]);
        }
    }
    drawn.vertices = surface.corners;
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

// The edges of all faces, in ascending order.
lissom_status read_edges(lissom_context* context, lissom_mesh mesh,
                         std::vector<std::uint64_t>& edges) {
    const auto corner_count = static_cast<std::size_t>(lissom_mesh_corner_count(context, mesh));
    const auto face_count = static_cast<std::size_t>(lissom_mesh_face_count(context, mesh));
    std::vector<std::uint32_t> corners(corner_count), sizes(face_count);
    const lissom_output all{corners.data(), corner_count, 0, LISSOM_UINT32};
    const lissom_output counts{sizes.data(), face_count, 0, LISSOM_UINT32};
    const lissom_status status = lissom_mesh_read_faces(context, mesh, &all, &counts);
    if (status != LISSOM_OK) return status;
    std::size_t at = 0;
    for (const std::uint32_t size : sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            edges.push_back(edge_key(corners[at + k], corners[at + (k + 1) % size]));
        }
        at += size;
    }
    std::sort(edges.begin(), edges.end());
    return LISSOM_OK;
}

lissom_status put_edges(lissom_context* context, lissom_mesh mesh, const Surface& surface,
                        DrawnMesh& drawn) {
    drawn.edges.assign(surface.corners.size(), 1);
    if (lissom_mesh_face_count(context, mesh) == lissom_mesh_triangle_count(context, mesh)) {
        return LISSOM_OK;
    }
    std::vector<std::uint64_t> edges;
    const lissom_status status = read_edges(context, mesh, edges);
    if (status != LISSOM_OK) return status;
    for (std::size_t c = 0; c < surface.corners.size(); ++c) {
        const std::size_t triangle = c / 3 * 3;
        const auto key = edge_key(surface.corners[triangle + (c + 1) % 3],
                                  surface.corners[triangle + (c + 2) % 3]);
        drawn.edges[c] = std::binary_search(edges.begin(), edges.end(), key) ? 1 : 0;
    }
    return LISSOM_OK;
}

// Roots of strands, and the faces and weights that tell where on a mesh they are.
struct Roots {
    std::vector<float> points;
    std::vector<std::int32_t> offsets, faces;
    std::vector<float> weights;
};

bool read_roots(lissom_context* context, lissom_strands strands, Roots& roots) {
    if (lissom_strands_has(context, strands, LISSOM_STRAND_ROOT_FACE) != 1) return false;
    const auto count = static_cast<std::size_t>(lissom_strands_size(context, strands));
    const auto all = static_cast<std::size_t>(lissom_strands_point_count(context, strands));
    roots.points.resize(3 * all);
    roots.offsets.resize(count + 1);
    roots.faces.resize(count);
    roots.weights.resize(3 * count);
    const lissom_output points{roots.points.data(), all, 0, LISSOM_FLOAT32};
    const lissom_output offsets{roots.offsets.data(), count + 1, 0, LISSOM_INT32};
    const lissom_output faces{roots.faces.data(), count, 0, LISSOM_INT32};
    const lissom_output weights{roots.weights.data(), count, 0, LISSOM_FLOAT32};
    return lissom_strands_read_points(context, strands, &points) == LISSOM_OK &&
           lissom_strands_read_offsets(context, strands, &offsets) == LISSOM_OK &&
           lissom_strands_read(context, strands, LISSOM_STRAND_ROOT_FACE, &faces) == LISSOM_OK &&
           lissom_strands_read(context, strands, LISSOM_STRAND_ROOT_BARYCENTRIC, &weights) ==
               LISSOM_OK;
}

// The mean of places, and their mean square distance from it.
double spread(const std::vector<Vector>& places) {
    Vector mean{};
    double sum = 0.0;
    const auto count = static_cast<double>(places.size());
    for (const Vector& place : places) {
        for (std::size_t k = 0; k < 3; ++k) mean[k] += place[k] / count;
    }
    for (const Vector& place : places) {
        const Vector off = minus(place, mean);
        sum += dot(off, off);
    }
    return std::sqrt(sum);
}

// The place on its face that root `s` names.
Vector place_on_face(const Surface& surface, const Faces& faces, const Roots& roots,
                     std::size_t s) {
    Vector place{};
    const std::size_t first = faces.first[static_cast<std::size_t>(roots.faces[s])];
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector corner = position(surface, faces.corners[first + i]);
        const double weight = roots.weights[3 * s + i];
        for (std::size_t k = 0; k < 3; ++k) place[k] += weight * corner[k];
    }
    return place;
}

}  // namespace

double root_unit(lissom_context* context, lissom_strands strands, lissom_mesh mesh) {
    Roots roots;
    Faces faces;
    Surface surface;
    if (lissom_mesh_face_count(context, mesh) < 1 || !read_roots(context, strands, roots) ||
        read_surface(context, mesh, surface) != LISSOM_OK ||
        read_faces(context, mesh, faces) != LISSOM_OK) {
        return 0.0;
    }
    const auto face_count = static_cast<std::int32_t>(faces.first.size() - 1);
    std::vector<Vector> at_roots, on_faces;
    for (std::size_t s = 0; s < roots.faces.size(); ++s) {
        if (roots.faces[s] < 0 || roots.faces[s] >= face_count) continue;
        const float* root = roots.points.data() + 3 * static_cast<std::size_t>(roots.offsets[s]);
        at_roots.push_back({root[0], root[1], root[2]});
        on_faces.push_back(place_on_face(surface, faces, roots, s));
    }
    const double apart = spread(on_faces);
    return at_roots.size() > 1 && apart > 0.0 ? spread(at_roots) / apart : 0.0;
}

lissom_status draw_mesh(lissom_context* context, lissom_mesh mesh, double crease,
                        DrawnMesh& drawn) {
    KeptMesh kept;
    MeshChange change{};
    return draw_change(context, mesh, crease, kept, drawn, change);
}

lissom_status draw_change(lissom_context* context, lissom_mesh mesh, double crease, KeptMesh& kept,
                          DrawnMesh& drawn, MeshChange& change) {
    Surface surface;
    lissom_status status = read_surface(context, mesh, surface);
    if (status != LISSOM_OK) return status;
    const std::int32_t faces = lissom_mesh_face_count(context, mesh);
    const bool has_same_faces =
        kept.crease == crease && kept.faces == faces && kept.surface.corners == surface.corners;
    change = !has_same_faces                               ? MeshChange::all
             : kept.surface.positions == surface.positions ? MeshChange::none
                                                           : MeshChange::places;
    if (change == MeshChange::none) return LISSOM_OK;
    if (has_same_faces) {
        surface.first = std::move(kept.surface.first);
        surface.around = std::move(kept.surface.around);
        surface.face = std::move(kept.surface.face);
    } else {
        sort_corners(surface);
        status = find_faces(context, mesh, surface);
        if (status == LISSOM_OK) status = put_edges(context, mesh, surface, drawn);
    }
    find_normals(surface);
    put_corners(surface, std::cos(crease * std::numbers::pi / 180.0), drawn);
    kept = {std::move(surface), crease, status == LISSOM_OK ? faces : -1};
    return status;
}

}  // namespace lissom::wasm
