// Which points of the boundaries meet if there are no keys.
#include <algorithm>
#include <cmath>

#include "kernel/merge/loop/automatic_keys.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/merge_stages.h"

namespace lissom {
namespace {

// Weights of a multinomial logit model: the odds of a turn are exp(-score), and those that none of
// the turns is right exp(-kNoneScore). Fitted to 147 pairs of parts of real models, of which 37
// come from different ones; in cross validation by models 76 of 78 that had a certainty above .75
// were right, and all 52 above .9.
constexpr double kLoopWeight = 2.83, kBendWeight = 1.24, kSymmetryWeight = 3.22, kMassWeight = 0.29;
constexpr double kNoneScore = -3.97;
// Misfits well below this are none.
constexpr double kMinMisfit = 0.003;
// Turns within 30 degrees are one guess; offsets that differ by less than kRounding are equal, and
// scores by less than kSameScore.
constexpr double kEqualTurns = 30.0 / 360.0, kRounding = 1e-6, kSameScore = 0.01;

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

// How far the vertices of a deformed region are from the similarity that fits them, RMS, in sizes
// of the region.
double bend_of(const Mesh& rest, const Region& region, std::span<const Vec3> now) {
    Matches matches{{}, {now.begin(), now.end()}};
    for (const Index v : region.vertices()) matches.from.push_back(rest.position(v));
    const SimilarityMap fit = matches.fit();
    double apart = 0.0, size = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        apart += (now[i] - fit(matches.from[i])).squaredNorm();
        size += (now[i] - fit.to).squaredNorm();
    }
    return std::sqrt(apart / size);
}

double log_of(double misfit) {
    return std::log(misfit + kMinMisfit);
}

double score_of(const JudgedTurn& one) {
    return kLoopWeight * log_of(one.turn.loop_cost) + kBendWeight * log_of(one.bend) +
           kSymmetryWeight * one.turn.mirror + kMassWeight * one.turn.mass;
}

// The probability of each turn, and of all near it, that it is right; see kLoopWeight.
void find_certainty(std::vector<JudgedTurn>& turns) {
    std::vector<double> odds;
    double sum = std::exp(-kNoneScore);
    for (const JudgedTurn& one : turns) sum += odds.emplace_back(std::exp(-score_of(one)));
    for (std::size_t i = 0; i < turns.size(); ++i) {
        for (std::size_t k = 0; k < turns.size(); ++k) {
            const double apart = turns[i].turn.offset - turns[k].turn.offset;
            if (std::abs(std::remainder(apart, 1.0)) < kEqualTurns) {
                turns[i].certainty += odds[k] / sum;
            }
        }
        turns[i].score = score_of(turns[i]);
    }
}

// Returns the turn with the least score; of several that are equal but for rounding the first along
// the target's loop, so that the place of the source does not decide.
const JudgedTurn& best_turn(const std::vector<JudgedTurn>& turns) {
    const auto lower = [](const JudgedTurn& a, const JudgedTurn& b) { return a.score < b.score; };
    const double least = std::min_element(turns.begin(), turns.end(), lower)->score;
    const auto place = [](const JudgedTurn& one) {
        const double u = one.turn.offset + kRounding;
        return u - std::floor(u);
    };
    const JudgedTurn* best = nullptr;
    for (const JudgedTurn& one : turns) {
        if (one.score > least + kSameScore) continue;
        if (!best || place(one) < place(*best)) best = &one;
    }
    return *best;
}

// Several joins take the places of their centres; a single one is turned as its loops, the planes
// of symmetry, masses and necks of the parts suggest, with the least distortion.
FoundPlaces places_by_shape(const Boundaries& boundaries, const PartShapes& shapes,
                            const SourceSystem& system, const MergeOptions& options,
                            const Context& context) {
    const std::vector<LoopJoin> loops = loops_of(boundaries);
    if (loops.size() > 1) return guessed_places(guess_offsets(loops), Placing::shape);
    const PartShapes::Pair& parts = shapes.of(boundaries, context);
    if (parts.source.round || parts.target.round) {
        FoundPlaces found = sure_places(guess_offsets(loops), Placing::shape);
        found.any_turn = true;
        return found;
    }
    const std::vector<JudgedTurn> turns =
        judged_turns(boundaries, shapes, system, options, context);
    const JudgedTurn& best = best_turn(turns);
    return {{{0.0, best.turn.offset}}, Placing::shape, {best.certainty}, false};
}

// A part that lies turned by more than a quarter from how the shapes clearly suggest may look the
// wrong way.
constexpr double kQuarterTurn = 0.25;

double apart_from(const TurnCandidate& turn, const ParameterPair& key) {
    return std::abs(std::remainder(key.target - key.source - turn.offset, 1.0));
}

// Before anything is deformed: whether the turn that outlines, symmetry and masses speak for most
// is about that of the key.
bool agrees_roughly(const Boundaries& from, const PartShapes::Pair& parts,
                    const ParameterPair& key) {
    const std::vector<TurnCandidate> turns = turn_candidates(
        {&from.source_curves.front(), &from.target_curves.front(), &parts.source, &parts.target});
    const auto best =
        std::min_element(turns.begin(), turns.end(), [](const auto& a, const auto& b) {
            return score_of({a, 0.0}) < score_of({b, 0.0});
        });
    return best == turns.end() || apart_from(*best, key) <= kQuarterTurn;
}

// Returns the angle from the turn that the shapes surely suggest, or 0: FoundPlaces::off_shape.
double angle_off_shape(const Boundaries& boundaries, const PartShapes& shapes,
                       const SourceSystem& system, const MergeOptions& options,
                       const ParameterPair& key, const Context& context) {
    const PartShapes::Pair& parts = shapes.of(boundaries, context);
    if (parts.source.round || parts.target.round || agrees_roughly(boundaries, parts, key)) {
        return 0.0;
    }
    const std::vector<JudgedTurn> turns =
        judged_turns(boundaries, shapes, system, options, context);
    const JudgedTurn& best = best_turn(turns);
    const double apart = apart_from(best.turn, key);
    return best.certainty >= kCertain && apart > kQuarterTurn ? 2.0 * kPi * apart : 0.0;
}

}  // namespace

