#include "kernel/hair/dynamics/hair_dynamics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/dynamics/body_grid.h"
#include "kernel/hair/dynamics/rods.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr double kFrameRate = 30.0, kMostSeconds = 10.0;
// A hurricane, and ten times the pull of the Earth: stronger ones tear rods apart in a step.
constexpr double kMostWind = 60.0, kMostGravity = 100.0;
// Metres: lengths of guides, and the farthest place of head and hair.
constexpr double kShortGuide = 1e-4, kLongGuide = 100.0, kFarthestHair = 1e5;
// Fastest swing of two linked points, radians a second.
constexpr double kLinkRate = 190.0;
// Gusts: rates of three waves, and the wind's way in metres from crest to crest.
constexpr double kGustRates[] = {0.6, 1.7, 4.1};
constexpr double kGustLength = 0.5;
constexpr Index kRodGrain = 4;
// Of memory, for each point: rods, and places before, during and after a step.
constexpr std::size_t kPlaceBytes = 320;
// Of the box around hair at rest, on each side: hair that swings farther meets no body.
constexpr double kRoom = 0.15;

bool lies_in(double value, double least, double most) {
    return value >= least && value <= most;
}

// A rotation and a translation.
bool is_rigid(const Affine& head) {
    return (head.linear * head.linear.transpose() - Mat3::Identity()).norm() < 1e-6 &&
           head.linear.determinant() > 0.0;
}

// Of rotations and translations.
Affine inverse(const Affine& head) {
    const Mat3 back = head.linear.transpose();
    return {back, -(back * head.translation)};
}

Affine between(const Affine& from, const Affine& to, double part) {
    const Eigen::Quaterniond a(from.linear), b(to.linear);
    return {a.slerp(part, b).toRotationMatrix(),
            (1.0 - part) * from.translation + part * to.translation};
}

}  // namespace

void require_dynamics(const HairDynamicsOptions& options) {
    require(options.gravity.allFinite() && options.wind.allFinite(),
            "gravity and wind are finite numbers", ErrorCode::not_finite);
    require(options.gravity.norm() <= kMostGravity, "gravity is at most 100 m/s^2");
    require(options.wind.norm() <= kMostWind, "wind is at most 60 m/s");
    require(lies_in(options.gusts, 0.0, 1.0), "gusts are a part of the wind from 0 to 1");
    require(lies_in(options.stiffness, 0.001, 10.0), "stiffness is a length of 1 mm to 10 m");
    require(lies_in(options.hold, 0.0, 1.0), "hold is from 0 to 1");
    require(lies_in(options.drag, 0.0, 50.0), "drag is from 0 to 50");
    require(lies_in(options.cohesion, 0.0, 1.0), "cohesion is from 0 to 1");
    require(lies_in(options.friction, 0.0, 10.0), "friction is from 0 to 10");
    require(lies_in(options.clearance, 0.0, 1.0), "clearance is from 0 to 1 metre");
    require(options.substeps >= 16 && options.substeps <= 1000,
            "there are 16 to 1000 substeps: stiff rods burst with fewer");
}

class HairDynamics::Simulation {
  public:
    Simulation(HairRig rig, const BodyDistance& body, const HairDynamicsOptions& options,
               const Context& context)
        : rig_((require_lists(rig), std::move(rig))),
          options_(options),
          charge_(context.charge(rig_.memory_bytes() + kPlaceBytes * rig_.curves.size(),
                                 "the dynamics of hair")),
          rods_(rig_) {
        reset();
        if (body) body_ = BodyGrid(body, reach_of_hair(), context);
        measure_gaps(context);
    }

    void step(double seconds, const Affine& head, const Context& context) {
        State next = state_;
        const double exact = std::ceil(seconds * kFrameRate * options_.substeps);
        const int count = std::max(1, static_cast<int>(exact));
        for (int i = 1; i <= count; ++i) {
            context.checkpoint();
            const Substep now{seconds / count,
                              between(state_.head, head, static_cast<double>(i) / count),
                              inverse(next.head)};
            run(next, now, context);
        }
        next.head = head;
        state_ = std::move(next);
    }

    void reset() {
        state_.places = rods_.rest();
        state_.speeds.assign(state_.places.size(), Vec3::Zero());
        state_.head = Affine();
        state_.time = 0.0;
    }

    std::vector<Eigen::Vector3f> curves() const {
        const Affine back = inverse(state_.head);
        std::vector<Eigen::Vector3f> made;
        made.reserve(state_.places.size());
        for (const Vec3& place : state_.places) made.push_back(back(place).cast<float>());
        return made;
    }

