#include "tests/bench/cgal_deform.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface to_cgal(const Mesh& mesh) {
    Surface surface;
    for (const Vec3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Surface::Vertex_index> face;
        for (const Index v : mesh.topology().face(f)) face.emplace_back(v);
        surface.add_face(face);
    }
    return surface;
}

template <CGAL::Deformation_algorithm_tag tag>
CgalTimes run(const Mesh& mesh, const std::vector<Index>& still, const std::vector<Index>& moved,
              int frames, const std::function<Affine(int)>& move) {
    using Deformation = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, tag>;
    Surface surface = to_cgal(mesh);
    Deformation deformation(surface);
    for (const auto v : surface.vertices()) deformation.insert_roi_vertex(v);
    for (const Index v : still) deformation.insert_control_vertex(Surface::Vertex_index(v));
    for (const Index v : moved) deformation.insert_control_vertex(Surface::Vertex_index(v));
    CgalTimes times;
    times.preprocess = seconds([&] { deformation.preprocess(); });
    int frame = 0;
    times.frame = median_seconds(frames, [&] {
        const Affine transform = move(frame++);
        for (const Index v : moved) {
            const Vec3 p = transform(mesh.position(v));
            deformation.set_target_position(Surface::Vertex_index(v), {p.x(), p.y(), p.z()});
        }
        deformation.deform();
    });
    return times;
}

}  // namespace

CgalTimes time_cgal(const Mesh& mesh, CgalMethod method, const std::vector<Index>& still,
                    const std::vector<Index>& moved, int frames,
                    const std::function<Affine(int)>& move) {
    return method == CgalMethod::sre_arap
               ? run<CGAL::SRE_ARAP>(mesh, still, moved, frames, move)
               : run<CGAL::ORIGINAL_ARAP>(mesh, still, moved, frames, move);
}

}  // namespace lissom::bench
