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
#include "viewer/draw/quick_vertices.h"
#include "viewer/draw/snapshot.h"
#include "viewer/draw/surface_arrays.h"
#include "viewer/gl/gl_objects.h"

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

/// Values at the corners of a surface, on the card: each buffer has as many triangles as are sent
/// in a moment, for a driver takes long to make a large one.
using SurfaceBuffers = std::vector<gl::Buffer>;
inline constexpr std::size_t kTrianglesOfBuffer = 16384;

/// Triangles of one mesh, and its marks. Never changes; unchanged parts are shared with the next
/// one.
struct GpuSurface {
    DrawnMesh drawn;
    /// Revision of the mesh at its upload.
    std::uint64_t revision = 0;
    SurfaceTriangles triangles;
    std::shared_ptr<const SurfaceBuffers> vertices, colors;
    /// Whether the entries of `vertices` are QuickVertex, else SurfaceVertex.
    bool is_quick = false;
    /// Made when vertices first move.
    std::shared_ptr<const NormalGroups> groups;
    /// One for each buffer.
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
    /// Box of each of the snapshot's strands, in their metres.
    std::map<const Strands*, Box> strand_boxes;
};

/// Data that an update has to compute for a mesh, without those that it can take over.
struct SurfaceNeeds {
    DrawnMesh drawn;
    bool vertices = false, colors = false, marks = false;
    /// Triangles of the same faces that are known; null if none are.
    SurfaceTriangles known = {};
    /// The point that is at zero on the card, and the scale of values.
    Vec3 origin = Vec3::Zero();
    ValueRange range = {};
    /// Groups of vertices that moved and are made fast; null if they are made exactly.
    std::shared_ptr<const NormalGroups> groups = nullptr;
};

/// That, found out by any thread: needs no context.
struct PreparedSurface {
    SurfaceNeeds needs;
    std::uint64_t revision = 0;
    SurfaceTriangles triangles = {};
    std::vector<SurfaceVertex> vertices = {};
    /// In place of them if they are made fast.
    std::vector<QuickVertex> quick = {};
    std::vector<SurfaceColor> colors = {};
    Overlay marks = {};
    /// Groups of the vertices, so that the mesh can move fast from then on.
    std::shared_ptr<const NormalGroups> groups = nullptr;
    /// Parts of that already sent by a PieceSender.
    std::shared_ptr<const SurfaceBuffers> sent_vertices = nullptr, sent_colors = nullptr;
};

/// Errors: those of surface_colors; cancelled.
PreparedSurface prepare(SurfaceNeeds needs, const Context& context = {});

/// Sends prepared surfaces to the graphics card buffer by buffer: a window looks for events between
/// them.
class PieceSender {
  public:
    explicit PieceSender(std::vector<PreparedSurface> surfaces);

    /// Makes the next buffer; false if there was none left. Errors: memory_limit.
    bool send();
    const std::vector<PreparedSurface>& surfaces() const { return surfaces_; }
    /// Gives them away to any thread, without the sent parts, which belong to the context.
    std::vector<PreparedSurface> give_away();

  private:
    // Parts of one surface to send, a buffer each.
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

/// How the vertices of a mesh that moved are made: as those of a picture, or fast, see
/// quick_vertices.h; polygons then keep their diagonals.
enum class MovedVertices { exact, quick };

class GpuScene {
  public:
    /// Shows `snapshot` from now on. Uploads the differences from the snapshot before: nothing for
    /// the same revision or the same contents, only positions and normals if a mesh of the same
    /// faces moved. Vanished parts are freed. Returns counts of the uploads. After an error the
    /// scene is as it was. Errors: not_finite for a transform, line or point; those of
    /// surface_colors; memory_limit; cancelled.
    Uploads update(const Snapshot& snapshot, const Context& context = {},
                   MovedVertices moved = MovedVertices::exact) {
        return update_with({}, snapshot, context, moved);
    }
    /// Updates likewise, and takes surfaces from `prepared`.
    Uploads update_with(std::span<const PreparedSurface> prepared, const Snapshot& snapshot,
                        const Context& context, MovedVertices moved);
    /// Returns the needs of `update` for the meshes of `snapshot`, if vertices that moved are made
    /// fast. Only for meshes that need anything.
    std::vector<SurfaceNeeds> needs(const Snapshot& snapshot) const;

    const Snapshot& snapshot() const { return shown_.snapshot; }
    const ScenePlacement& placement() const { return shown_.placement; }
    /// Returns the point of the world that is at zero on the card. Stays while the drawn objects
    /// are about it.
    const Vec3& origin() const { return shown_.origin; }
    const std::vector<std::shared_ptr<const GpuSurface>>& surfaces() const {
        return shown_.surfaces;
    }

    void draw_surfaces() const;
    /// Draws the lines that no surface hides, or the others.
    void draw_lines(bool on_top) const;
    void draw_points(bool on_top) const;

  private:
    struct Shown {
        Snapshot snapshot;
        ScenePlacement placement;
        Vec3 origin = Vec3::Zero();
        std::vector<std::shared_ptr<const GpuSurface>> surfaces;
        /// One for each overlay of the snapshot.
        std::vector<std::shared_ptr<const GpuMarks>> overlays;
    };
    Vec3 next_origin(const ScenePlacement& placement) const;
    bool keeps_origin(const ScenePlacement& placement) const;

    Shown shown_;
    // Buffer of quick updates, so that none allocates.
    std::vector<QuickVertex> scratch_;
};

}  // namespace lissom
