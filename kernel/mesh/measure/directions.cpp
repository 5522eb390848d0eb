#include "kernel/mesh/measure/directions.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kernel/core/roots.h"
#include "kernel/core/rotation.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// Vertex that each element of the attribute belongs to; corner and vertex attributes have one.
Index vertex_of(const Mesh& mesh, const Attribute& attribute, Index element) {
    return attribute.domain == Domain::vertex ? element : mesh.topology().faces().vertices[element];
}

Vec3 mapped(const Mat3& map, std::span<const double> value) {
    return map * Vec3(value[0], value[1], value[2]);
}

// Keeps the length of unit vectors; a value that vanishes stays as it was.
void turn(const Mat3& map, bool is_unit, std::span<double> value) {
    Vec3 turned = mapped(map, value);
    const double length = turned.norm();
    if (is_unit && !(length > 0.0)) return;
    if (is_unit) turned /= length;
    std::copy_n(turned.data(), 3, value.data());
}

bool is_unit(AttributeRole role) {
    return role == AttributeRole::normal || role == AttributeRole::tangent;
}

// Offsets of morph targets go through the linear map of the positions.
bool turns_with_surface(const Attribute& attribute) {
    return is_direction(attribute) && attribute.domain != Domain::face &&
           role_of(attribute) != AttributeRole::morph_position;
}

bool has_directions(const Mesh& mesh) {
    const std::vector<Attribute>& all = mesh.attributes().all();
    return std::any_of(all.begin(), all.end(), turns_with_surface);
}

// Returns the map without its scale, so that offsets of unit vectors keep their size.
Mat3 without_scale(const Mat3& map) {
    return map / cube_root(std::abs(map.determinant()));
}

}  // namespace

bool is_direction(const Attribute& attribute) {
    const AttributeRole role = role_of(attribute);
    return is_unit(role) || role == AttributeRole::morph_position ||
           role == AttributeRole::morph_normal || role == AttributeRole::morph_tangent;
}

DirectionCarrier::DirectionCarrier(const Mesh& mesh) {
    if (has_directions(mesh)) before_ = vertex_normals(mesh);
}

void DirectionCarrier::follow(Mesh& mesh) const {
    if (before_.empty()) return;
    const std::vector<Vec3> after = vertex_normals(mesh);
    for (Attribute& attribute : mesh.attributes().all()) {
        if (!turns_with_surface(attribute)) continue;
        const bool unit = is_unit(role_of(attribute));
        for (Index i = 0; i < attribute.size(); ++i) {
            const Index v = vertex_of(mesh, attribute, i);
            if (before_[v] == after[v] || before_[v].isZero() || after[v].isZero()) continue;
            turn(min_rotation(before_[v], after[v]).toRotationMatrix(), unit, attribute.at(i));
        }
    }
}

void map_directions(AttributeSet& attributes, const Mat3& linear) {
    const double scale = linear.cwiseAbs().maxCoeff();
    const Mat3 tangents = without_scale(linear / scale);
    const Mat3 normals = without_scale((linear / scale).inverse().transpose());
    const bool mirrors = tangents.determinant() < 0.0;
    for (Attribute& attribute : attributes.all()) {
        if (!is_direction(attribute)) continue;
        const AttributeRole role = role_of(attribute);
        const bool across = role == AttributeRole::normal || role == AttributeRole::morph_normal;
        const Mat3& map = across                                  ? normals
                          : role == AttributeRole::morph_position ? linear
                                                                  : tangents;
        for (Index i = 0; i < attribute.size(); ++i) turn(map, is_unit(role), attribute.at(i));
        if (role != AttributeRole::tangent || !mirrors) continue;
        for (Index i = 0; i < attribute.size(); ++i) attribute.at(i)[3] *= -1.0;
    }
}

void negate_normals(AttributeSet& attributes) {
    for (Attribute& attribute : attributes.all()) {
        if (role_of(attribute) != AttributeRole::normal) continue;
        for (double& x : attribute.values) x = -x;
    }
}

}  // namespace lissom
