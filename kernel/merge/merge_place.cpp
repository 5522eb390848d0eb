// Which points of the boundaries meet if there are no keys.
#include <algorithm>

#include "kernel/merge/loop/automatic_keys.h"
#include "kernel/merge/merge_stages.h"

namespace lissom {
namespace {

std::vector<LoopJoin> loops_of(const Boundaries& boundaries) {
    std::vector<LoopJoin> loops;
    for (std::size_t j = 0; j < boundaries.source_curves.size(); ++j) {
        loops.push_back({&boundaries.source_curves[j], &boundaries.target_curves[j]});
    }
    return loops;
}

FoundPlaces sure_places(const std::vector<OffsetGuess>& offsets, Placing by) {
    FoundPlaces found{{}, by, {}, false};
    for (const OffsetGuess& offset : offsets) {
        found.keys.push_back(offset.key);
        found.certainty.push_back(1.0);
    }
    return found;
}

// A ratio of costs as a certainty: kClearContrast is kCertain.
double certainty_of_contrast(double contrast) {
    return 1.0 - 0.5 / (1.0 + 2.0 * (contrast - 1.0));
}

FoundPlaces guessed_places(const std::vector<OffsetGuess>& offsets, Placing by) {
    FoundPlaces found = sure_places(offsets, by);
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        found.certainty[j] = certainty_of_contrast(offsets[j].contrast);
    }
    return found;
}

// The shapes of the parts count only if the loops leave a choice.
FoundPlaces places_by_shape(const MergePreparation& preparation, std::vector<LoopJoin> loops,
                            const Context& context) {
    const auto& directions = preparation.options.directions;
    const std::vector<OffsetGuess> guesses = guess_offsets(loops, directions);
    if (guesses.front().contrast >= kClearContrast) return guessed_places(guesses, Placing::shape);
    const PartShapes::Pair& parts = preparation.parts->of(preparation.boundaries, context);
    loops.front().source_part = &parts.source;
    loops.front().target_part = &parts.target;
    return guessed_places(guess_offsets(loops, directions), Placing::shape);
}

}  // namespace

FoundPlaces find_places(const MergePreparation& preparation, const Context& context) {
    const std::vector<LoopJoin> loops = loops_of(preparation.boundaries);
    const MergeOptions& options = preparation.options;
    if (directions_count(loops.front(), options.directions)) {
        return guessed_places(guess_offsets(loops, options.directions), Placing::directions);
    }
    if (options.configuration == Configuration::fixed) {
        return sure_places(nearest_offsets(loops), Placing::as_placed);
    }
    const bool over = loops.size() == 1 && is_turned_over(loops.front());
    if (options.place == Place::shape || over) return places_by_shape(preparation, loops, context);
    return sure_places(as_placed_offsets(loops), Placing::as_placed);
}

}  // namespace lissom
