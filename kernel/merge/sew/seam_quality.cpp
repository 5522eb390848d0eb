#include "kernel/merge/sew/seam_quality.h"

#include "kernel/merge/loop/face_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace lissom {
namespace {

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
            quality.greatest_dihedral = std::max(quality.greatest_dihedral, angle);
            squares += edge * angle * angle;
            length += edge;
        }
        quality.vertices += count_of(seam);
    }
    if (length > 0.0) quality.rms_dihedral = std::sqrt(squares / length);
    if (quality.vertices > 0) quality.mean_edge = length / quality.vertices;
}

void measure_near_edges(const Mesh& mesh, const std::set<Index>& on_seam, SeamQuality& quality) {
    std::set<Index> near = on_seam;
    for (const Index v : on_seam) {
        const std::span<const Index> ring = mesh.topology().neighbors(v);
        near.insert(ring.begin(), ring.end());
    }
    for (const Index v : near) {
        for (const Index w : mesh.topology().neighbors(v)) {
            quality.greatest_near = std::max(quality.greatest_near, edge_dihedral(mesh, v, w));
        }
    }
}

void measure_triangles(const Mesh& mesh, const std::set<Index>& on_seam, SeamQuality& quality) {
    std::set<Index> faces;
    for (const Index v : on_seam) {
        const std::span<const Index> around = mesh.topology().faces_around(v);
        faces.insert(around.begin(), around.end());
    }
    std::vector<double> angles;
    for (const Index f : faces) {
        if (mesh.topology().face(f).size() == 3) angles.push_back(smallest_face_angle(mesh, f));
    }
    if (angles.empty()) return;
    std::sort(angles.begin(), angles.end());
    quality.smallest_angle = angles.front();
    quality.low_angle = angles[angles.size() / 20];
}

}  // namespace

SeamQuality seam_quality(const Mesh& mesh, std::span<const std::vector<Index>> seams) {
    SeamQuality quality;
    std::set<Index> on_seam;
    for (const std::vector<Index>& seam : seams) {
        require_vertices(mesh.topology(), seam);
        on_seam.insert(seam.begin(), seam.end());
    }
    measure_seam_edges(mesh, seams, quality);
    measure_near_edges(mesh, on_seam, quality);
    measure_triangles(mesh, on_seam, quality);
    return quality;
}

}  // namespace lissom
