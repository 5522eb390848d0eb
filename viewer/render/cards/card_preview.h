/// Cards with their pictures as a mesh of coloured faces, for renderers without textures.
#pragma once

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "viewer/render/cards/card_atlas.h"

namespace lissom {

struct CardPreviewOptions {
    /// Faces across each card, 2 to 256; along it they are about three times as long as wide.
    int across = 24;
    /// As CardAtlasOptions::cutoff.
    double cutoff = 0.5;
};

/// Returns a quad for each small part of each card whose mean alpha reaches the cutoff, with the
/// mean colour there (sRGB) times the light of `surface`, the card_mesh of these cards. Errors:
/// invalid_argument for options out of range; memory_limit; cancelled.
Mesh card_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                  const CardPreviewOptions& options = {}, const Context& context = {});

}  // namespace lissom
