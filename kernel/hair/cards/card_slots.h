/// Slots of an atlas that cards share; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Chooses at most `count` cards whose strands are drawn, gives each a place in the atlas, and each
/// card the slot of the one that is most like it in length, width, number of strands and how they
/// wind. `even` has the strands with as many points each.
void share_slots(const Strands& even, Index count, HairCards& cards);

/// Gives all slots places in the atlas: columns of strips that are about six times as high as wide.
void place_slots(std::vector<CardSlot>& slots);

}  // namespace lissom
