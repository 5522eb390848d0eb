#include "bindings/c/attributes/attribute_space.h"

#include <algorithm>

namespace lissom::c {
namespace {

bool has_direction(const Attribute& attribute) {
    const AttributeRole role = role_of(attribute);
    return role == AttributeRole::normal || role == AttributeRole::tangent ||
           role == AttributeRole::morph_position || role == AttributeRole::morph_normal ||
           role == AttributeRole::morph_tangent;
}

}  // namespace

std::vector<Index> host_corners(const Topology& topology) {
    std::vector<Index> order;
    order.reserve(at(topology.corner_count()));
    for (Index f = 0; f < topology.face_count(); ++f) {
        const Index first = topology.first_corner(f), n = count_of(topology.face(f));
        for (Index k = 0; k < n; ++k) order.push_back(k == 0 ? first : first + n - k);
    }
    return order;
}

void reorder(Attribute& attribute, const std::vector<Index>& order) {
    const Attribute given = attribute;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto from = given.at(index_of(i));
        std::copy(from.begin(), from.end(), attribute.at(order[i]).begin());
    }
}

void to_kernel_space(Attribute& attribute, const Space& space) {
    if (!has_direction(attribute)) return;
    for (Index i = 0; i < attribute.size(); ++i) {
        const auto values = attribute.at(i);
        const Vec3 turned = space.to_kernel(Vec3(values[0], values[1], values[2]));
        std::copy(turned.data(), turned.data() + 3, values.begin());
        if (values.size() == 4 && space.mirrors()) values[3] = -values[3];
    }
}

std::vector<double> host_values(const Attribute& attribute, Index element, const Space& space) {
    const auto own = attribute.at(element);
    std::vector<double> values(own.begin(), own.end());
    if (!has_direction(attribute)) return values;
    const Vec3 turned = space.to_host(Vec3(values[0], values[1], values[2]));
    std::copy(turned.data(), turned.data() + 3, values.begin());
    if (values.size() == 4 && space.mirrors()) values[3] = -values[3];
    return values;
}

}  // namespace lissom::c
