#include "kernel/merge/sew/seam_quality.h"

#include "kernel/merge/loop/face_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace lissom {
namespace {

void sort_unique(std::vector<Index>& elements) {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

void measure_seam_edges(const Mesh& mesh, std::span<const std::vector<Index>> seams,
                        SeamQuality& quality) {
    double length = 0.0, squares = 0.0;
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            const Index a = seam[k], b = seam[(k + 1) % seam.size()];
            const std::span<const Index> ring = mesh.topology().neighbors(a);
            if (std::find(ring.begin(), ring.end(), b) == ring.end()) {
                throw Error(ErrorCode::invalid_argument,
                            "consecutive vertices of a seam share no edge",
                            {ElementKind::vertex, 2, {a, b}});
            }
            const double angle = edge_dihedral(mesh, a, b);
            const double edge = (mesh.position(b) - mesh.position(a)).norm();
            quality.max_dihedral = std::max(quality.max_dihedral, angle);
            squares += edge * angle * angle;
            length += edge;
        }
        quality.vertices += count_of(seam);
    }
    if (length > 0.0) quality.rms_dihedral = std::sqrt(squares / length);
    if (quality.vertices > 0) quality.mean_edge = length / quality.vertices;
}

// Dihedral angles at the edges of a vertex, but those to vertices that were asked before: of
// `asked`, ascending, the ones with lower numbers.
void measure_spokes(const Mesh& mesh, Index v, std::span<const Index> asked,
                    std::vector<Vec3>& normals, GreatestAngle& greatest) {
    // The face on the left of the k-th spoke is the k-th, but for the last spoke of an open fan.
    const std::span<const Index> ring = mesh.topology().neighbors(v);
    normals.clear();
    for (const Index f : mesh.topology().faces_around(v)) {
        normals.push_back(clear_area_vector(mesh, f));
    }
    const std::size_t n = normals.size();
    const bool open = n < ring.size();
    for (std::size_t k = open ? 1 : 0; k < n; ++k) {
        if (ring[k] < v && std::binary_search(asked.begin(), asked.end(), ring[k])) continue;
        const Vec3 &left = normals[k], &right = normals[(k + n - 1) % n];
        if (left.squaredNorm() > 0.0 && right.squaredNorm() > 0.0) greatest.add(left, right);
    }
}

void measure_near_edges(const Mesh& mesh, std::span<const Index> on_seam, SeamQuality& quality) {
    std::vector<Index> near(on_seam.begin(), on_seam.end());
    for (const Index v : on_seam) {
        const std::span<const Index> ring = mesh.topology().neighbors(v);
        near.insert(near.end(), ring.begin(), ring.end());
    }
    sort_unique(near);
    GreatestAngle greatest;
    std::vector<Vec3> normals;
    for (const Index v : near) measure_spokes(mesh, v, near, normals, greatest);
    quality.max_near = greatest.value();
}

// The smallest angle of a polygon divided by the fan of diagonals that suits it best.
double divided_angle(const Mesh& mesh, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    const std::size_t n = face.size();
    const auto corner = [&](std::size_t k) { return mesh.position(face[k % n]); };
    double best = 0.0;
    for (std::size_t from = 0; from < n; ++from) {
        double least = kPi;
        for (std::size_t k = 1; k + 1 < n; ++k) {
            least = std::min(least,
                             smallest_angle(corner(from), corner(from + k), corner(from + k + 1)));
        }
        best = std::max(best, least);
    }
    return best;
}

void measure_triangles(const Mesh& mesh, std::span<const Index> on_seam, SeamQuality& quality) {
    std::vector<Index> faces;
    for (const Index v : on_seam) {
        const std::span<const Index> around = mesh.topology().faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    sort_unique(faces);
    std::vector<double> angles;
    for (const Index f : faces) {
        if (mesh.topology().face(f).size() == 3) {
            angles.push_back(smallest_face_angle(mesh, f));
        } else {
            const double angle = divided_angle(mesh, f), least = quality.polygon_angle;
            quality.polygon_angle = least > 0.0 ? std::min(least, angle) : angle;
        }
    }
    if (angles.empty()) return;
    std::sort(angles.begin(), angles.end());
    quality.smallest_angle = angles.front();
    quality.low_angle = angles[angles.size() / 20];
}

}  // namespace

SeamQuality seam_quality(const Mesh& mesh, std::span<const std::vector<Index>> seams) {
    SeamQuality quality;
    std::vector<Index> on_seam;
    for (const std::vector<Index>& seam : seams) {
        require_vertices(mesh.topology(), seam);
        on_seam.insert(on_seam.end(), seam.begin(), seam.end());
    }
    sort_unique(on_seam);
    measure_seam_edges(mesh, seams, quality);
    measure_near_edges(mesh, on_seam, quality);
    measure_triangles(mesh, on_seam, quality);
    return quality;
}

}  // namespace lissom
