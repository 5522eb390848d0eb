/// Consistent orientation of faces; private to kernel/mesh.
#pragma once

#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/corner_faces.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Vector area of a polygon (Newell): its length is the area, its direction the normal.
Vec3 vector_area(std::span<const Vec3> positions, std::span<const Index> face);

/// Turns faces over until neighbours at edges with exactly two faces run along them in opposite
/// directions. A connected piece that was consistent stays as it is; another that is closed ends up
/// facing outward, and an open one as the greater part of its area did. On a surface with one side
/// only some edges stay in conflict. Adds the faces turned, as numbered in the file.
void orient_faces(std::span<const Vec3> positions, CornerFaces& work, Report& report);

}  // namespace lissom
