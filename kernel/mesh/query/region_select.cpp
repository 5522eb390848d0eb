#include "kernel/mesh/query/region_select.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

template <typename Predicate>
Region select(const Mesh& mesh, const Predicate& predicate) {
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (predicate(v, mesh.position(v))) vertices.push_back(v);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

template <typename Predicate>
Region select_by_face(const Mesh& mesh, const Predicate& predicate) {
    std::vector<Index> vertices;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!predicate(f)) continue;
        const std::span<const Index> face = mesh.topology().face(f);
        vertices.insert(vertices.end(), face.begin(), face.end());
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

void require_radius(double radius) {
    if (radius >= 0.0 && std::isfinite(radius)) return;
    throw Error(ErrorCode::invalid_argument, "the radius must be a finite number, 0 or more");
}

void require_finite_option(const Vec3& v, const char* what) {
    if (v.allFinite()) return;
    throw Error(ErrorCode::not_finite, std::string(what) + " is NaN or infinite");
}

void require_range(double min, double max) {
    if (min <= max) return;
    throw Error(ErrorCode::invalid_argument, "the range needs min <= max, and neither NaN");
}

// "a, b and 3 more", for messages that list the names there are.
template <typename Names>
std::string listed(const Names& names) {
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : names) {
        if (++count <= 10) text += (count == 1 ? "" : ", ") + name;
    }
    if (count > 10) text += " and " + std::to_string(count - 10) + " more";
    return count == 0 ? "none" : text;
}

Index label_index(const FaceLabels* labels, std::string_view kind, std::string_view label) {
    if (labels) {
        const auto found = std::find(labels->names.begin(), labels->names.end(), label);
        if (found != labels->names.end()) return index_of(found - labels->names.begin());
    }
    throw Error(ErrorCode::invalid_argument,
                "the mesh has no " + std::string(kind) + " called \"" + std::string(label) +
                    "\"; it has: " + listed(labels ? labels->names : std::vector<std::string>{}));
}

}  // namespace

Region select_sphere(const Mesh& mesh, const Vec3& center, double radius) {
    require_finite_option(center, "the center");
    require_radius(radius);
    return select(mesh, [&](Index, const Vec3& p) { return (p - center).norm() <= radius; });
}

Region select_box(const Mesh& mesh, const Box& box) {
    if (!(box.min.array() <= box.max.array()).all()) {
        throw Error(ErrorCode::invalid_argument,
                    "the box needs min <= max on every axis; a side that is open is infinite");
    }
    return select(mesh, [&](Index, const Vec3& p) { return box.contains(p); });
}

Region select_fraction(const Mesh& mesh, const Box& fractions) {
    const Box whole = bounds(mesh);
    Box box = fractions;
    for (int axis = 0; axis < 3 && !whole.empty(); ++axis) {
        for (double* side : {&box.min[axis], &box.max[axis]}) {
            // Exact at 0 and 1, and infinite if the fraction is.
            if (std::isfinite(*side)) *side = std::lerp(whole.min[axis], whole.max[axis], *side);
        }
    }
    return select_box(mesh, box);
}

Region connected_part(const Region& region, Index vertex) {
    if (!region.contains(vertex)) {
        Elements named{ElementKind::vertex, 1, {vertex}};
        const std::string name = describe(named);
        throw Error(ErrorCode::out_of_range,
                    name + " is not in the region, so no part of it is connected with it",
                    std::move(named));
    }
    std::vector<char> open = region.mask();
    std::vector<Index> part{vertex};
    open[vertex] = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        for (const Index n : region.topology()->neighbors(part[i])) {
            if (std::exchange(open[n], 0)) part.push_back(n);
        }
    }
    return {region.topology(), std::move(part)};
}

