#include "tests/bench/peers/cgal_deform.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "tests/bench/report.h"

namespace lissom::bench {

struct CgalDeformer::Implementation {
    virtual ~Implementation() = default;
    virtual void preprocess() = 0;
    virtual void reset() = 0;
    virtual void move(const Affine& transform) = 0;
    virtual void deform() = 0;
    virtual void deform(int iterations) = 0;
    virtual std::vector<Vec3> positions() const = 0;
};

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Surface::Vertex_index;

Surface to_cgal(const Mesh& mesh) {
    Surface surface;
    for (const Vec3& p : mesh.positions()) surface.add_vertex({p.x(), p.y(), p.z()});
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Vertex> face;
        for (const Index v : mesh.topology().face(f)) face.emplace_back(v);
        surface.add_face(face);
    }
    return surface;
}

template <CGAL::Deformation_algorithm_tag tag>
class Energy : public CgalDeformer::Implementation {
  public:
    Energy(const Mesh& mesh, const std::vector<Index>& still, const std::vector<Index>& moved)
        : surface_(to_cgal(mesh)), deformation_(surface_) {
        for (const Vertex v : surface_.vertices()) deformation_.insert_roi_vertex(v);
        for (const Index v : still) deformation_.insert_control_vertex(Vertex(v));
        for (const Index v : moved) {
            deformation_.insert_control_vertex(Vertex(v));
            moved_.emplace_back(v, mesh.position(v));
        }
    }
    void preprocess() override { deformation_.preprocess(); }
    void reset() override { deformation_.reset(); }
    void move(const Affine& transform) override {
        for (const auto& [v, rest] : moved_) {
            const Vec3 p = transform(rest);
            deformation_.set_target_position(v, {p.x(), p.y(), p.z()});
        }
    }
    void deform() override { deformation_.deform(); }
    void deform(int iterations) override {
        deformation_.deform(static_cast<unsigned>(iterations), 0.0);
    }
    std::vector<Vec3> positions() const override {
        std::vector<Vec3> result;
        for (const Vertex v : surface_.vertices()) {
            const Kernel::Point_3& p = surface_.point(v);
            result.emplace_back(p.x(), p.y(), p.z());
        }
        return result;
    }

  private:
    using Deformation = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, tag>;

    Surface surface_;
    Deformation deformation_;
    std::vector<std::pair<Vertex, Vec3>> moved_;
};

std::unique_ptr<CgalDeformer::Implementation> implementation_of(const Mesh& mesh, CgalMethod method,
                                                                const std::vector<Index>& still,
                                                                const std::vector<Index>& moved) {
    switch (method) {
        case CgalMethod::original_arap:
            return std::make_unique<Energy<CGAL::ORIGINAL_ARAP>>(mesh, still, moved);
        case CgalMethod::spokes_and_rims:
            return std::make_unique<Energy<CGAL::SPOKES_AND_RIMS>>(mesh, still, moved);
        case CgalMethod::sre_arap:
            break;
    }
    return std::make_unique<Energy<CGAL::SRE_ARAP>>(mesh, still, moved);
}

}  // namespace

CgalDeformer::CgalDeformer(const Mesh& mesh, CgalMethod method, const std::vector<Index>& still,
                           const std::vector<Index>& moved)
    : implementation_(implementation_of(mesh, method, still, moved)) {}
CgalDeformer::~CgalDeformer() = default;
CgalDeformer::CgalDeformer(CgalDeformer&&) noexcept = default;

void CgalDeformer::preprocess() {
    implementation_->preprocess();
}
void CgalDeformer::reset() {
    implementation_->reset();
}
void CgalDeformer::move(const Affine& transform) {
    implementation_->move(transform);
}
void CgalDeformer::deform() {
    implementation_->deform();
}
void CgalDeformer::deform(int iterations) {
    implementation_->deform(iterations);
}
std::vector<Vec3> CgalDeformer::positions() const {
    return implementation_->positions();
}

}  // namespace lissom::bench
