/// Appearance of the visible objects of a scene: meshes, strands and lines of a picture.
#pragma once

#include <vector>

#include "kernel/scene/scene_state.h"
#include "viewer/render/draw/drawing.h"
#include "viewer/render/draw/style_marks.h"

namespace lissom {

struct SceneDrawing {
    std::vector<DrawnMesh> meshes = {};
    std::vector<DrawnStrands> strands = {};
    /// Curves of hairstyles, and free curves.
    std::vector<DrawnLine> lines = {};
    /// Vertices of meshes without faces: of very many an even choice.
    std::vector<DrawnPoint> points = {};
    /// Fields and constraints of hairstyles, for who asks for them.
    NamedMarks field = {};
};

/// Draws each visible object in its place, by its style. A deformation is its mesh with region and
/// handles, also if the mesh is an object itself; hair takes its unit from the mesh that it is
/// rooted on. Meshes without faces are their vertices. Shares meshes and strands with the scene,
/// which must not change while they are drawn. Errors: those of style_lines.
SceneDrawing drawing_of(const ObjectList& objects);

}  // namespace lissom
