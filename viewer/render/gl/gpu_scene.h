/// GpuScene: a snapshot on the graphics card. All of it needs a current context, also to end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/draw/quick_vertices.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/draw/surface_arrays.h"
#include "viewer/render/gl/gl_objects.h"

namespace lissom {

/// Bytes that an update sent to the graphics card, and the calls that it took.
struct Uploads {
    /// Positions and normals.
    std::size_t vertices = 0;
    /// Colours, values and edges of surfaces.
    std::size_t colors = 0;
    /// Lines and points, of overlays and of meshes.
    std::size_t marks = 0;
    int calls = 0;

    std::size_t bytes() const { return vertices + colors + marks; }
};

/// Lines, one instance a segment, and points, one instance each.
struct GpuMarks {
    struct Array {
        gl::VertexArray layout;
        gl::Buffer buffer;
        GLsizei count = 0;

        void draw() const;
    };
    Array lines, points;
    bool on_top = false;
};

/// Data of a surface at its corners, on the card: in each buffer as many triangles as are sent in a
/// moment, for a driver takes long to make a large one.
using SurfaceBuffers = std::vector<gl::Buffer>;
inline constexpr std::size_t kTrianglesOfBuffer = 16384;

/// Triangles of one mesh, and its marks. Never changes; unchanged data is shared with the next one.
struct GpuSurface {
    DrawnMesh drawn;
    /// Revision of the mesh, when it was uploaded.
    std::uint64_t revision = 0;
    SurfaceTriangles triangles;
    std::shared_ptr<const SurfaceBuffers> vertices, colors;
    /// Whether the entries of `vertices` are QuickVertex, else SurfaceVertex.
    bool is_quick = false;
    /// Made when vertices first move.
    std::shared_ptr<const NormalGroups> groups;
    /// Layouts, one for each buffer.
    std::vector<gl::VertexArray> layouts;
    std::shared_ptr<const GpuMarks> marks;

    void draw() const;
};

/// Position and extent of the points of a snapshot.
struct ScenePlacement {
    Vec3 center = Vec3::Zero();
    /// RMS distance to the center.
    double size = 0.0;
    /// Corners of boxes around the strands, in the world.
    std::vector<Vec3> strand_corners;
    /// Boxes of the snapshot's strands, in their metres.
    std::map<const Strands*, Box> strand_boxes;
};

/// Data of a mesh that an update has to compute; data that it can reuse is left out.
struct SurfaceNeeds {
    DrawnMesh drawn;
    bool vertices = false, colors = false, marks = false;
    /// Known triangles of the same faces; null if none are.
    SurfaceTriangles known = {};
    /// The point that is at zero on the card, and the scale of values.
    Vec3 origin = Vec3::Zero();
    ValueRange range = {};
    /// Groups of vertices that moved and are made quickly; null if they are made exactly.
    std::shared_ptr<const NormalGroups> groups = nullptr;
};

/// Computed data of a mesh, made by any thread: needs no context.
struct PreparedSurface {
    SurfaceNeeds needs;
    std::uint64_t revision = 0;
    SurfaceTriangles triangles = {};
    std::vector<SurfaceVertex> vertices = {};
    /// Replace `vertices` if they are made quickly.
    std::vector<QuickVertex> quick = {};
    std::vector<SurfaceColor> colors = {};
    Overlay marks = {};
    /// Groups of the vertices, so that the mesh can move quickly from then on.
    std::shared_ptr<const NormalGroups> groups = nullptr;
    /// Buffers already sent by a PieceSender.
    std::shared_ptr<const SurfaceBuffers> sent_vertices = nullptr, sent_colors = nullptr;
};

/// Errors: those of surface_colors; cancelled.
PreparedSurface prepare(SurfaceNeeds needs, const Context& context = {});

/// Sends prepared data to the graphics card buffer by buffer: a window looks for events between
/// them.
class PieceSender {
  public:
    explicit PieceSender(std::vector<PreparedSurface> surfaces);

    /// Makes the next buffer; returns false if there was none left. Errors: memory_limit.
    bool send();
    const std::vector<PreparedSurface>& surfaces() const { return surfaces_; }
    /// Returns the prepared data to any thread, without the buffers sent, which belong to the
    /// context.
    std::vector<PreparedSurface> give_away();

  private:
    // Buffers sent of one surface, one each.
    struct Part {
        std::vector<std::span<const std::byte>> pieces;
        std::shared_ptr<const SurfaceBuffers> PreparedSurface::*to;
        std::size_t surface;
    };
    std::vector<PreparedSurface> surfaces_;
    std::vector<Part> parts_;
    std::size_t part_ = 0;
    SurfaceBuffers made_;
};

/// Vertices of a mesh that moved: made exactly as for a picture, or quickly, see quick_vertices.h;
/// polygons then keep their diagonals.
enum class MovedVertices { exact, quick };

class GpuScene {
  public:
    /// Updates the scene to `snapshot`. Uploads only differences to the snapshot before: nothing
    /// for the same revision or the same contents, positions and normals only if a mesh of the
    /// same faces moved. Frees objects that vanished. After an error the scene is as it was.
    /// Errors: not_finite for a transform, line or point; those of surface_colors; memory_limit;
    /// cancelled.
    Uploads update(const Snapshot& snapshot, const Context& context = {},
                   MovedVertices moved = MovedVertices::exact) {
        return update_with({}, snapshot, context, moved);
    }
    /// Updates likewise, with the data in `prepared`.
    Uploads update_with(std::span<const PreparedSurface> prepared, const Snapshot& snapshot,
                        const Context& context, MovedVertices moved);
    /// Returns the data that `update` has to compute for the meshes of `snapshot`, if moved
    /// vertices are made quickly. Meshes without changes are left out.
    std::vector<SurfaceNeeds> needs(const Snapshot& snapshot) const;

    const Snapshot& snapshot() const { return shown_.snapshot; }
    const ScenePlacement& placement() const { return shown_.placement; }
    /// Returns the point of the world that is at zero on the card. Constant as long as the content
    /// stays near it.
    const Vec3& origin() const { return shown_.origin; }
    const std::vector<std::shared_ptr<const GpuSurface>>& surfaces() const {
        return shown_.surfaces;
    }

    void draw_surfaces() const;
    /// Draw the lines or points that no surface hides, or the others.
    void draw_lines(bool on_top) const;
    void draw_points(bool on_top) const;

  private:
    struct Shown {
        Snapshot snapshot;
        ScenePlacement placement;
        Vec3 origin = Vec3::Zero();
        std::vector<std::shared_ptr<const GpuSurface>> surfaces;
        /// Marks, one for each overlay of the snapshot.
        std::vector<std::shared_ptr<const GpuMarks>> overlays;
    };
    Vec3 next_origin(const ScenePlacement& placement) const;
    bool keeps_origin(const ScenePlacement& placement) const;

    Shown shown_;
    // Memory of quick updates, so that none allocates.
    std::vector<QuickVertex> scratch_;
};

}  // namespace lissom
