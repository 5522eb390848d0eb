#include "kernel/deform/rotation/rest_directions.h"

#include <algorithm>

#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/measure/directions.h"

namespace lissom {
namespace {

// Calls use(corner) for each corner at a vertex.
template <typename Use>
void for_each_corner(const Topology& topology, Index v, const Use& use) {
    for (const Index f : topology.faces_around(v)) {
        const std::span<const Index> face = topology.face(f);
        const auto at = std::find(face.begin(), face.end(), v) - face.begin();
        use(topology.first_corner(f) + static_cast<Index>(at));
    }
}

}  // namespace

RestDirections::RestDirections(const Mesh& mesh, const Region& region) {
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (!is_direction(attribute) || attribute.domain == Domain::face) continue;
        Values values{attribute.name, attribute.domain, attribute.width, {}, {}, {}};
        const auto add = [&](Index element, Index row) {
            const std::span<const double> n = attribute.at(element);
            values.element.push_back(element);
            values.row.push_back(row);
            values.value.emplace_back(n[0], n[1], n[2]);
        };
        for (Index row = 0; row < region.size(); ++row) {
            const Index v = region.vertices()[row];
            if (attribute.domain == Domain::vertex) {
                add(v, row);
            } else {
                for_each_corner(mesh.topology(), v, [&](Index corner) { add(corner, row); });
            }
        }
        attributes_.push_back(std::move(values));
    }
}

// Where nothing turned, values are to come back to the bit: then the rotation is exactly I.
std::vector<Mat3> RestDirections::rotations_of(std::span<const Mat3> gradients) {
    std::vector<Mat3> rotations;
    rotations.reserve(gradients.size());
    for (const Mat3& m : gradients)
        rotations.push_back(m.isIdentity(0.0) ? Mat3(Mat3::Identity()) : nearest_rotation(m));
    return rotations;
}

void RestDirections::apply_to(Mesh& mesh, std::span<const Mat3> gradients) const {
    if (empty()) return;
    const std::vector<Mat3> rotations = rotations_of(gradients);
    for (const Values& values : attributes_) {
        Attribute* target = mesh.attributes().find(values.name);
        if (!target || target->domain != values.domain || target->width != values.width) continue;
        for (std::size_t i = 0; i < values.value.size(); ++i) {
            const Vec3 turned = rotations[values.row[i]] * values.value[i];
            std::copy_n(turned.data(), 3, target->at(values.element[i]).begin());
        }
    }
}

void RestDirections::rebase(std::span<const Mat3> gradients) {
    const std::vector<Mat3> rotations = rotations_of(gradients);
    for (Values& values : attributes_) {
        for (std::size_t i = 0; i < values.value.size(); ++i) {
            values.value[i] = rotations[values.row[i]] * values.value[i];
        }
    }
}

}  // namespace lissom
