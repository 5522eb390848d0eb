/// The hair cards of a script.
#pragma once

#include <utility>

#include "bindings/lua/core/registry.h"
#include "kernel/core/memory_hold.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom::lua {

struct CardsObject {
    static constexpr const char* kTypeName = "lissom.Cards";

    CardsObject(HairCards made, Strands hair, Mesh surface)
        : cards(std::move(made)), strands(std::move(hair)), mesh(std::move(surface)) {}

    HairCards cards;
    /// The strands that they stand for.
    Strands strands;
    Mesh mesh;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const {
        return strands.memory_bytes() + mesh.memory_bytes() + held_bytes();
    }
    std::size_t held_bytes() const {
        std::size_t bytes = cards.slots.size() * sizeof(CardSlot) +
                            cards.cap.positions.size() * (2 * sizeof(Vec3) + 3 * sizeof(double)) +
                            cards.cap.triangles.size() * sizeof(Triangle);
        for (const Card& card : cards.cards) {
            bytes += sizeof card + card.sections.size() * sizeof(CardSection) +
                     card.strands.size() * sizeof(Index);
        }
        return bytes;
    }
};

/// cards.cpp.
Function cards_method();

}  // namespace lissom::lua
