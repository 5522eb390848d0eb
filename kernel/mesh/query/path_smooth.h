/// Smoothing of paths under a context.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

/// Like the functions of the same name in path.h, with progress; errors: also cancelled, and then
/// nothing was moved.
void smooth_path(Mesh& mesh, const Path& path, Index iterations, double strength,
                 const Context& context);
void smooth_path(Path& path, Index iterations, double strength, const Context& context);

}  // namespace lissom
