/// Makes one card of the strands of a cluster; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Points of each strand from which cards are made, at equal steps.
inline constexpr Index kCardPoints = 48;

struct CardGround {
    /// Strands of kCardPoints points.
    const Strands& even;
    const CardOptions& options;
    /// Points along each card.
    Index sections = 2;
    /// The mean of the roots.
    Vec3 middle = Vec3::Zero();
};

/// The plane of a card: that of most spread near the surface of the head for one that is alone and
/// for the first of two that cross; the second is perpendicular to it.
enum class CardPlane { alone, crossed, crossing };

Card make_card(const CardGround& ground, CardPlane plane, std::vector<Index> strands, Index medoid);

/// Root mean squares of the distances of points from the middle of a card, in its plane and out of
/// it, in metres.
struct CardSpread {
    double across = 0.0, out = 0.0;
};

CardSpread spread_of(const Card& card, const Strands& even);

}  // namespace lissom
