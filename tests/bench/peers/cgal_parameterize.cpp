#include "tests/bench/peers/cgal_parameterize.h"

// Without these CGAL solves by conjugate gradients of its own, several times slower.
#define CGAL_EIGEN3_ENABLED 1

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Two_vertices_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

namespace lissom::bench {
namespace {

using LscmKernel = CGAL::Simple_cartesian<double>;
using LscmSurface = CGAL::Surface_mesh<LscmKernel::Point_3>;
using LscmVertex = LscmSurface::Vertex_index;
using LscmBorder = CGAL::Surface_mesh_parameterization::Two_vertices_parameterizer_3<LscmSurface>;
using LscmSolver =
    CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<CGAL::Eigen_sparse_matrix<double>::EigenType>>;
using Lscm =
    CGAL::Surface_mesh_parameterization::LSCM_parameterizer_3<LscmSurface, LscmBorder, LscmSolver>;

}  // namespace

struct CgalParameterizer::Implementation {
    LscmSurface surface;
    LscmSurface::Property_map<LscmVertex, LscmKernel::Point_2> uv;
};

CgalParameterizer::CgalParameterizer(const Mesh& mesh)
    : implementation_(std::make_unique<Implementation>()) {
    LscmSurface& surface = implementation_->surface;
    for (const Vec3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<LscmVertex> face;
        for (const Index v : mesh.topology().face(f)) face.emplace_back(v);
        surface.add_face(face);
    }
    implementation_->uv = surface.add_property_map<LscmVertex, LscmKernel::Point_2>("v:uv").first;
}

CgalParameterizer::~CgalParameterizer() = default;

std::vector<Vec2> CgalParameterizer::lay_out() {
    LscmSurface& surface = implementation_->surface;
    const auto border = CGAL::Polygon_mesh_processing::longest_border(surface).first;
    CGAL::Surface_mesh_parameterization::parameterize(surface, Lscm(), border, implementation_->uv);
    std::vector<Vec2> result;
    for (const LscmVertex v : surface.vertices()) {
        const LscmKernel::Point_2& p = implementation_->uv[v];
        result.emplace_back(p.x(), p.y());
    }
    return result;
}

}  // namespace lissom::bench