    HairMotion motion() const {
        HairMotion found;
        found.time = state_.time;
        const Affine back = inverse(state_.head);
        double squares = 0.0, speeds = 0.0;
        for (std::size_t k = 0; k < state_.places.size(); ++k) {
            const Vec3 place = back(state_.places[k]);
            const double off = (place - rods_.rest()[k]).norm();
            if (found.guide == kNoIndex || off > found.max) {
                found.max = off;
                found.guide = index_of(k) / rods_.points();
            }
            squares += off * off;
            speeds += state_.speeds[k].squaredNorm();
            if (body_.empty()) continue;
            const double deep = std::min(0.0, gap_[k]) - body_.sample(place).distance;
            found.depth = std::max(found.depth, deep);
        }
        const auto all = static_cast<double>(std::max<std::size_t>(state_.places.size(), 1));
        found.rms = std::sqrt(squares / all);
        found.speed = std::sqrt(speeds / all);
        found.stretch = greatest_stretch();
        return found;
    }

    std::size_t memory_bytes() const {
        return rig_.memory_bytes() + rods_.memory_bytes() + body_.memory_bytes() +
               rods_.rest().size() * (4 * sizeof(Vec3) + sizeof(double));
    }

    const HairRig& rig() const { return rig_; }
    const Affine& head() const { return state_.head; }
    HairDynamicsOptions& options() { return options_; }

  private:
    // All that steps change.
    struct State {
        std::vector<Vec3> places, speeds, before;
        Affine head;
        double time = 0.0;
    };

    struct Substep {
        double seconds = 0.0;
        // The head at its end, and the way back from its place at the beginning.
        Affine head;
        Affine back;
    };

    static void require_metres(const HairRig& rig) {
        for (std::size_t first = 0; first < rig.curves.size(); first += at(rig.points)) {
            double length = 0.0, far = 0.0;
            for (std::size_t k = first; k < first + at(rig.points); ++k) {
                far = std::max(far, double{rig.curves[k].norm()});
                if (k > first) length += (rig.curves[k] - rig.curves[k - 1]).norm();
            }
            require(length >= kShortGuide && length <= kLongGuide && far <= kFarthestHair,
                    "hair moves in metres: a guide is shorter than .1 mm, longer than 100 m, or "
                    "farther from the origin than 100 km; give the strands another unit or place");
        }
    }

    static void require_lists(const HairRig& rig) {
        const std::size_t points = rig.curves.size();
        require(rig.points >= 3 && points == at(rig.guide_count()) * at(rig.points) &&
                    rig.root_frames.size() == at(rig.guide_count()),
                "the lists of the rig have other lengths than its guides");
        require_metres(rig);
        for (const HairLink& link : rig.links) {
            require(link.a >= 0 && link.b >= 0 && at(link.a) < points && at(link.b) < points,
                    "a link of the rig has no such point");
        }
        for (const TiedPoints& tied : rig.ties) {
            for (const Index p : tied.points) {
                require(p >= 0 && at(p) < points, "a tie of the rig has no such point");
            }
        }
    }

    // A box around all places near the head that hair at rest is in, or falls to.
    Box reach_of_hair() const {
        Box box;
        for (const Vec3& place : rods_.rest()) box.extend(place);
        const Vec3 room = Vec3::Constant(kRoom * (box.max - box.min).maxCoeff());
        return {box.min - room, box.max + room};
    }

    // Points nearer to the body than the clearance at rest keep that distance.
    void measure_gaps(const Context& context) {
        if (body_.empty()) return;
        gap_.resize(rods_.rest().size());
        for_each_rod(context, [&](Index rod) {
            for (std::size_t k = first_of(rod); k < first_of(rod + 1); ++k) {
                gap_[k] = body_.sample(rods_.rest()[k]).distance;
            }
        });
    }

    template <typename Work>
    void for_each_rod(const Context& context, const Work& work) const {
        context.parallel_for(0, rods_.count(), kRodGrain, [&](Index begin, Index end) {
            for (Index rod = begin; rod < end; ++rod) work(rod);
        });
    }

    std::size_t first_of(Index rod) const { return at(rod * rods_.points()); }

    void run(State& state, const Substep& now, const Context& context) const {
        state.time += now.seconds;
        state.before = state.places;
        for_each_rod(context, [&](Index rod) { predict(state, now, rod); });
        pull_links(state, now);
        for_each_rod(context, [&](Index rod) {
            rods_.bend(state.places, {now.seconds, options_.stiffness, now.head, state.before},
                       rod);
            push_out(state, now, rod);
            rods_.keep_lengths(state.places, rod);
            for (std::size_t k = first_of(rod); k < first_of(rod + 1); ++k) {
                state.speeds[k] = (state.places[k] - state.before[k]) / now.seconds;
            }
        });
        state.head = now.head;
    }

    // Moves points freely; the air acts on the speed at the end, so that no drag is too strong.
    void predict(State& state, const Substep& now, Index rod) const {
        const Vec3 carried = now.head.linear * (options_.hold * options_.gravity);
        const Vec3 pull = options_.gravity - carried;
        const double h = now.seconds, slowed = 1.0 + h * options_.drag;
        for (std::size_t k = first_of(rod); k < first_of(rod + 1); ++k) {
            const Vec3 air = options_.drag * wind_at(state.places[k], state.time, rod);
            state.speeds[k] = (state.speeds[k] + h * (pull + air)) / slowed;
            state.places[k] += h * state.speeds[k];
        }
        rods_.hold(state.places, now.head, rod);
    }

