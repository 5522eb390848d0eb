#include "kernel/hair/strands/strand_operators.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Steps of a profile: enough for any exponent to look smooth.
constexpr std::size_t kProfileSamples = 33;

double taper_at(double t, const TaperOptions& options) {
    const double along = std::max(0.0, (t - options.start) / (1.0 - options.start));
    return 1.0 + (options.tip - 1.0) * std::pow(along, options.shape);
}

void smooth_once(double strength, std::vector<Vec3>& points) {
    Vec3 before = points.front();
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        const Vec3 here = points[k];
        points[k] += strength * (0.5 * (before + points[k + 1]) - here);
        before = here;
    }
}

}  // namespace

void taper(Strands& strands, const TaperOptions& options) {
    require(options.tip > 0.0 && std::isfinite(options.tip), "the tip of a taper must be positive");
    require(options.start >= 0.0 && options.start < 1.0,
            "the start of a taper must be at least 0 and below 1");
    require(options.shape > 0.0 && std::isfinite(options.shape),
            "the shape of a taper must be positive");
    StrandWidths widths = strands.widths();
    std::vector<float> profile(std::max(kProfileSamples, widths.profile.size()));
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const double t = double(i) / double(profile.size() - 1);
        profile[i] = widths.factor(t) * taper_at(t, options);
    }
    widths.profile = std::move(profile);
    strands.set_widths(std::move(widths));
}

void smooth(Strands& strands, const StrandSmoothOptions& options, const Context& context) {
    require(options.iterations >= 0, "the number of passes must not be negative");
    require(options.strength > 0.0 && options.strength <= 1.0,
            "the strength must be above 0 and at most 1");
    Progress progress(context, "smooth strands");
    const auto move = [&](Index, const StrandView& old, StrandEdit& made) {
        std::vector<Vec3> points;
        for (Index k = 0; k < old.cols(); ++k) points.push_back(old.col(k).cast<double>());
        for (Index i = 0; i < options.iterations; ++i) {
            context.checkpoint();
            smooth_once(options.strength, points);
        }
        for (Index k = 0; k < old.cols(); ++k) made.col(k) = points[at(k)].cast<float>();
    };
    move_points(strands, options.effect, move, context);
}

void move_points(
    Strands& strands, const StrandOperatorOptions& effect,
    const std::function<void(Index strand, const StrandView& old, StrandEdit& made)>& move,
    const Context& context) {
    const auto change = [&](StrandWork& work) {
        StrandEdit made = work.points();
        const StrandView old = work.old_points();
        move(work.strand(), old, made);
        if (!work.is_partial()) return;
        for (Index k = 1; k < old.cols(); ++k) {
            const Vec3 from = work.old_point(k);
            work.set_point(k, from + work.weight(k) * (work.point(k) - from));
        }
        if (effect.keep_length) restore_lengths(old, made);
    };
    change_strands(strands, effect, change, context);
}

void restore_lengths(const StrandView& old, StrandEdit& made) {
    Vec3 before = old.col(0).cast<double>(), at_new = before;
    for (Index k = 1; k < old.cols(); ++k) {
        const Vec3 here = made.col(k).cast<double>();
        const Vec3 was = (old.col(k) - old.col(k - 1)).cast<double>();
        const Vec3 direction = here - before;
        const double size = direction.norm();
        at_new += size > 0.0 ? Vec3(direction * (was.norm() / size)) : was;
        before = here;
        made.col(k) = at_new.cast<float>();
    }
}

}  // namespace lissom
