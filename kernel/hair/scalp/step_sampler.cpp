#include "kernel/hair/scalp/step_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Rows of the first sampling, from which the step is guessed; at most as many.
constexpr Index kFirstRows = 64, kMaxRows = 40'000;
// How far a root is moved at random, in steps.
constexpr double kJitter = 0.25;

// A cell of the grid of angles: row i of `rows` from the top, column j of twice as many.
struct AngleCell {
    Index row, column, rows;
};

class StepSampler {
  public:
    StepSampler(const Scalp& scalp, const RootSurface& surface, std::uint64_t seed,
                const Context& context)
        : scalp_(scalp), surface_(surface), seed_(seed), context_(context) {}

    // All roots of a step of pi / rows.
    std::vector<Root> sample(Index rows) const {
        std::vector<std::vector<Root>> found(at(rows));
        context_.parallel_for(0, rows, 4, [&](Index from, Index to) {
            for (Index row = from; row < to; ++row) found[at(row)] = sample_row(row, rows);
        });
        std::vector<Root> roots;
        for (const auto& row : found) roots.insert(roots.end(), row.begin(), row.end());
        return roots;
    }

    // The same order for the same number of roots.
    void shuffle(std::vector<Root>& roots) const {
        CountedRandom random(seed_, roots.size());
        for (std::size_t i = roots.size(); i > 1; --i) {
            std::swap(roots[i - 1], roots[random.bits() % i]);
        }
    }

  private:
    std::vector<Root> sample_row(Index row, Index rows) const {
        std::vector<Root> roots;
        for (Index column = 0; column < 2 * rows; ++column) {
            if (const auto root = root_of({row, column, rows})) roots.push_back(*root);
        }
        return roots;
    }

    std::optional<Root> root_of(const AngleCell& cell) const {
        const std::uint64_t number =
            static_cast<std::uint64_t>(cell.row) * 2 * static_cast<std::uint64_t>(cell.rows) +
            static_cast<std::uint64_t>(cell.column);
        CountedRandom random(seed_, number);
        const auto moved = [&](Index place) {
            return place + 0.5 + kJitter * (2.0 * random.uniform() - 1.0);
        };
        const double step = kPi / cell.rows;
        const double phi = step * moved(cell.column), theta = step * moved(cell.row);
        const std::optional<SurfacePoint> hit = scalp_.surface_in({phi - kPi, 0.5 * kPi - theta});
        if (!hit) return std::nullopt;
        const double density = surface_.density_at(hit->face, hit->triangle, hit->barycentric);
        if (random.uniform() >= density) return std::nullopt;
        return Root{hit->face, hit->triangle, hit->barycentric, hit->position, Vec3::Zero()};
    }

    const Scalp& scalp_;
    const RootSurface& surface_;
    std::uint64_t seed_;
    const Context& context_;
};

// Returns the number of rows expected to give `wanted` roots, if `rows` gave `found`.
Index better_rows(Index rows, double found, double wanted) {
    const double factor = std::sqrt(wanted / std::max(found, 1.0));
    return static_cast<Index>(std::min<double>(std::ceil(rows * factor), kMaxRows));
}

}  // namespace

std::vector<Root> roots_in_steps(const Scalp& scalp, const RootSurface& surface,
                                 const RootOptions& options, const Context& context) {
    const StepSampler sampler(scalp, surface, options.seed, context);
    const auto wanted = static_cast<double>(options.count);
    Index rows = kFirstRows;
    std::vector<Root> roots = sampler.sample(rows);
    rows = better_rows(rows, static_cast<double>(roots.size()), wanted);
    for (roots = sampler.sample(rows); count_of(roots) < options.count;) {
        context.checkpoint();
        if (rows >= kMaxRows) {
            throw Error(ErrorCode::region_empty,
                        "the scalp is too small a part of the directions around the center of the "
                        "head for roots in steps of angles; use the poisson pattern");
        }
        rows = std::max(rows + 1, better_rows(rows, static_cast<double>(roots.size()), wanted));
        roots = sampler.sample(rows);
    }
    sampler.shuffle(roots);
    roots.resize(at(options.count));
    return roots;
}

}  // namespace lissom
