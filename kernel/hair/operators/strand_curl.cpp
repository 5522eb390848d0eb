#include "kernel/hair/operators/strand_curl.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/operators/guide_table.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kRadiusStream = 21, kWavelengthStream = 22, kGuidePhaseStream = 23,
                        kPhaseStream = 24, kHandStream = 25;
constexpr double kMaxCurlPoints = 4096.0;
// Steps of a table that is right to 1e-6 turns.
constexpr int kHangSteps = 1024;

bool is_measure(double x) {
    return x >= 0.0 && std::isfinite(x);
}

void require_curl(const CurlOptions& options) {
    require(is_measure(options.radius) && is_measure(options.tip) && is_measure(options.start) &&
                is_measure(options.ramp),
            "'radius', 'tip', 'start' and 'ramp' of a curl must be finite and not negative");
    require(options.wavelength > 0.0 && std::isfinite(options.wavelength),
            "the wavelength of a curl must be positive and finite");
    require(options.hang >= 0.0 && options.hang <= 1.5, "the hang of a curl must be from 0 to 1.5");
    require(options.variation >= 0.0 && options.variation < 1.0,
            "the variation of a curl must be at least 0 and below 1");
    require(options.phase >= 0.0 && options.phase <= 1.0 && options.depth >= 0.0 &&
                options.depth <= 1.0,
            "the phase and the depth of a curl must be from 0 to 1");
    require(std::all_of(options.begin.begin(), options.begin.end(),
                        [](float turns) { return std::isfinite(turns); }),
            "the turns at which a curl begins must be finite");
    require(options.points_per_turn >= 0 && options.points_per_turn <= 64,
            "a curl has from 0 to 64 points a turn");
}

// The curl of one guide.
struct Winding {
    double radius, wavelength, phase, hand;
    Vec3 normal;
};

// The curls of all guides, taken before any strand moves.
class Curls {
  public:
    Curls(const Strands& strands, const CurlOptions& options)
        : options_(options),
          guide_of_(present_guides(strands)),
          guides_(strands.guides()),
          slots_(at(strands.size()), kNoIndex) {
        set_logs();
        for (Index s = 0; s < strands.size(); ++s) {
            if (guide_of_[at(s)] != s) continue;
            slots_[at(s)] = count_of(windings_);
            windings_.push_back(make_winding(strands.id(s), strands.strand(s)));
        }
    }

    // Radius at a place along a strand, without the weight of the effect.
    double radius(const Winding& winding, double arc, double t) const {
        return winding.radius * smooth_step(options_.start, options_.start + options_.ramp, arc) *
               (1.0 + (options_.tip - 1.0) * t);
    }

    // That of the guide; of the strand itself if it has none, or one that is not there.
    Winding winding_of(Index s, std::uint32_t own_id, const StrandView& strand) const {
        const Index guide = guide_of_[at(s)];
        if (guide != kNoIndex) return windings_[at(slots_[at(guide)])];
        const bool follows = guides_.ids[at(s)] != kNoGuide;
        return make_winding(follows ? guides_.ids[at(s)] : own_id, strand);
    }

    // Arc of the guide at the tip of a strand of this length, and the whole arc of the guide.
    double arc_of(Index s, double length) const {
        return guides_.ids[at(s)] == kNoGuide ? length : guides_.arcs[at(s)];
    }
    double whole_arc(Index s, double length) const {
        const Index guide = guide_of_[at(s)];
        const double own = arc_of(s, length);
        return guide == kNoIndex ? own : std::max<double>(guides_.arcs[at(guide)], own);
    }

    // Turns at an arc of the guide; hang makes those at the tip shorter: the integral of 1 /
    // (wavelength (1 + hang (.5 - a / whole))).
    double turns(const Winding& winding, double arc, double whole) const {
        const double h = options_.hang;
        if (h < 1e-6 || !(whole > 0.0)) return arc / winding.wavelength;
        const double place = std::min(1.0, arc / whole) * kHangSteps;
        const auto below = std::min(static_cast<std::size_t>(place), std::size_t{kHangSteps - 1});
        const double a = logs_[below], b = logs_[below + 1];
        return whole / winding.wavelength * (a + (place - double(below)) * (b - a));
    }

    double wavelength_at(const Winding& winding, double arc, double whole) const {
        const double share = whole > 0.0 ? std::min(1.0, arc / whole) : 0.0;
        return winding.wavelength * (1.0 + options_.hang * (0.5 - share));
    }

