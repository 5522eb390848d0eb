#include "kernel/merge/paste/part/opened_target.h"

#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/mesh/cut/cut.h"

namespace lissom {
namespace {

// Vertices of the target come in their order, those that slid onto the line among them; then those
// that were made on it.
Places places_of(const CutPiece& rest, const std::vector<Index>& slid) {
    const ElementMap& vertices = rest.map.vertices;
    Index on_line = 0;
    for (Index v = 0; v < vertices.size(); ++v) on_line += vertices[v].size() > 1 ? 1 : 0;
    const Index old = vertices.size() - (on_line - count_of(slid));
    Places place;
    auto next = slid.begin();
    for (Index v = 0; v < vertices.size(); ++v) {
        const bool copied = vertices[v].size() == 1;
        place.vertices.push_back(v >= old ? kNoIndex
                                 : copied ? vertices[v].front().element
                                          : *next++);
    }
    for (Index f = 0; f < rest.map.faces.size(); ++f) {
        place.faces.push_back(rest.map.faces.main_source(f));
    }
    return place;
}

}  // namespace

OpenedTarget open_target(const Mesh& target, std::span<const Index> vertices,
                         std::span<const Vec2> uv, std::span<const Vec2> loop,
                         const Context& context) {
    if (crosses_itself(loop)) {
        throw Error(ErrorCode::boundary_conflict,
                    "the boundary of the paste crosses itself on the target; choose a smaller "
                    "scale, a smoother place, or another angle");
    }
    CutContour contour;
    contour.value.assign(at(target.vertex_count()), -1.0);
    if (!set_line_values(target.topology(), vertices, uv, loop, contour.value)) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target has no vertex under the part; subdivide the target there, or make "
                    "the part larger");
    }
    if (std::none_of(contour.value.begin(), contour.value.end(),
                     [](double x) { return x < 0.0; })) {
        throw Error(ErrorCode::boundary_conflict,
                    "the part covers all of the surface that it is put on; make it smaller");
    }
    Cut parts = cut(target, contour, {CutLoops::all, 0.25}, context);
    if (parts.lines.size() != 1 || !parts.lines.front().rest.closed()) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target is too coarse under the part to be opened along one line; "
                    "subdivide it there, or make the part larger");
    }
    Places place = places_of(parts.rest, parts.report.slid_vertices);
    return {std::move(parts.rest.mesh), std::move(parts.rest.map), std::move(place),
            parts.lines.front().rest.vertices()};
}

}  // namespace lissom
