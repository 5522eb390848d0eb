#include "kernel/mesh/parameterize/uv_attribute.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace lissom {
namespace {

void require_map_of(const Mesh& mesh, const Parameterization& map) {
    const bool fits = !map.vertex.empty() && map.vertex.back() < mesh.vertex_count() &&
                      std::all_of(map.face.begin(), map.face.end(),
                                  [&](Index f) { return f < mesh.face_count(); });
    require(fits, "the map is of another mesh; lay this one out", ErrorCode::topology_mismatch);
}

void require_replaceable(const Attribute& attribute) {
    require(attribute.width == 2 && attribute.domain != Domain::face,
            "the attribute '" + attribute.name +
                "' holds no coordinates of the plane; choose another name, or remove it");
}

// The values of the corners that an attribute has: its own, those of their vertices, or none.
std::vector<double> corner_values(const Mesh& mesh, const Attribute* before) {
    const Topology& topology = mesh.topology();
    if (before && before->domain == Domain::corner) return before->values;
    std::vector<double> values(2 * at(topology.corner_count()), kNone);
    if (!before) return values;
    for (Index c = 0; c < topology.corner_count(); ++c) {
        const std::span<const double> value = before->at(topology.faces().vertices[at(c)]);
        std::copy(value.begin(), value.end(), values.begin() + 2 * std::ptrdiff_t{c});
    }
    return values;
}

std::vector<Vec2> placed_points(const Parameterization& map, UvPlacement placement) {
    if (placement == UvPlacement::as_is) return map.uv;
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec2& p : map.uv) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double side = (high - low).maxCoeff(), scale = side > 0.0 ? 1.0 / side : 1.0;
    std::vector<Vec2> result;
    result.reserve(map.uv.size());
    for (const Vec2& p : map.uv) {
        const Vec2 place = (p - 0.5 * (low + high)) * scale + Vec2(0.5, 0.5);
        result.emplace_back(place.cwiseMax(0.0).cwiseMin(1.0));
    }
    return result;
}

}  // namespace

void write_uv(Mesh& mesh, const Parameterization& map, std::string_view name,
              UvPlacement placement) {
    require_map_of(mesh, map);
    const Attribute* before = mesh.attributes().find(name);
    if (before) require_replaceable(*before);
    Attribute uv{std::string(name), Domain::corner, 2, before ? before->type : ScalarType::float32,
                 corner_values(mesh, before)};
    const std::vector<Vec2> points = placed_points(map, placement);
    std::vector<Index> place(at(mesh.vertex_count()), kNoIndex);
    for (Index i = 0; i < count_of(map.vertex); ++i) place[map.vertex[i]] = i;
    Index last = kNoIndex;
    for (const Index f : map.face) {
        // The triangles of a polygon follow one another.
        if (std::exchange(last, f) == f) continue;
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index i = place[face[k]];
            require(i != kNoIndex, "the map is of other faces; lay these out",
                    ErrorCode::topology_mismatch);
            const std::span<double> value = uv.at(mesh.topology().first_corner(f) + index_of(k));
            value[0] = points[i].x();
            value[1] = points[i].y();
        }
    }
    mesh.attributes().add(std::move(uv));
}

}  // namespace lissom