  private:
    // What turns() needs a logarithm for, at equal steps of the guide.
    void set_logs() {
        const double h = options_.hang, at_root = 1.0 + 0.5 * h;
        if (h < 1e-6) return;
        for (int i = 0; i <= kHangSteps; ++i) {
            logs_.push_back(std::log(at_root / (at_root - h * i / kHangSteps)) / h);
        }
    }

    Winding make_winding(std::uint32_t id, const StrandView& shape) const {
        const auto random = [&](std::uint64_t stream) {
            return signed_random(mixed(options_.seed, id, stream));
        };
        const Vec3 root = point_of(shape, 0);
        const double phase = options_.together
                                 ? smooth_phase(root) + 0.02 * random(kGuidePhaseStream)
                                 : 0.5 * random(kGuidePhaseStream);
        return {options_.radius * (1.0 + options_.variation * random(kRadiusStream)),
                options_.wavelength * (1.0 + options_.variation * random(kWavelengthStream)), phase,
                hand_of(root, random(kHandStream)), first_normal(shape)};
    }

    double smooth_phase(const Vec3& root) const {
        return 0.16 * (sine_of_turns(5.0 * root.x() + 2.7 * root.z() + 0.16) +
                       sine_of_turns(3.7 * root.y() - 4.6 * root.z() + 0.32));
    }

    double hand_of(const Vec3& root, double random) const {
        if (options_.hand == CurlHand::left) return -1.0;
        if (options_.hand == CurlHand::right) return 1.0;
        const double side = options_.hand == CurlHand::mirrored ? root.x() : random;
        return side > 0.0 ? 1.0 : -1.0;
    }

    // Across the guide's root, towards the side that the guide bends to: on a head inward, so that
    // neighbours begin alike. A straight guide has no such side.
    static Vec3 first_normal(const StrandView& shape) {
        constexpr double kStraightGuide = 0.01;
        const Vec3 root = point_of(shape, 0);
        Vec3 along = Vec3::Zero(), middle = Vec3::Zero();
        for (Index k = 1; k < shape.cols(); ++k) {
            const Vec3 away = point_of(shape, k) - root;
            if (along.isZero() && away.norm() > 0.0) along = away.normalized();
            middle += away / double(shape.cols() - 1);
        }
        if (along.isZero()) return Vec3::UnitX();
        const Vec3 side = middle - middle.dot(along) * along;
        const bool bends = side.norm() > kStraightGuide * middle.norm();
        return bends ? Vec3(side.normalized()) : Vec3(along.unitOrthogonal());
    }

    const CurlOptions& options_;
    std::vector<Index> guide_of_;
    StrandGuides guides_;
    std::vector<Index> slots_;
    std::vector<Winding> windings_;
    std::vector<double> logs_;
};

// Arc of the guide at an arc of a strand. A strand that was gathered is longer than its part of the
// guide by the way it takes to come there, near its root: then both are measured from the tip.
double guide_arc(double arc, double length, double reach) {
    constexpr double kWayToGuide = 0.25;
    const double more = length - reach;
    if (more >= 0.0 && more <= kWayToGuide * length) return std::max(0.0, arc - more);
    return arc / length * reach;
}

// `kept` is the length that the strand has if it keeps its length.
void wind(StrandWork& work, const CurlOptions& options, const Curls& curls, double kept) {
    const double length = work.length(), reach = curls.arc_of(work.strand(), length);
    const double whole = curls.whole_arc(work.strand(), length);
    const Winding winding = curls.winding_of(work.strand(), work.id(), work.old_points());
    const double own =
        options.phase * 0.5 * signed_random(mixed(options.seed, work.id(), kPhaseStream));
    const double begin =
        options.begin.empty() ? winding.phase : double{options.begin[at(work.strand())]};
    const double step = kept / (work.count() - 1);
    const double spread = 0.5 * (1.0 + options.depth * options.depth);
    work.make_frames(winding.normal);
    double arc = 0.0, advance = step;
    Index below = 0;
    for (Index k = 1; k < work.count(); ++k) {
        const double middle = std::min(arc + 0.5 * advance, length), t = middle / length;
        if (options.keep_length) {
            const double radius = curls.radius(winding, middle, t) * work.weight_at(t);
            const double turn =
                2.0 * kPi * radius /
                curls.wavelength_at(winding, guide_arc(middle, length, reach), whole);
            advance = step / std::sqrt(1.0 + spread * turn * turn);
        }
        arc = std::min(arc + advance, length);
        const double radius =
            curls.radius(winding, arc, arc / length) * work.weight_at(arc / length);
        const Vec3 center = work.old_at(arc, below);
        const bool past_middle = 2.0 * arc > work.arc(below) + work.arc(below + 1);
        const Index near = past_middle ? below + 1 : below;
        const double turns =
            begin + own + curls.turns(winding, guide_arc(arc, length, reach), whole);
        const Vec3 across = work.tangent(near).cross(work.normal(near));
        work.set_point(
            k, center + radius * (options.depth * cosine_of_turns(turns) * work.normal(near) +
                                  winding.hand * sine_of_turns(turns) * across));
    }
    if (options.keep_length) work.space_evenly(kept);
}

