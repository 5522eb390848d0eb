#include "kernel/mesh/measure/morph_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace lissom {
namespace {

bool has_value(std::span<const double> value) {
    return std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
}

Index vertex_at(const Mesh& mesh, const Attribute& attribute, Index element) {
    return attribute.domain == Domain::vertex ? element : mesh.topology().faces().vertices[element];
}

void add_to(std::span<double> value, const Vec3& change) {
    const bool known = has_value(value);
    for (std::size_t k = 0; k < 3; ++k) {
        value[k] = (known ? value[k] : 0.0) + change[static_cast<Index>(k)];
    }
}

}  // namespace

bool is_morph_position(const Attribute& attribute) {
    return role_of(attribute) == AttributeRole::morph_position && attribute.domain != Domain::face;
}

Index morph_count(const Mesh& mesh) {
    const std::vector<Attribute>& all = mesh.attributes().all();
    return index_of(std::count_if(all.begin(), all.end(), is_morph_position));
}

std::vector<Vec3> morph_displacements(const Mesh& mesh, const Attribute& attribute) {
    std::vector<Vec3> result(at(mesh.vertex_count()), Vec3::Zero());
    std::vector<Index> count(result.size(), 0);
    for (Index i = 0; i < attribute.size(); ++i) {
        const std::span<const double> value = attribute.at(i);
        if (!has_value(value)) continue;
        const std::size_t v = at(vertex_at(mesh, attribute, i));
        result[v] += Vec3(value[0], value[1], value[2]);
        ++count[v];
    }
    for (std::size_t v = 0; v < result.size(); ++v) {
        if (count[v] > 1) result[v] /= count[v];
    }
    return result;
}

void set_morph_displacements(const Mesh& mesh, Attribute& attribute,
                             const std::vector<Vec3>& displacements) {
    const std::vector<Vec3> before = morph_displacements(mesh, attribute);
    for (Index i = 0; i < attribute.size(); ++i) {
        const std::size_t v = at(vertex_at(mesh, attribute, i));
        if (before[v] == displacements[v]) continue;
        const std::span<double> value = attribute.at(i);
        if (attribute.domain == Domain::vertex) {
            for (std::size_t k = 0; k < 3; ++k) value[k] = displacements[v][static_cast<Index>(k)];
        } else {
            add_to(value, displacements[v] - before[v]);
        }
    }
}

MorphColumns mapped_morphs(const Mesh& mesh, const MorphMap& map) {
    MorphColumns columns;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (!is_morph_position(attribute)) continue;
        columns.emplace(attribute.name, map(morph_displacements(mesh, attribute)));
    }
    return columns;
}

void set_morphs(Mesh& mesh, const MorphColumns& columns) {
    for (const auto& [name, displacements] : columns) {
        set_morph_displacements(mesh, *mesh.attributes().find(name), displacements);
    }
}

}  // namespace lissom
