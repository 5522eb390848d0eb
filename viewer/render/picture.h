/// Picture: a finished image of one or several meshes, framed, in one space or side by side, with a
/// legend of values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/render/draw/legend.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/draw/style_marks.h"
#include "viewer/render/renderer.h"

namespace lissom {

struct PictureStrands {
    DrawnStrands drawn;
    /// Place among the meshes of the picture of the one that they grow on.
    std::optional<std::size_t> mesh = std::nullopt;
};

struct Picture {
    std::vector<DrawnMesh> meshes = {};
    /// Drawn with every mesh, in the world of the camera.
    Overlay marks = {};
    /// Not drawn: marks that a window adds if the user asks for fields of hairstyles.
    NamedMarks field_marks = {};
    /// Likewise, not hidden by any surface: marks of a tool.
    Overlay tool_marks = {};
    /// In cells, strands that name a mesh are drawn with that mesh, others with every mesh.
    std::vector<PictureStrands> strands = {};

    /// Camera of the picture; without one, a standard view that frames everything.
    std::optional<Camera> camera = std::nullopt;
    StandardView view = StandardView::three_quarter;
    /// Up axis, perspective and margin of the standard view; its aspect is that of the picture.
    FramingOptions framing = {};

    /// 0: all meshes in one space. Otherwise each in a cell of its own, this many a row, seen by
    /// the same camera, so that they can be compared.
    int columns = 0;
    /// In cells, each mesh is framed by itself: for meshes that have nothing to do with each other.
    bool fit_each = false;
    /// One line of text below each cell; none, or one a mesh.
    std::vector<std::string> captions = {};

    /// Ends of the colour scale; without them, the least and greatest value drawn.
    std::optional<ValueRange> range = std::nullopt;
    /// Draw the colour scale and its numbers at the right, if a mesh has values, or the names of
    /// the parts.
    bool legend = true;
    /// Stands above the colour scale or the names.
    std::string legend_label = {};
    /// Names of the parts that meshes show; if there are any there is no scale.
    std::vector<LegendPart> legend_parts = {};

    RenderOptions options = {};
};

/// Returns all of `picture` in one space, its scale of colours included: with columns, the meshes
/// stand side by side. Errors: invalid_argument if the range is empty.
Snapshot snapshot_of(const Picture& picture);

/// Returns the legend that draw_picture draws at the right of `picture`; nothing if it draws none.
/// Errors: invalid_argument if the range is empty.
std::optional<Legend> legend_of(const Picture& picture);

/// Returns the camera of `picture`, or the standard view that frames its snapshot, of very many
/// points an even sample, in a picture whose width is `aspect` times its height. Errors: as
/// frame_points.
Camera quick_camera_of(const Picture& picture, const Snapshot& snapshot, double aspect);

/// Copies of meshes for pictures, independent of later changes. Unchanged meshes are not copied
/// again: a mesh with other regions only is the copy that was made before.
class FrozenMeshes {
  public:
    /// `picture` with copies of its meshes and strands.
    Picture freeze(Picture picture);

  private:
    struct Kept {
        std::weak_ptr<const Mesh> source;
        std::shared_ptr<const Mesh> copy;
    };
    void freeze(DrawnMesh& drawn);

    // Copies of the last picture, and of the one that is made.
    std::vector<Kept> kept_, next_;
};

/// Makes a snapshot without the earlier copies.
Picture frozen(Picture picture);

/// Draws `picture`. Errors: those of Renderer::render and frame_points; mesh_empty for a mesh
/// without faces; invalid_argument if the range is empty, or the size leaves no room for cells or
/// legend; memory_limit before it takes memory for the pixels.
Image draw_picture(Renderer& renderer, const Picture& picture, const Context& context = {});

}  // namespace lissom
