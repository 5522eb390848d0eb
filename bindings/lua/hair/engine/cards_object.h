/// The hair cards of a script.
#pragma once

#include <utility>

#include "bindings/lua/core/registry.h"
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

    std::size_t memory_bytes() const {
        return strands.memory_bytes() + mesh.memory_bytes() + cards.cards.size() * sizeof(Card) +
               4 * at(strands.size());
    }
};

/// cards.cpp.
Function cards_method();

}  // namespace lissom::lua