    Vec3 wind_at(const Vec3& place, double time, Index rod) const {
        const double speed = options_.wind.norm();
        if (speed == 0.0) return Vec3::Zero();
        const double way = place.dot(options_.wind) / (speed * kGustLength);
        const double own = signed_random(mixed(options_.seed, static_cast<std::uint64_t>(rod)));
        double gust = 0.0;
        for (const double rate : kGustRates) {
            gust += std::sin(2.0 * kPi * (rate * time - way + 0.3 * own * rate)) / 3.0;
        }
        return (1.0 + options_.gusts * gust) * options_.wind;
    }

    // One pass in the order of the links.
    void pull_links(State& state, const Substep& now) const {
        for (const HairLink& link : rig_.links) {
            const double rate = kLinkRate * (link.bound ? 1.0 : options_.cohesion);
            const double a = rods_.held(link.a) ? 0.0 : 1.0, b = rods_.held(link.b) ? 0.0 : 1.0;
            if (rate == 0.0 || a + b == 0.0) continue;
            Vec3& from = state.places[at(link.a)];
            Vec3& to = state.places[at(link.b)];
            const Vec3 along = to - from;
            const double length = along.norm();
            if (length == 0.0) continue;
            const double softness = 1.0 / (rate * rate * now.seconds * now.seconds);
            const Vec3 pull = (length - link.length) / (length * (a + b + softness)) * along;
            from += a * pull;
            to -= b * pull;
        }
    }

    // Contact with Coulomb's friction against the skin, which moves with the head.
    void push_out(State& state, const Substep& now, Index rod) const {
        if (body_.empty()) return;
        const Affine back = inverse(now.head), carry = now.head * now.back;
        for (std::size_t k = first_of(rod); k < first_of(rod + 1); ++k) {
            if (rods_.held(index_of(k))) continue;
            const Vec3 place = back(state.places[k]);
            const BodyGrid::Sample skin = body_.sample(place);
            const double lacking = std::min(options_.clearance, gap_[k]) - skin.distance;
            if (lacking <= 0.0) continue;
            const Vec3 normal = now.head.linear * skin.gradient.normalized();
            state.places[k] += lacking * normal;
            const Vec3 moved = state.places[k] - carry(state.before[k]);
            const Vec3 slid = moved - moved.dot(normal) * normal;
            const double way = slid.norm();
            if (way == 0.0) continue;
            state.places[k] -= std::min(1.0, options_.friction * lacking / way) * slid;
        }
    }

    double greatest_stretch() const {
        double stretch = 0.0;
        for (std::size_t k = 0; k + 1 < state_.places.size(); ++k) {
            if ((index_of(k) + 1) % rods_.points() == 0) continue;
            const double rest = (rods_.rest()[k + 1] - rods_.rest()[k]).norm();
            const double now = (state_.places[k + 1] - state_.places[k]).norm();
            if (rest > 0.0) stretch = std::max(stretch, std::abs(now / rest - 1.0));
        }
        return stretch;
    }

    HairRig rig_;
    BodyGrid body_;
    HairDynamicsOptions options_;
    MemoryCharge charge_;
    Rods rods_;
    // Distances of points to the body at rest.
    std::vector<double> gap_;
    State state_;
};

HairDynamics::HairDynamics(HairRig rig, const BodyDistance& body,
                           const HairDynamicsOptions& options, const Context& context) {
    require_dynamics(options);
    simulation_ = std::make_unique<Simulation>(std::move(rig), body, options, context);
}

HairDynamics::HairDynamics(HairDynamics&&) noexcept = default;
HairDynamics& HairDynamics::operator=(HairDynamics&&) noexcept = default;
HairDynamics::~HairDynamics() = default;

const HairRig& HairDynamics::rig() const {
    return simulation_->rig();
}

const HairDynamicsOptions& HairDynamics::options() const {
    return simulation_->options();
}

void HairDynamics::set_options(const HairDynamicsOptions& options) {
    require_dynamics(options);
    simulation_->options() = options;
}

void HairDynamics::step(double seconds, const Affine& head, const Context& context) {
    require(seconds > 0.0 && seconds <= kMostSeconds, "a step is above 0 and at most 10 seconds");
    require(head.linear.allFinite() && head.translation.allFinite(),
            "the place of the head is not finite", ErrorCode::not_finite);
    require(head.translation.norm() <= kFarthestHair, "the head is farther away than 100 km");
    require(is_rigid(head),
            "the head of moving hair turns and moves; scale or bend it by strands:follow");
    simulation_->step(seconds, head, context);
}

void HairDynamics::step(double seconds, const Context& context) {
    step(seconds, head(), context);
}

void HairDynamics::reset() {
    simulation_->reset();
}

std::vector<Eigen::Vector3f> HairDynamics::curves() const {
    return simulation_->curves();
}

const Affine& HairDynamics::head() const {
    return simulation_->head();
}

HairMotion HairDynamics::motion() const {
    return simulation_->motion();
}

std::size_t HairDynamics::memory_bytes() const {
    return simulation_->memory_bytes();
}

}  // namespace lissom
