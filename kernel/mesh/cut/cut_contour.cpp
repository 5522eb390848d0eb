#include <cmath>

#include "kernel/core/memory_error.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/cut_parts.h"

namespace lissom {
namespace {

void require_values(const Mesh& mesh, const CutContour& contour) {
    require(count_of(contour.value) == mesh.vertex_count(),
            "a contour needs one value for each vertex of the mesh");
    Elements elements{ElementKind::vertex, 0, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!std::isfinite(contour.value[at(v)])) elements.add(v);
    }
    if (elements.count == 0) return;
    throw Error(ErrorCode::not_finite,
                "the contour's values at " + describe(elements) + " are NaN or infinite", elements);
}

CutSides sides_of_values(const Mesh& mesh, const CutContour& contour,
                         const std::vector<ContourLine>& lines) {
    CutSides sides{sides_of(mesh, lines)};
    sides.named = true;
    const auto side_of = [&](const std::vector<Index>& component) -> signed char {
        double sum = 0.0;
        for (const Index v : component) sum += contour.value[at(v)];
        return sum > 0.0 ? 1 : -1;
    };
    sides.whole_components = assign_whole_components(mesh, sides.side, side_of);
    return sides;
}

}  // namespace

Cut cut(const Mesh& mesh, const CutContour& contour, const CutOptions& options,
        const Context& context) try {
    require_cuttable(mesh, options);
    require_values(mesh, contour);
    const LevelSet levels = level_set(mesh.topology(), contour.value, 0.0);
    CutLines found{trace_contours(mesh, levels, context), {}, {}};
    require(!found.lines.empty(),
            "the function has no line on which it is 0; its values must be "
            "above 0 at some vertices and below at others");
    CutSides sides = sides_of_values(mesh, contour, found.lines);
    return cut_along(mesh, std::move(found), std::move(sides), options, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
