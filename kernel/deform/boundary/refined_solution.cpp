// ARAP iterations from a solution of both systems.
#include <utility>

#include "kernel/deform/boundary/boundary_solution.h"
#include "kernel/deform/boundary/rigid_fit.h"

namespace lissom {
namespace {

// How far beyond the rotations that fit best a step of a refinement goes, in parts of the way to
// them; smaller parts than the least count as none. A step that gains less is the last.
constexpr double kMaxFurther = 1.6, kMinFurther = 0.3, kMinGain = 1e-4;

std::vector<TurnLimit> limits_of(const BoundarySystems& from, const BoundarySolution& now) {
    std::vector<TurnLimit> limits(now.turns.size());
    for (std::size_t v = 0; v < limits.size(); ++v) limits[v].free = from.known.gradient[v] == 0;
    for (std::size_t i = 0; i < from.held_local.size(); ++i) {
        limits[at(from.held_local[i])] = {now.values[i].slack > 0.0, &now.values[i]};
    }
    return limits;
}

std::vector<Mat3> transforms_of(const BoundarySolution& now) {
    std::vector<Mat3> transforms;
    for (const PaddedMat3& turn : now.turns) {
        transforms.push_back(now.base.rotation + turn.topRows<3>());
    }
    return transforms;
}

// The rotations that fit the present positions best.
FittedTurns fitted(const BoundarySystems& from, const BoundarySolution& now,
                   std::span<const TurnLimit> limits, const Context& context) {
    std::vector<Vec4> x;
    for (std::size_t v = 0; v < now.deviation.size(); ++v) {
        x.push_back(padded(Vec3(now.base.rotation * from.work.patch.rest[v] + now.deviation[v])));
    }
    return fitted_turns(from.second->energy(), x, transforms_of(now), now.size, limits, context);
}

// A solution whose free vertices have turned, by `further` beyond the rotations that fit.
BoundarySolution turned_towards(const BoundarySolution& before, const FittedTurns& fit,
                                std::span<const TurnLimit> limits, double further) {
    BoundarySolution next = before;
    const std::vector<Mat3> to =
        turned_beyond(transforms_of(before), fit.transform, before.size, limits, further);
    for (std::size_t v = 0; v < to.size(); ++v) {
        if (limits[v].free) next.turns[v] = padded_columns(Mat3(to[v] - before.base.rotation));
    }
    return next;
}

// Where the iterations are, and the length of the last step that has lowered the energy.
struct Iteration {
    BoundarySolution solution;
    FittedTurns fit;
    double further = kMaxFurther;
};

// Returns false if no step lowers the energy; then nothing changes.
bool step(const BoundarySystems& from, std::span<const TurnLimit> limits, Iteration& now,
          const Context& context) {
    for (;;) {
        context.checkpoint();
        BoundarySolution next = second_solved(
            from, turned_towards(now.solution, now.fit, limits, now.further), context);
        FittedTurns fit = fitted(from, next, limits, context);
        if (fit.energy < (1.0 - kMinGain) * now.fit.energy) {
            now.solution = std::move(next);
            now.fit = std::move(fit);
            return true;
        }
        if (now.further == 0.0) return false;
        now.further = 0.5 * now.further < kMinFurther ? 0.0 : 0.5 * now.further;
    }
}

}  // namespace

RefinedSolution refined(const BoundarySystems& from, BoundarySolution before, int steps,
                        const Context& context) {
    if (!from.has_free()) return {std::move(before), {}};
    const std::vector<TurnLimit> limits = limits_of(from, before);
    FittedTurns fit = fitted(from, before, limits, context);
    Iteration now{before, std::move(fit)};
    std::vector<double> energy{now.fit.energy};
    for (int k = 0; k < steps && step(from, limits, now, context); ++k) {
        energy.push_back(now.fit.energy);
    }
    return {std::move(now.solution), std::move(energy)};
}

}  // namespace lissom