// Points that a strand needs to show its turns.
Index points_for(const Strands& strands, Index s, const CurlOptions& options, const Curls& curls) {
    const StrandView strand = strands.strand(s);
    const auto count = index_of(strand.cols());
    if (count < 2 || !strand.allFinite()) return count;
    if (!options.mask.empty() && options.mask[at(s)] == 0.0f) return count;
    const double whole = length(strand);
    const Winding winding = curls.winding_of(s, strands.id(s), strand);
    const double tight = winding.wavelength * (1.0 - 0.25 * options.hang);
    const double widest = winding.radius * std::max(1.0, options.tip) * options.factor;
    const double turn = 2.0 * kPi * widest / tight;
    const double one = options.keep_length ? tight * std::sqrt(1.0 + turn * turn) : tight;
    const double wanted = std::ceil(options.points_per_turn * whole / one) + 1.0;
    return std::max(count, static_cast<Index>(std::min(wanted, kMaxCurlPoints)));
}

std::vector<Index> counts_for(const Strands& strands, const CurlOptions& options,
                              const Curls& curls, const Context& context) {
    if (options.points_per_turn == 0) return {};
    std::vector<Index> counts(at(strands.size()));
    context.parallel_for(0, strands.size(), 256, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) counts[at(s)] = points_for(strands, s, options, curls);
    });
    bool enough = true;
    for (Index s = 0; s < strands.size(); ++s) {
        enough = enough && counts[at(s)] == strands.point_count(s);
    }
    return enough ? std::vector<Index>() : counts;
}

// `lengths` are those to keep; empty for those of the strands.
void wind_all(Strands& strands, const CurlOptions& options, const Curls& curls,
              const std::vector<double>& lengths, const Context& context) {
    change_strands(
        strands, options,
        [&](StrandWork& work) {
            wind(work, options, curls,
                 lengths.empty() ? work.length() : lengths[at(work.strand())]);
        },
        context);
}

}  // namespace

void curl(Strands& strands, const CurlOptions& options, const Context& context) {
    require_curl(options);
    require_operator(strands, options);
    require(options.begin.empty() || count_of(options.begin) == strands.size(),
            "there are " + std::to_string(options.begin.size()) + " beginnings of a curl for " +
                std::to_string(strands.size()) + " strands; give one for each strand");
    if (options.factor == 0.0 || options.radius == 0.0) return;
    Progress progress(context, "curl strands");
    StrandGuides before = strands.guides();
    try {
        ensure_guides(strands, options.guides, context);
        const Curls curls(strands, options);
        const std::vector<Index> counts = counts_for(strands, options, curls, context);
        if (counts.empty()) return wind_all(strands, options, curls, {}, context);
        Strands made = with_point_counts(strands, counts, context);
        std::vector<double> lengths;
        for (Index s = 0; s < strands.size(); ++s) lengths.push_back(length(strands.strand(s)));
        wind_all(made, options, curls, lengths, context);
        strands = std::move(made);
    } catch (...) {
        strands.set_guides(std::move(before));
        throw;
    }
}

CurlOptions wave_options() {
    CurlOptions options;
    options.radius = 0.009;
    options.wavelength = 0.095;
    options.tip = 1.3;
    options.start = 0.07;
    options.ramp = 0.09;
    options.hang = 0.0;
    options.phase = 0.05;
    options.together = true;
    options.hand = CurlHand::mirrored;
    options.depth = 0.6;
    return options;
}

}  // namespace lissom