Region connected_part(const Mesh& mesh, const Region& region, const Vec3& point) {
    require_same_topology(mesh, region.topology(), "the region");
    require_finite_option(point, "the point");
    if (region.empty()) {
        throw Error(ErrorCode::region_empty, "a region without vertices has no connected part");
    }
    const std::vector<Index>& all = region.vertices();
    const auto nearer = [&](Index a, Index b) {
        return (mesh.position(a) - point).squaredNorm() < (mesh.position(b) - point).squaredNorm();
    };
    return connected_part(region, *std::min_element(all.begin(), all.end(), nearer));
}

Region select_plane(const Mesh& mesh, const Vec3& point, const Vec3& normal) {
    require_finite_option(point, "the point");
    require_finite_option(normal, "the normal");
    if (normal.isZero(0.0)) {
        throw Error(ErrorCode::invalid_argument, "the plane's normal has no length");
    }
    return select(mesh, [&](Index, const Vec3& p) { return (p - point).dot(normal) >= 0.0; });
}

Region select_geodesic(const Mesh& mesh, std::span<const Index> from, double radius,
                       const Context& context) {
    require_radius(radius);
    const std::vector<double> distance = heat_distances(mesh, from, context);
    return select(mesh, [&](Index v, const Vec3&) { return distance[v] <= radius; });
}

Region select_around(const Mesh& mesh, const SurfacePoint& from, double radius,
                     const Context& context) {
    require_radius(radius);
    const std::vector<double> distance = HeatDistances(mesh, context).from_point(from, context);
    return select(mesh, [&](Index v, const Vec3&) { return distance[v] <= radius; });
}

Region select_label(const Mesh& mesh, std::string_view kind, std::string_view label) {
    const auto& all = mesh.attributes().labels();
    const auto found = all.find(kind);
    const FaceLabels* labels = found == all.end() ? nullptr : &found->second;
    const Index wanted = label_index(labels, kind, label);
    return select_by_face(mesh, [&](Index f) { return labels->of_face[f] == wanted; });
}

Region select_group(const Mesh& mesh, std::string_view group) {
    return select_label(mesh, "group", group);
}

Region select_material(const Mesh& mesh, std::string_view material) {
    return select_label(mesh, "material", material);
}

Region select_component(const Mesh& mesh, Index number) {
    const Topology& topology = mesh.topology();
    if (number < 0 || number >= topology.component_count()) {
        throw Error(ErrorCode::out_of_range,
                    "component " + std::to_string(number) + " is not one of the " +
                        std::to_string(topology.component_count()) + " of the mesh",
                    {ElementKind::component, 1, {number}});
    }
    return select(mesh, [&](Index v, const Vec3&) { return topology.components()[v] == number; });
}

Region select_component_of(const Mesh& mesh, Index vertex) {
    const Region known(mesh.shared_topology(), {vertex});
    return select_component(mesh, mesh.topology().components()[known.vertices()[0]]);
}

Region select_attribute(const Mesh& mesh, std::string_view name, double min, double max) {
    require_range(min, max);
    const Attribute* attribute = mesh.attributes().find(name);
    if (!attribute) {
        std::vector<std::string> names;
        for (const Attribute& a : mesh.attributes().all()) names.push_back(a.name);
        throw Error(
            ErrorCode::invalid_argument,
            "the mesh has no attribute \"" + std::string(name) + "\"; it has: " + listed(names));
    }
    const auto in_range = [&](Index element) {
        const double value = attribute->at(element)[0];
        return min <= value && value <= max;
    };
    if (attribute->domain == Domain::vertex) {
        return select(mesh, [&](Index v, const Vec3&) { return in_range(v); });
    }
    if (attribute->domain == Domain::face) return select_by_face(mesh, in_range);
    const std::vector<Index>& vertex_of = mesh.topology().faces().vertices;
    std::vector<Index> vertices;
    for (Index c = 0; c < mesh.topology().corner_count(); ++c) {
        if (in_range(c)) vertices.push_back(vertex_of[c]);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

Region select_where(const Mesh& mesh,
                    const std::function<bool(Index vertex, const Vec3& position)>& predicate) {
    return select(mesh, predicate);
}

}  // namespace lissom
