#include "kernel/merge/crossings/shallow_crossings.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// Rings of faces around a crossing that draw back with it.
constexpr int kDrawnRings = 3;
// Parts of the depth that are tried: thin parts run into themselves if they draw back by much.
constexpr double kDrawnParts[] = {0.1, 0.25, 0.5, 1.0};

void sort_out(std::vector<Index>& elements) {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

std::vector<Index> faces_of_pairs(std::span<const FacePair> pairs) {
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        faces.push_back(pair.first);
        faces.push_back(pair.second);
    }
    sort_out(faces);
    return faces;
}

std::vector<Index> vertices_of_faces(const Mesh& mesh, std::span<const Index> faces) {
    std::vector<Index> vertices;
    for (const Index f : faces) {
        const std::span<const Index> face = mesh.topology().face(f);
        vertices.insert(vertices.end(), face.begin(), face.end());
    }
    sort_out(vertices);
    return vertices;
}

std::vector<Index> grown_faces(const Mesh& mesh, std::vector<Index> faces, int rings) {
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<Index> more;
        for (const Index v : vertices_of_faces(mesh, faces)) {
            const auto around = mesh.topology().faces_around(v);
            more.insert(more.end(), around.begin(), around.end());
        }
        sort_out(more);
        faces = std::move(more);
    }
    return faces;
}

bool is_one_of(const std::vector<Index>& sorted, Index f) {
    return std::binary_search(sorted.begin(), sorted.end(), f);
}

// The faces around pairs, and which of them crossed others before.
struct CrossingFaces {
    std::vector<Index> faces, vertices, known;
};

CrossingFaces faces_around_crossing(const Mesh& mesh, std::span<const FacePair> pairs,
                                    const Context& context) {
    CrossingFaces around;
    around.faces = grown_faces(mesh, faces_of_pairs(pairs), kDrawnRings);
    around.vertices = vertices_of_faces(mesh, around.faces);
    std::vector<FacePair> sorted(pairs.begin(), pairs.end()), others;
    std::sort(sorted.begin(), sorted.end());
    for (const FacePair& pair : self_intersections(mesh, {around.faces, around.faces}, context)) {
        if (!std::binary_search(sorted.begin(), sorted.end(), pair)) others.push_back(pair);
    }
    around.known = faces_of_pairs(others);
    return around;
}

// Whether no faces cross but some that crossed others before.
bool draw_apart(const Mesh& drawn, const CrossingFaces& around, const Context& context) {
    const auto left = self_intersections(drawn, {around.faces, around.faces}, context);
    return std::all_of(left.begin(), left.end(), [&](const FacePair& pair) {
        return is_one_of(around.known, pair.first) && is_one_of(around.known, pair.second);
    });
}

}  // namespace

bool is_shallow(const Mesh& mesh, std::span<const FacePair> pairs, double depth,
                const Context& context) {
    const CrossingFaces around = faces_around_crossing(mesh, pairs, context);
    const std::vector<Vec3> normals = vertex_normals(mesh);
    Mesh drawn = mesh;
    for (const double share : kDrawnParts) {
        for (const double side : {-1.0, 1.0}) {
            for (const Index v : around.vertices) {
                drawn.set_position(v, mesh.position(v) + side * share * depth * normals[at(v)]);
            }
            if (draw_apart(drawn, around, context)) return true;
        }
    }
    return false;
}

}  // namespace lissom