std::vector<JudgedTurn> judged_turns(const Boundaries& boundaries, const PartShapes& shapes,
                                     const SourceSystem& system, const MergeOptions& options,
                                     const Context& context) {
    const PartShapes::Pair& parts = shapes.of(boundaries, context);
    const Region& region = system.deformer->region();
    const MergeMethod method = method_of(options);
    const bool snap = method.loops == LoopMeasure::robust;
    const Loop& source = boundaries.source_curves.front();
    const Loop& target = boundaries.target_curves.front();
    std::vector<JudgedTurn> turns;
    for (const TurnCandidate& turn :
         turn_candidates({&source, &target, &parts.source, &parts.target})) {
        const ParameterPair key{0.0, turn.offset};
        const LoopPair pair = corresponding(source, target, std::span(&key, 1), snap);
        const BoundaryDeformation deformed =
            deformed_by(boundaries, system, method.values, std::span(&pair, 1), {}, context);
        turns.push_back({turn, bend_of(boundaries.source.mesh, region, deformed.positions), 0.0});
    }
    find_certainty(turns);
    return turns;
}

FoundPlaces find_places(const Boundaries& boundaries, const PartShapes& parts,
                        const SourceSystem& system, const MergeOptions& options,
                        const Context& context) {
    const std::vector<LoopJoin> loops = loops_of(boundaries);
    if (directions_count(loops.front(), options.directions)) {
        return guessed_places(guess_offsets(loops, options.directions), Placing::directions);
    }
    if (options.configuration == Configuration::fixed) {
        return sure_places(nearest_offsets(loops), Placing::as_placed);
    }
    const bool over = loops.size() == 1 && is_turned_over(loops.front());
    if (options.place == Place::shape || over) {
        return places_by_shape(boundaries, parts, system, options, context);
    }
    FoundPlaces found = sure_places(as_placed_offsets(loops), Placing::as_placed);
    if (loops.size() > 1) return found;
    found.off_shape =
        angle_off_shape(boundaries, parts, system, options, found.keys.front(), context);
    return found;
}

}  // namespace lissom
