/// The edge of the hair: strands there are finer and shorter, and some are baby hair.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct StrandEdgeOptions {
    /// Factors of the widths and lengths of strands right at the edge; above 0, at most 1.
    double width = 0.45, length = 0.8;
    /// Share of the strands at the edge that are baby hair, 0 to 1, and the length of these in
    /// metres, at most, positive.
    double baby = 0.35, baby_length = 0.022;
    /// Distance in metres, about, that the tips of baby hair lean away from their way; 0 or more.
    double stray = 0.006;
    std::uint64_t seed = 1;
};

/// Returns for each strand its place at the edge: 0 at the hairline, 1 from `reach` metres of an
/// average head inside it, by its root on `head`, for which `scalp` was made. Errors:
/// invalid_argument if strands have no roots on it, or reach is not positive.
std::vector<float> inside_hairline(const Strands& strands, const Mesh& head, const Scalp& scalp,
                                   double reach);

/// Softens the edge of the hair: by `inside`, 0 to 1 for each strand, widths and lengths go from
/// the factors of the options to 1, and the share of baby hair, short, fine and astray, to 0. Roots
/// stay; the result of a strand depends on it, its id and the seed alone. Errors: invalid_argument
/// for options out of range, or a list of another length; memory_limit, cancelled.
void soften_edge(Strands& strands, const std::vector<float>& inside,
                 const StrandEdgeOptions& options = {}, const Context& context = {});

}  // namespace lissom
