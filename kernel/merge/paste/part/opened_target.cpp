#include "kernel/merge/paste/part/opened_target.h"

#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/mesh/cut/cut.h"

namespace lissom {
OpenedTarget open_target(const Mesh& target, const PasteChart& chart, std::span<const Vec2> loop,
                         const Context& context) {
    if (crosses_itself(loop)) {
        throw Error(ErrorCode::boundary_conflict,
                    "the boundary of the paste crosses itself on the target; choose a smaller "
                    "scale, a smoother place, or another angle");
    }
    CutContour contour;
    contour.value.assign(at(target.vertex_count()), -1.0);
    if (!set_line_values(target.topology(), chart.map.vertex, chart.map.uv, loop, contour.value)) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target has no vertex under the part; subdivide the target there, or make "
                    "the part larger");
    }
    Cut parts = cut(target, contour, {CutLoops::all, 0.25}, context);
    if (parts.lines.size() != 1 || !parts.lines.front().rest.closed()) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target is too coarse under the part to be opened along one line; "
                    "subdivide it there, or make the part larger");
    }
    return {std::move(parts.rest.mesh), std::move(parts.rest.map),
            parts.lines.front().rest.vertices()};
}

}  // namespace lissom
