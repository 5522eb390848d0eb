#include "kernel/hair/operators/strand_braid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/operators/braid_spine.h"
#include "kernel/hair/operators/strand_tails.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kPlaceStream = 61, kLooseStream = 62, kEndStream = 63, kLockStream = 64;

// In [0, 1).
double even_random(std::uint64_t seed, std::uint64_t id, std::uint64_t stream) {
    return 0.5 + 0.5 * signed_random(mixed(seed, id, stream));
}

// A strand that passes a tie after its point `last`, u and v metres from the center.
struct TieCrossing {
    Index strand, last;
    double u, v;
};

struct TieFrame {
    Vec3 center, u, v, along;
    double reach;
};

TieFrame frame_of_tie(const Vec3& center, const Vec3& along, const Vec3& across, double reach) {
    const Vec3 n = along.normalized();
    const Vec3 u = (across - across.dot(n) * n).normalized();
    return {center, u, n.cross(u), n, reach};
}

std::vector<TieCrossing> crossings_of(const Strands& strands, const TieFrame& tie,
                                      const std::vector<float>& mask) {
    std::vector<TieCrossing> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (!mask.empty() && mask[at(s)] < 0.5f) continue;
        const StrandView strand = strands.strand(s);
        if (!strand.allFinite()) continue;
        double before = 0.0;
        for (Index k = 0; k < strand.cols(); ++k) {
            const Vec3 off = point_of(strand, k) - tie.center;
            const double side = off.dot(tie.along), u = off.dot(tie.u), v = off.dot(tie.v);
            if (k > 0 && before < 0.0 && side >= 0.0 && u * u + v * v < tie.reach * tie.reach) {
                list.push_back({s, k - 1, u, v});
                break;
            }
            before = side;
        }
    }
    return list;
}

std::vector<CutStrand> ends_of(const std::vector<TieCrossing>& crossings) {
    std::vector<CutStrand> ends;
    for (const TieCrossing& crossing : crossings) ends.push_back({crossing.strand, crossing.last});
    return ends;
}

void require_enough(std::size_t crossings) {
    require(crossings >= 3, "only " + std::to_string(crossings) +
                                " strands pass the tie; move it, give it more reach, or lead more "
                                "hair to it");
}

// ---- Braids

void require_braid(const Strands& strands, const BraidOptions& options) {
    require_operator(strands, options);
    require_spine(options.spine, options.across);
    require(options.radius > 0.0 && options.length > 0.0 && options.blend > 0.0 &&
                options.step > 0.0 && std::isfinite(options.radius + options.length) &&
                std::isfinite(options.blend + options.step),
            "'radius', 'length', 'blend' and 'step' of a braid must be positive and finite");
    require(is_length(options.reach) && is_length(options.tuft) && is_length(options.wavelength),
            "'reach', 'tuft' and 'wavelength' of a braid must be finite and not negative");
    require(options.taper >= 0.0 && options.taper < 1.0 && options.loose >= 0.0 &&
                options.loose <= 1.0 && options.early >= 0.0 && options.early <= 1.0,
            "'taper', 'loose' and 'early' of a braid are parts from 0 to 1");
    require((options.length + options.tuft) / options.step < 1e5,
            "the step of a braid is too small for its length");
}

// Sorts crossings into tubes by their place across: the outer ones and the one between.
std::vector<int> tubes_of(const std::vector<TieCrossing>& crossings) {
    std::vector<std::size_t> order(crossings.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(crossings[a].u, a) < std::pair(crossings[b].u, b);
    });
    constexpr std::array<int, 3> kTubes = {2, 0, 1};
    std::vector<int> tubes(crossings.size());
    for (std::size_t k = 0; k < order.size(); ++k) tubes[order[k]] = kTubes[3 * k / order.size()];
    return tubes;
}

class Braider {
  public:
    Braider(const BraidOptions& options, const BraidSpine& spine, double length)
        : options_(options),
          spine_(spine),
          length_(length),
          wavelength_(options.wavelength > 0.0 ? options.wavelength : 7.0 * options.radius) {}

    void run(std::uint32_t id, const TieCrossing& crossing, int tube,
             std::vector<Vec3>& points) const {
        const std::uint64_t seed = options_.seed;
        double rho = std::sqrt(even_random(seed, id, kPlaceStream));
        const double turn = even_random(seed, id, kPlaceStream + 100);
        if (even_random(seed, id, kLooseStream) < options_.loose) rho = 1.05 + 0.35 * rho;
        const double end = end_of(id);
        for (double a = 0.001; a < end; a += options_.step) {
            points.push_back(place(a, crossing, tube, rho, turn));
        }
    }

  private:
    double end_of(std::uint32_t id) const {
        const double u = even_random(options_.seed, id, kEndStream);
        if (even_random(options_.seed, id, kEndStream + 100) < options_.early) {
            return length_ * (0.35 + 0.6 * u);
        }
        return length_ + options_.tuft * (0.3 + 0.7 * std::pow(u, 0.7));
    }

    double scale(double a) const { return 1.0 - options_.taper * std::min(a / length_, 1.0); }

    // Center of a tube across and towards the viewer.
    std::pair<double, double> center(int tube, double a) const {
        const double tied = smooth_step(length_ - 0.02, length_ - 0.004, a);
        const double size =
            options_.radius * scale(a) * smooth_step(0.0, options_.blend, a) * (1.0 - tied);
        const double turns = a / wavelength_ + tube / 3.0;
        return {1.25 * size * sine_of_turns(turns), 0.8 * size * sine_of_turns(2.0 * turns)};
    }

