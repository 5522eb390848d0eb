/// The pictures of hair cards: strands drawn flat into the slots of an atlas.
#pragma once

#include "kernel/core/context.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"
#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/strand_style.h"

namespace lissom {

struct CardAtlasOptions {
    /// Texels along each side of the atlas; 64 to 8192.
    int size = 2048;
    /// Colours of the strands, without light; its lobes and shadows are not used.
    StrandStyle style = {};
    /// Alpha is made steeper about this number and shifted, so that as large a part of each slot is
    /// above it as its locks cover, at the full size of the picture.
    double cutoff = 0.5;
};

/// Pictures of one size. Beside strands colours go on, so that smaller pictures do not darken.
struct CardAtlas {
    /// Colour, and alpha: the part of the texel that locks cover, made steeper. Locks are every
    /// n-th strand as wide as n, about 1.2 mm, so that mipmaps keep as large a part of them.
    Image color;
    /// Direction of the strands on the card, towards the tip, as in a normal map: red across, green
    /// along the card from the tip to the root, each from -1 to 1; blue: height over the card's
    /// plane, -5 to 5 mm. Opaque.
    Image flow;
    /// Red: place along the strand, 0 at the root and 1 at the tip; green: a number of the strand;
    /// blue: the part of the texel that strands cover. Opaque.
    Image data;
};

/// Draws the atlas. Errors: invalid_argument for options out of range; memory_limit; cancelled.
CardAtlas bake_atlas(const HairCards& cards, const Strands& strands,
                     const CardAtlasOptions& options = {}, const Context& context = {});

}  // namespace lissom
