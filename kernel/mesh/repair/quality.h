/// Flags on a mesh that is sound but may still make trouble; private to kernel/mesh.
#pragma once

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Adds faces without area, slivers, small components and components that are inside out.
void flag_quality(const Mesh& mesh, Report& report);

}  // namespace lissom
