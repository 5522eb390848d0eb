/// ToolView: the marks that a tool draws over the picture, as its methods have read them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/registry.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/core/memory_hold.h"

namespace lissom::lua {

/// Balls at points of the world. Colours are "#rrggbb" here and below, empty for the usual one;
/// radii and widths are in pixels.
struct PointMarks {
    std::vector<Vec3> points;
    std::string color;
    double radius = 5.0;
};

/// A line in the world.
struct LineMark {
    std::vector<Vec3> points;
    std::string color;
    double width = 3.0;
    bool closed = false;
};

/// Text at a point of the world.
struct LabelMark {
    Vec3 at = Vec3::Zero();
    std::string text, color;
};

/// A line in the picture, in pixels from its top left corner.
struct OutlineMark {
    std::vector<Vec2> pixels;
    std::string color;
    double width = 1.5, opacity = 1.0;
    bool closed = false;
};

/// A circle in the picture.
struct CircleMark {
    Vec2 at = Vec2::Zero();
    double radius = 20.0;
    std::string color;
};

/// Vertices of a mesh in another colour.
struct RegionMark {
    std::shared_ptr<MeshObject> mesh;
    Region region;
    std::string color;
};

/// A surface between two lines of the world, as many points each, that is seen through.
struct SurfaceMark {
    std::vector<Vec3> from, to;
    std::string color;
    double opacity = 0.25;
};

/// A mesh that is not in the scene.
struct MeshMark {
    std::shared_ptr<MeshObject> mesh;
    Affine transform;
    std::string color;
};

struct ToolViewObject {
    static constexpr const char* kTypeName = "lissom.ToolView";

    std::vector<PointMarks> points;
    std::vector<LineMark> lines;
    std::vector<LabelMark> labels;
    std::vector<OutlineMark> outlines;
    std::vector<CircleMark> circles;
    std::vector<RegionMark> regions;
    std::vector<SurfaceMark> surfaces;
    std::vector<MeshMark> meshes;
    /// Bytes of all marks, with their lists and texts.
    std::size_t mark_bytes = 0;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const { return mark_bytes; }
};

/// A C function for Lua: returns a view without marks, with the fields of a table: camera, scene,
/// size, up, and cursor or nil.
int new_tool_view(lua_State* L);

/// A C function for Lua: returns the marks of a view as a lissom.ToolMarks.
int push_tool_marks(lua_State* L);

}  // namespace lissom::lua
