/// Cleaning of single faces: repeats, pinches and copies; private to kernel/mesh.
#pragma once

#include "kernel/core/index.h"
#include "kernel/mesh/corner_faces.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Drops repeats of a vertex in a row, splits faces at vertices that they pass twice and drops
/// faces left with fewer than three vertices. Adds to `report` the faces concerned, as numbered in
/// the file.
void clean_faces(CornerFaces& work, Report& report);

/// Drops duplicate faces: faces with the vertices of an earlier face in the same cyclic order, a
/// repeated face in reverse if the surface is complete without it, and flaps: pairs of equal faces
/// that only hang on an edge of a complete surface.
void drop_duplicates(Index vertex_count, CornerFaces& work, Report& report);

}  // namespace lissom
