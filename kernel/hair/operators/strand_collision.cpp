#include "kernel/hair/operators/strand_collision.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Differences of the distance are taken over so many metres to each side.
constexpr double kProbe = 0.001;
constexpr int kRounds = 3, kLastRounds = 8, kSteps = 4, kWrapSteps = 8;
// A point counts as outside from so much below its clearance on.
constexpr double kPushSlack = 1e-5;

class Pusher {
  public:
    Pusher(const PushOutOptions& options, StrandWork& work) : options_(options), work_(work) {}

    // Whether any point had to move.
    bool run() {
        if (!push()) return false;
        for (int round = 1; round < kRounds; ++round) {
            if (options_.keep_length) work_.restore_lengths();
            if (!push()) break;
        }
        for (int round = 0; round < kLastRounds && push_quarters(); ++round) continue;
        return true;
    }

  private:
    double floor_at(Index k) const {
        const double ramp = options_.ramp > 0.0 ? std::min(1.0, work_.arc(k) / options_.ramp) : 1.0;
        return options_.clearance * ramp * work_.weight(k);
    }

    bool surely_outside(const Vec3& p, double floor) const {
        return options_.rough && options_.rough(p) - options_.rough_error > floor;
    }

    // Moves a place to its floor; false if it is there.
    bool raise(Vec3& p, double floor) const {
        bool moved = false;
        for (int i = 0; i < kSteps; ++i) {
            if (surely_outside(p, floor)) break;
            const double missing = floor - options_.distance(p);
            if (!(missing > kPushSlack)) break;
            p += missing * outward_at(options_.distance, p);
            moved = true;
        }
        return moved;
    }

    bool push() {
        bool any = false;
        for (Index k = 1; k < work_.count(); ++k) {
            if (work_.weight(k) == 0.0) continue;
            Vec3 p = work_.point(k);
            if (!raise(p, floor_at(k))) continue;
            work_.set_point(k, p);
            any = true;
        }
        return push_segments() || any;
    }

    bool push_segments() {
        bool any = false;
        for (Index k = 1; k < work_.count(); ++k) {
            if (work_.weight(k) != 0.0 && raise_between(k, 0.5)) any = true;
        }
        return any;
    }

    // The same for places between the middle and the ends too.
    bool push_quarters() {
        bool any = push_segments();
        for (Index k = 1; k < work_.count(); ++k) {
            if (work_.weight(k) == 0.0) continue;
            if (k > 1 && raise_between(k, 0.25)) any = true;
            if (raise_between(k, 0.75)) any = true;
        }
        return any;
    }

    // Moves both ends of the segment before point k, the least that takes the place at `share` of
    // its way out of the body; the root stays.
    bool raise_between(Index k, double share) {
        const Vec3 a = work_.point(k - 1), b = work_.point(k), place = a + share * (b - a);
        Vec3 raised = place;
        const double least = 0.5 * (k > 1 ? floor_at(k - 1) : 0.0);
        if (!raise(raised, least)) return false;
        const Vec3 move = raised - place;
        const double other = 1.0 - share, both = share * share + other * other;
        if (k > 1) work_.set_point(k - 1, a + other / both * move);
        work_.set_point(k, b + (k > 1 ? share / both : 1.0 / share) * move);
        return true;
    }

    const PushOutOptions& options_;
    StrandWork& work_;
};

}  // namespace

Vec3 outward_at(const BodyDistance& distance, const Vec3& point) {
    Vec3 gradient;
    for (Index i = 0; i < 3; ++i) {
        const Vec3 step = kProbe * Vec3::Unit(i);
        gradient[i] = distance(point + step) - distance(point - step);
    }
    const double size = gradient.norm();
    return size > 0.0 && std::isfinite(size) ? Vec3(gradient / size) : Vec3::Zero();
}

void push_out(Strands& strands, const PushOutOptions& options, const Context& context) {
    require(static_cast<bool>(options.distance), "pushing strands out needs a distance");
    require(options.clearance >= 0.0 && std::isfinite(options.clearance) && options.ramp >= 0.0 &&
                std::isfinite(options.ramp),
            "the clearance and its ramp must be finite and not negative");
    Progress progress(context, "push strands out");
    const auto change = [&](StrandWork& work) { Pusher(options, work).run(); };
    change_strands(strands, options, change, context);
}

void shrinkwrap(Strands& strands, const ShrinkwrapOptions& options, const Context& context) {
    require(static_cast<bool>(options.distance), "a shrinkwrap needs a distance");
    require(options.lift >= 0.0 && std::isfinite(options.lift),
            "the lift of a shrinkwrap must be finite and not negative");
    Progress progress(context, "shrinkwrap strands");
    const auto change = [&](StrandWork& work) {
        for (Index k = 1; k < work.count(); ++k) {
            Vec3 p = work.old_point(k);
            for (int i = 0; i < kWrapSteps; ++i) {
                const double away = options.distance(p) - options.lift;
                if (!(std::abs(away) > kPushSlack)) break;
                p -= away * outward_at(options.distance, p);
            }
            work.set_point(k, p);
        }
        work.blend();
    };
    change_strands(strands, options, change, context);
}

}  // namespace lissom
