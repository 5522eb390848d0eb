/// Settings of a window's display, beside those of a script.
#pragma once

#include <optional>
#include <vector>

#include "viewer/render/picture.h"

namespace lissom::window {

struct DisplaySettings {
    bool dark = true;
    bool wire = false;
    bool flat = false;
    bool boundaries = false;
    /// Meshes are translucent: objects behind them show, hair above all.
    bool see_through = false;
    bool vertex_normals = false, face_normals = false;
    /// Occlusion and all samples once nothing moves.
    bool sharp = true;
    /// Pixels in a unit of length, by which lines and points are wider than in a picture that
    /// a script draws.
    double scale = 1.0;
    /// One for each mesh of the picture; those behind the end are visible.
    std::vector<bool> hidden;

    bool operator==(const DisplaySettings&) const = default;
};

/// Behind the meshes.
Color background_of(const DisplaySettings& settings);

/// Returns `picture` as the window shows it: without hidden objects, cells and captions, all in one
/// space, in a picture of `width` x `height` pixels that `camera` sees.
Picture displayed(const Picture& picture, const DisplaySettings& settings, const Camera& camera,
                  int width, int height);

/// Returns the snapshot drawn while something moves: the same.
Snapshot quick_snapshot(const Picture& picture, const DisplaySettings& settings);

/// Returns the legend beside the shown picture.
std::optional<Legend> shown_legend(const Picture& picture, const DisplaySettings& settings);

}  // namespace lissom::window
