#include "kernel/mesh/normals.h"

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/mesh/measures.h"

namespace lissom {
namespace {

Attribute* normals_of(Mesh& mesh) {
    Attribute* normals = mesh.attributes().find("normal");
    return normals && normals->width == 3 ? normals : nullptr;
}

// Vertex that each element of the attribute belongs to; corner and vertex attributes have one.
Index vertex_of(const Mesh& mesh, const Attribute& attribute, Index element) {
    return attribute.domain == Domain::vertex ? element : mesh.topology().faces().vertices[element];
}

void turn_normal(const Mat3& map, std::span<double> normal) {
    const Vec3 turned = map * Vec3(normal[0], normal[1], normal[2]);
    const double length = turned.norm();
    if (!(length > 0.0)) return;
    for (int k = 0; k < 3; ++k) normal[k] = turned[k] / length;
}

}  // namespace

NormalCarrier::NormalCarrier(const Mesh& mesh) {
    const Attribute* normals = mesh.attributes().find("normal");
    if (!normals || normals->width != 3 || normals->domain == Domain::face) return;
    before_ = vertex_normals(mesh);
}

void NormalCarrier::follow(Mesh& mesh) const {
    if (before_.empty()) return;
    Attribute* normals = normals_of(mesh);
    const std::vector<Vec3> after = vertex_normals(mesh);
    for (Index i = 0; i < normals->size(); ++i) {
        const Index v = vertex_of(mesh, *normals, i);
        if (before_[v] == after[v] || before_[v].isZero() || after[v].isZero()) continue;
        turn_normal(Eigen::Quaterniond::FromTwoVectors(before_[v], after[v]).toRotationMatrix(),
                    normals->at(i));
    }
}

void negate_normals(Mesh& mesh) {
    if (Attribute* normals = normals_of(mesh)) {
        for (double& x : normals->values) x = -x;
    }
}

void map_normals(Mesh& mesh, const Mat3& map) {
    Attribute* normals = normals_of(mesh);
    if (!normals) return;
    for (Index i = 0; i < normals->size(); ++i) turn_normal(map, normals->at(i));
}

}  // namespace lissom