    Vec3 place(double a, const TieCrossing& crossing, int tube, double rho, double turn) const {
        const auto [x, z] = center(tube, a);
        const double slope = (center(tube, a + 0.001).first - x) / 0.001;
        const double tilt = std::sqrt(1.0 + slope * slope);
        // The lower tie, and the tuft, a brush that widens a little below it: one that closed to
        // its end would look like a bulb.
        const double tied = smooth_step(length_ - 0.022, length_ - 0.003, a);
        const double flare =
            1.0 + 0.4 * smooth_step(length_, length_ + 0.03, a) -
            0.3 * smooth_step(length_ + 0.5 * options_.tuft, length_ + options_.tuft, a);
        const double r = options_.radius * scale(a);
        const double wide = 1.15 * r * (1.0 - tied) + 0.5 * options_.radius * flare * tied;
        const double high = 0.9 * r * (1.0 - tied) + 0.45 * options_.radius * flare * tied;
        const double cu = rho * cosine_of_turns(turn) * wide, cv = rho * sine_of_turns(turn) * high;
        // The section is perpendicular to the tube in the plane of the braid.
        const double w = smooth_step(0.0, options_.blend, a);
        const double from_x = 0.9 * crossing.u, from_z = 0.9 * crossing.v;
        return spine_.place(a, from_x + w * (x + cu / tilt - from_x),
                            from_z + w * (z + cv - from_z), -w * cu * slope / tilt);
    }

    const BraidOptions& options_;
    const BraidSpine& spine_;
    double length_, wavelength_;
};

}  // namespace

BraidReport braid(Strands& strands, const BraidOptions& options, const Context& context) {
    require_braid(strands, options);
    Progress progress(context, "braid strands");
    const BraidSpine spine(options.spine, options.across);
    require(options.across.cross(spine.direction()).norm() > 1e-6 * options.across.norm(),
            "the direction across a braid must not run along its spine");
    const double reach = options.reach > 0.0 ? options.reach : 2.2 * 1.3 * options.radius;
    const std::vector<TieCrossing> crossings =
        crossings_of(strands, frame_of_tie(spine.start(), spine.direction(), options.across, reach),
                     options.mask);
    require_enough(crossings.size());
    const std::vector<int> tubes = tubes_of(crossings);
    const Braider braider(options, spine, std::min(options.length, spine.length()));
    const auto tail = [&](std::size_t i, std::vector<Vec3>& points) {
        braider.run(strands.id(crossings[i].strand), crossings[i], tubes[i], points);
    };
    const Index all = strands.size();
    carry_on(strands, ends_of(crossings), tail, context);
    return {count_of(crossings), all - count_of(crossings)};
}

BraidReport bun(Strands& strands, const BunOptions& options, const Context& context) {
    require_operator(strands, options);
    const Vec3& along = options.tie.direction;
    require(options.tie.center.allFinite() && along.allFinite() && along.norm() > 0.0,
            "the tie of a bun needs a finite center and a direction");
    require(options.tie.reach > 0.0 && options.radius > 0.0 && options.tube > 0.0 &&
                std::isfinite(options.tie.reach + options.radius + options.tube) &&
                std::isfinite(options.lift + options.turn),
            "'reach', 'radius' and 'tube' of a bun must be positive and finite");
    require(options.locks >= 1 && options.points >= 4 && options.points <= 10000 &&
                options.loose >= 0.0 && options.loose <= 1.0,
            "a bun needs at least one lock and from 4 to 10000 points, and 'loose' from 0 to 1");
    Progress progress(context, "wind a bun");
    const TieFrame tie =
        frame_of_tie(options.tie.center, along, along.unitOrthogonal(), options.tie.reach);
    const std::vector<TieCrossing> crossings = crossings_of(strands, tie, options.mask);
    require_enough(crossings.size());
    const auto tail = [&](std::size_t i, std::vector<Vec3>& points) {
        const TieCrossing& crossing = crossings[i];
        const std::uint32_t id = strands.id(crossing.strand);
        const auto random = [&](std::uint64_t stream) {
            return even_random(options.seed, id, stream);
        };
        const double from = std::atan2(crossing.v, crossing.u) / (2.0 * kPi);
        const double spread = random(kLockStream) + random(kLockStream + 100) - 1.0;
        const auto lock = static_cast<std::uint64_t>(
            options.locks + std::floor((from + 0.5) * options.locks + 0.5 * spread));
        const double own = even_random(options.seed, lock, kLockStream + 200) - 0.5;
        double rho =
            options.tube * (1.0 - 0.35 * std::pow(random(kPlaceStream), 1.5)) + 0.0015 * own;
        if (random(kLooseStream) < options.loose)
            rho = options.tube * (1.03 + 0.2 * random(kEndStream));
        const double turns = (options.turn * (1.0 + 0.25 * own) + 0.24 * spread) / (2.0 * kPi);
        const Vec3 start = point_of(strands.strand(crossing.strand), crossing.last);
        for (Index k = 1; k <= options.points; ++k) {
            const double t = double(k) / options.points;
            // From the hole over the outside to below, in turns.
            const double b = (190.0 - 250.0 * t) / 360.0, a = from + turns * t;
            const Vec3 out = cosine_of_turns(a) * tie.u + sine_of_turns(a) * tie.v;
            const Vec3 p = tie.center + (options.radius + rho * cosine_of_turns(b)) * out +
                           (options.lift + rho * sine_of_turns(b)) * tie.along;
            points.push_back(start + smooth_step(0.0, 0.12, t) * (p - start));
        }
    };
    const Index all = strands.size();
    carry_on(strands, ends_of(crossings), tail, context);
    return {count_of(crossings), all - count_of(crossings)};
}

}  // namespace lissom
