/// The strands of a picture, drawn without OpenGL, and how they are laid over the picture of the
/// meshes.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/render_options.h"
#include "viewer/render/draw/view_parameters.h"
#include "viewer/render/strands/strand_shadow.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom {

/// Content of one pixel; fractions of its area.
struct StrandPixel {
    /// Linear colour of the strands, times `strands`.
    Eigen::Array3f color = Eigen::Array3f::Zero();
    float strands = 0.0f;
    /// Meshes that no strand hides, and meshes in all.
    float meshes = 0.0f, all_meshes = 0.0f;
};

struct StrandLayer {
    int width = 0, height = 0;
    /// Row by row from the top left.
    std::vector<StrandPixel> pixels;

    std::size_t place(int x, int y) const { return at(y) * width + x; }
};

/// A drawing with strands as the camera sees it.
struct StrandScene {
    std::vector<ViewStrands> strands;
    std::vector<ViewTriangle> triangles;
    ViewParameters view;
    /// Pixels of the picture that an opaque strand is wide at least, unless it has no width.
    double min_width = 0.0;
};

/// Returns the least width in pixels that shows each of `strands` strands: 1.5 for up to 50,
/// falling to 0 for 500 and more, which are seen together.
double min_visible_width(Index strands);

/// Draws the strands of `scene` into pixels of a picture with `options`; meshes only hide. The same
/// to the bit for any number of threads. Errors: memory_limit; cancelled.
StrandLayer draw_strands(const StrandScene& scene, const StrandShadow& shadow,
                         const RenderOptions& options, const Context& context = {});

/// Lays strands over `meshes`, a picture of the meshes on nothing, and both on the background.
/// Pixels away from strands are unchanged.
Image lay_over(const Image& meshes, const StrandLayer& layer,
               const std::optional<Color>& background);

}  // namespace lissom
