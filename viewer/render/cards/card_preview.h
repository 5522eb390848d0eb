/// Cards with their pictures as coloured faces or ribbons, for renderers without textures.
#pragma once

#include "kernel/core/context.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "viewer/render/cards/card_atlas.h"

namespace lissom {

struct CardPreviewOptions {
    /// Faces or ribbons across each card, 2 to 256; faces are about three times as long as wide.
    int across = 24;
    /// As CardAtlasOptions::cutoff.
    double cutoff = 0.5;
};

/// Returns a quad for each small part of each card whose mean alpha reaches the cutoff, with the
/// mean colour there (sRGB) times the light of `surface`, the card_mesh of these cards. Errors:
/// invalid_argument for options out of range; memory_limit; cancelled.
Mesh card_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                  const CardPreviewOptions& options = {}, const Context& context = {});

/// Returns the cap alone in the same way; without faces if there is none.
Mesh cap_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                 const CardPreviewOptions& options = {}, const Context& context = {});

/// Returns ribbons along each card where its texels reach the cutoff, as wide as the part of them
/// that does, in metres and in linear colours: a renderer of strands lights them as an engine
/// lights cards by their flow. Errors as card_preview.
Strands card_ribbons(const HairCards& cards, const CardAtlas& atlas,
                     const CardPreviewOptions& options = {}, const Context& context = {});

}  // namespace lissom
