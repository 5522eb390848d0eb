/// The source of a paste along the boundary that its part was cut out at; private to kernel/merge.
#pragma once

#include "kernel/core/context.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Angles of the source along a part's boundary, on both sides of it, in radians: a foot that is
/// steep on the source may be so on the target.
struct SourceRest {
    /// Between faces at the boundary: the angle that a thirtieth of the length of their edges
    /// exceeds, and the RMS weighted by length.
    double steep = 0.0, roughness = 0.0;
    /// Between the planes of strips a third of the boundary's radius wide on either side of it: the
    /// RMS, and the greatest. 0 if the boundary is an open one of the source.
    double bend = 0.0, max_bend = 0.0;
    /// The part of its volume that is not the part's own but that of the round surface it stands
    /// on: of a dome over the boundary as steep as the surface around that. The target has another.
    double dome = 0.0;
};

/// Measures the source at the loop of a part of it. Errors: cancelled.
SourceRest source_rest(const Mesh& source, const PastePart& part, const Context& context);

}  // namespace lissom
