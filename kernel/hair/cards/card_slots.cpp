#include "kernel/hair/cards/card_slots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lissom {
namespace {

// Texels at the borders of a slot that stay clear, as a part of its width.
constexpr double kSlotMargin = 0.02;
// A slot is so many times as high as wide, about.
constexpr double kSlotAspect = 6.0;

// Logarithms of length, width and number of strands, and the change of u along them: cards of
// equal numbers show alike.
using CardLook = Eigen::Matrix<double, 5, 1>;

CardLook look_of_card(const Card& card, const Strands& even) {
    double width = 0.0, winding = 0.0, tips = 0.0;
    for (const CardSection& section : card.sections) width += section.half_width;
    width /= static_cast<double>(card.sections.size());
    for (const Index s : card.strands) {
        const StrandView strand = even.strand(s);
        CardPoint before = place_on_card(card, point_of(strand, 0));
        for (Index k = 1; k < index_of(strand.cols()); k += 3) {
            const CardPoint here = place_on_card(card, point_of(strand, k));
            winding += std::abs(here.u - before.u);
            before = here;
        }
        tips += before.v;
    }
    const auto count = static_cast<double>(card.strands.size());
    CardLook look;
    look << std::log(std::max(card.length(), 1e-4)), 0.5 * std::log(width), std::log(count / width),
        winding / count, 2.0 * tips / count;
    return look;
}

std::vector<Index> spread_choice(const std::vector<CardLook>& looks, Index count) {
    // Each next one is the card furthest from those chosen (Gonzalez 1985).
    std::vector<Index> chosen = {0};
    std::vector<double> least(looks.size(), std::numeric_limits<double>::infinity());
    while (count_of(chosen) < count) {
        Index far = 0;
        for (Index c = 0; c < count_of(looks); ++c) {
            const double d = (looks[at(c)] - looks[at(chosen.back())]).squaredNorm();
            least[at(c)] = std::min(least[at(c)], d);
            if (least[at(c)] > least[at(far)]) far = c;
        }
        if (!(least[at(far)] > 0.0)) break;
        chosen.push_back(far);
    }
    return chosen;
}

Index nearest_look(const std::vector<CardLook>& looks, const std::vector<Index>& chosen, Index c) {
    Index best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < count_of(chosen); ++i) {
        const double d = (looks[at(c)] - looks[at(chosen[at(i)])]).squaredNorm();
        if (d >= least) continue;
        least = d;
        best = i;
    }
    return best;
}

// The card of each slot becomes the one nearest to the mean of those that share it.
void center_slots(const std::vector<CardLook>& looks, const std::vector<Index>& slot_of,
                  std::vector<Index>& chosen) {
    for (Index i = 0; i < count_of(chosen); ++i) {
        CardLook mean = CardLook::Zero();
        double count = 0.0;
        for (std::size_t c = 0; c < looks.size(); ++c) {
            if (slot_of[c] != i) continue;
            mean += looks[c];
            count += 1.0;
        }
        if (!(count > 0.0)) continue;
        mean /= count;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < looks.size(); ++c) {
            const double d = (looks[c] - mean).squaredNorm();
            if (slot_of[c] != i || d >= least) continue;
            least = d;
            chosen[at(i)] = index_of(c);
        }
    }
}

}  // namespace

void place_slots(std::vector<CardSlot>& slots) {
    const auto n = static_cast<double>(slots.size());
    const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(n / kSlotAspect))));
    const int columns = (static_cast<int>(slots.size()) + rows - 1) / rows;
    for (int i = 0; i < static_cast<int>(slots.size()); ++i) {
        const int column = i % columns, row = i / columns;
        const double x = column, y = row;
        const double margin = kSlotMargin / columns;
        slots[at(i)].low = {x / columns + margin, 1.0 - (y + 1.0) / rows + margin};
        slots[at(i)].high = {(x + 1.0) / columns - margin, 1.0 - y / rows - margin};
    }
}

void share_slots(const Strands& even, Index count, HairCards& cards) {
    std::vector<CardLook> looks;
    for (const Card& card : cards.cards) looks.push_back(look_of_card(card, even));
    std::vector<Index> chosen = spread_choice(looks, std::min(count, count_of(looks)));
    std::vector<Index> slot_of(looks.size(), 0);
    for (int round = 0; round < 6; ++round) {
        for (Index c = 0; c < count_of(looks); ++c) slot_of[at(c)] = nearest_look(looks, chosen, c);
        center_slots(looks, slot_of, chosen);
    }
    for (const Index card : chosen) {
        CardSlot slot;
        slot.card = card;
        cards.slots.push_back(slot);
    }
    place_slots(cards.slots);
    for (std::size_t c = 0; c < looks.size(); ++c) {
        cards.cards[c].slot = nearest_look(looks, chosen, index_of(c));
    }
}

}  // namespace lissom
