#include "kernel/hair/scalp/roots.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/hair/scalp/dart_thrower.h"
#include "kernel/hair/scalp/root_surface.h"
#include "kernel/hair/scalp/step_sampler.h"

namespace lissom {
namespace {

// The n-th point of Sobol's sequence in two dimensions: of every beginning with 4^k points one lies
// in each cell of a grid of 2^k by 2^k. The seed shuffles cells at all levels alike.
Vec2 grid_point(std::uint32_t n, std::uint64_t seed) {
    CountedRandom random(seed, 0);
    std::uint64_t x = 0, y = 0, column = 1ULL << 31;
    std::uint32_t bit = 31;
    for (std::uint32_t rest = n; rest != 0; rest >>= 1, --bit) {
        if (rest & 1U) {
            x ^= 1ULL << bit;
            y ^= column;
        }
        column ^= column >> 1;
    }
    x ^= random.bits() >> 32;
    y ^= random.bits() >> 32;
    CountedRandom within(seed, 1 + static_cast<std::uint64_t>(n));
    return {(x + within.uniform()) * 0x1p-32, (y + within.uniform()) * 0x1p-32};
}

class AngleSampler {
  public:
    AngleSampler(const Scalp& scalp, const RootSurface& surface, const RootOptions& options,
                 const Context& context)
        : scalp_(scalp), surface_(surface), options_(options), context_(context) {}

    std::vector<Root> run() {
        Progress progress(context_, "roots");
        std::vector<Root> roots;
        roots.reserve(options_.count);
        std::vector<std::optional<Root>> batch(kBatch);
        for (std::uint32_t first = 0; count_of(roots) < options_.count; first += kBatch) {
            progress.update(roots.size(), options_.count);
            require_progress(first, roots.size());
            context_.parallel_for(0, kBatch, 256, [&](Index from, Index to) {
                for (Index i = from; i < to; ++i) batch[i] = root_of(first + i);
            });
            for (const std::optional<Root>& root : batch) {
                if (root && count_of(roots) < options_.count) {
                    roots.push_back(*root);
                }
            }
        }
        return roots;
    }

  private:
    static constexpr Index kBatch = 8192;

    // Fewer than one in a thousand rays that hit, or more rays than can be numbered.
    static void require_progress(std::uint32_t thrown, std::size_t found) {
        if (thrown < 100 * kBatch || found >= thrown / 1000) {
            if (thrown < 0xf0000000U) return;
        }
        throw Error(ErrorCode::region_empty,
                    "the scalp is too small a part of the directions around the center of the "
                    "head for roots by angles; use the poisson pattern");
    }

    std::optional<Root> root_of(std::uint32_t n) const {
        const Vec2 at = grid_point(n, options_.seed);
        const ScalpDirection direction{2.0 * kPi * at.x() - kPi, 0.5 * kPi - kPi * at.y()};
        const std::optional<SurfacePoint> hit = scalp_.surface_in(direction);
        if (!hit) return std::nullopt;
        const double density = surface_.density_at(hit->face, hit->triangle, hit->barycentric);
        CountedRandom random(~options_.seed, n);
        if (random.uniform() >= density) return std::nullopt;
        return Root{hit->face, hit->triangle, hit->barycentric, hit->position, Vec3::Zero()};
    }

    const Scalp& scalp_;
    const RootSurface& surface_;
    const RootOptions& options_;
    const Context& context_;
};

std::vector<Root> roots_of_pattern(const Scalp& scalp, const RootSurface& surface,
                                   const RootOptions& options, const Context& context) {
    switch (options.pattern) {
        case RootPattern::poisson:
            return throw_darts(surface, options, context);
        case RootPattern::angles:
            return AngleSampler(scalp, surface, options, context).run();
        case RootPattern::steps:
            break;
    }
    return roots_in_steps(scalp, surface, options, context);
}

}  // namespace

double hairline_thinning(double margin) {
    const double t = std::clamp(margin, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

std::vector<Root> make_roots(const Mesh& head, const Scalp& scalp, const RootOptions& options,
                             const Context& context) {
    require_same_topology(head, scalp.region().topology(), "the scalp");
    if (options.count < 0 || options.count > kMaximumRoots) {
        throw Error(ErrorCode::out_of_range, "the number of roots must lie between 0 and " +
                                                 std::to_string(kMaximumRoots) + ", not " +
                                                 std::to_string(options.count));
    }
    const auto charge = context.charge(at(options.count) * 2 * sizeof(Root), "roots");
    const RootSurface surface(head, scalp, options);
    std::vector<Root> roots = roots_of_pattern(scalp, surface, options, context);
    context.parallel_for(0, count_of(roots), 4096, [&](Index from, Index to) {
        for (Index i = from; i < to; ++i) {
            roots[i].normal = scalp.normal_at(roots[i].triangle, roots[i].barycentric);
        }
    });
    return roots;
}

}  // namespace lissom
