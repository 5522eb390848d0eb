#include "kernel/deform/rest_normals.h"

#include <algorithm>

#include "kernel/deform/polar.h"

namespace lissom {

RestNormals::RestNormals(const Mesh& mesh, const Region& region) {
    const Attribute* normals = mesh.attributes().find("normal");
    if (!normals || normals->width != 3 || normals->domain == Domain::face) return;
    domain_ = normals->domain;
    const auto add = [&](Index element, Index row) {
        const std::span<const double> n = normals->at(element);
        element_.push_back(element);
        row_.push_back(row);
        value_.emplace_back(n[0], n[1], n[2]);
    };
    const Topology& topology = mesh.topology();
    for (Index row = 0; row < region.size(); ++row) {
        const Index v = region.vertices()[row];
        if (domain_ == Domain::vertex) {
            add(v, row);
            continue;
        }
        for (const Index f : topology.faces_around(v)) {
            const std::span<const Index> face = topology.face(f);
            const auto at = std::find(face.begin(), face.end(), v) - face.begin();
            add(topology.first_corner(f) + static_cast<Index>(at), row);
        }
    }
}

void RestNormals::apply_to(Mesh& mesh, std::span<const Mat3> gradients) const {
    Attribute* normals = mesh.attributes().find("normal");
    if (element_.empty() || !normals || normals->domain != domain_ || normals->width != 3) return;
    for (std::size_t i = 0; i < element_.size(); ++i) {
        const Mat3& m = gradients[row_[i]];
        const Vec3 turned = m.isIdentity(0.0) ? value_[i] : Vec3(nearest_rotation(m) * value_[i]);
        const std::span<double> out = normals->at(element_[i]);
        std::copy(turned.data(), turned.data() + 3, out.begin());
    }
}

}  // namespace lissom
