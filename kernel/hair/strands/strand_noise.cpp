#include "kernel/hair/strands/strand_noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_operators.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

// Noise of gradients rarely leaves two thirds of its bound of 1; this spreads it over [-1, 1].
constexpr float kSpread = 1.5f;

// How much the deviation may change along a segment, as a fraction of its length: so much turns it
// by 27 degrees. For segments shorter than usual it is less still: sharply turning hair, as at tips
// that run out in a weak field, has short segments.
constexpr double kSteepest = 0.5;

float fade_curve(float x) {
    return x * x * x * (x * (x * 6.0f - 15.0f) + 10.0f);
}

using Gradient = std::array<float, 3>;

// The twelve gradients from the middle of a cube to its edges, spread.
constexpr std::array<Gradient, 12> spread_gradients() {
    std::array<Gradient, 12> list{};
    for (unsigned edge = 0; edge < 12; ++edge) {
        list[edge][edge < 8 ? 0 : 1] = (edge & 1u) != 0 ? kSpread : -kSpread;
        list[edge][edge < 4 ? 1 : 2] = (edge & 2u) != 0 ? kSpread : -kSpread;
    }
    return list;
}
constexpr std::array<Gradient, 12> kGradients = spread_gradients();

const Gradient& gradient(std::uint64_t bits) {
    return kGradients[static_cast<unsigned>(bits & 0xffff) % 12u];
}

// A cell far outside the range of integers is as good as any other.
std::int64_t cell_of(double floor) {
    constexpr double kFar = 0x1p52;
    return std::abs(floor) < kFar ? static_cast<std::int64_t>(floor) : 0;
}

// Without a call, as not every processor rounds by an instruction.
double floor_of(double x) {
    if (!(std::abs(x) < 0x1p52)) return std::floor(x);
    const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
    return whole > x ? whole - 1.0 : whole;
}

// Noise at places one after the other: keeps the gradients of the cell of the last.
class NoiseSampler {
  public:
    explicit NoiseSampler(std::uint64_t seed) : seed_(seed) {}

    Vec3 at(const Vec3& place) {
        std::array<std::int64_t, 3> cell{};
        std::array<float, 3> inside{}, fade{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double floor = floor_of(place[index_of(k)]);
            cell[k] = cell_of(floor);
            inside[k] = static_cast<float>(place[index_of(k)] - floor);
            fade[k] = fade_curve(inside[k]);
        }
        if (cell != cell_ || !is_set_) take(cell);
        return sum(inside, fade);
    }

  private:
    using Lanes = Eigen::Array4f;

    void take(const std::array<std::int64_t, 3>& cell) {
        cell_ = cell;
        is_set_ = true;
        for (unsigned x = 0; x < 2; ++x) {
            const std::uint64_t plane = side_bits(seed_, cell[0], x);
            for (unsigned y = 0; y < 2; ++y) {
                const std::uint64_t edge = side_bits(plane, cell[1], y);
                for (unsigned z = 0; z < 2; ++z) {
                    set_corner(x + 2 * y + 4 * z, side_bits(edge, cell[2], z));
                }
            }
        }
    }

    static std::uint64_t side_bits(std::uint64_t bits, std::int64_t cell, unsigned side) {
        return mixed(bits ^ static_cast<std::uint64_t>(cell + side));
    }

    void set_corner(unsigned corner, std::uint64_t bits) {
        const Gradient &a = gradient(bits), &b = gradient(bits >> 16), &c = gradient(bits >> 32);
        Lanes* const slope = &slopes_[3 * std::size_t{corner}];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            slope[axis] = Lanes(a[axis], b[axis], c[axis], 0.0f);
        }
    }

    Lanes corner(unsigned c, const std::array<float, 3>& inside) const {
        const Lanes* const slope = &slopes_[3 * std::size_t{c}];
        const auto x = inside[0] - float(c & 1u), y = inside[1] - float(c >> 1 & 1u),
                   z = inside[2] - float(c >> 2 & 1u);
        return x * slope[0] + y * slope[1] + z * slope[2];
    }

    // Along x first, then y, then z.
    Vec3 sum(const std::array<float, 3>& inside, const std::array<float, 3>& fade) const {
        std::array<Lanes, 4> edges;
        for (unsigned e = 0; e < 4; ++e) {
            const Lanes a = corner(2 * e, inside);
            edges[e] = a + fade[0] * (corner(2 * e + 1, inside) - a);
        }
        const Lanes low = edges[0] + fade[1] * (edges[1] - edges[0]);
        const Lanes high = edges[2] + fade[1] * (edges[3] - edges[2]);
        const Lanes all = low + fade[2] * (high - low);
        return {all[0], all[1], all[2]};
    }

    std::uint64_t seed_;
    std::array<std::int64_t, 3> cell_{};
    bool is_set_ = false;
    // By corner and axis: the slopes of the three components.
    std::array<Lanes, 24> slopes_;
};

void require_noise(const NoiseOptions& options) {
    require(options.amplitude >= 0.0 && std::isfinite(options.amplitude),
            "the amplitude of noise must be finite and not negative");
    require(options.across > 0.0 && std::isfinite(options.across) && options.along > 0.0 &&
                std::isfinite(options.along),
            "the lengths 'across' and 'along' of noise must be positive and finite");
    require(options.shape > 0.0 && std::isfinite(options.shape),
            "the shape of noise must be positive");
}

// The direction of a strand at one of its points; zero if its neighbours coincide.
Vec3 direction_at(const StrandView& strand, Index k) {
    const Index next = std::min(k + 1, index_of(strand.cols()) - 1);
    const Vec3 along = (strand.col(next) - strand.col(k - 1)).cast<double>();
    const double size = along.norm();
    return size > 0.0 ? Vec3(along / size) : Vec3::Zero();
}

// Moves one strand after the other by deviations across it; keeps room for them.
class Deviations {
  public:
    explicit Deviations(const NoiseOptions& options) : options_(options), noise_(options.seed) {}

    // Returns the number of segments that turned as far as they may.
    Index add_to(StrandWork& work) {
        const StrandView strand = work.old_points();
        root_ = point_of(strand, 0) / options_.across;
        at_root_ = noise_.at(root_);
        usual_ = 1.0 / (work.count() - 1);
        const double metres = work.length();
        Index limited_segments = 0;
        Vec3 sum = Vec3::Zero(), deviation = Vec3::Zero();
        double before = 0.0;
        for (Index k = 1; k < work.count(); ++k) {
            const double t = work.t(k), segment = t - before;
            before = t;
            const double size = options_.shape == 1.0 ? t : std::pow(t, options_.shape);
            const Vec3 wanted = size * (sample(t * metres) - at_root_);
            sum = options_.cumulative ? Vec3(sum + segment * wanted) : wanted;
            const Vec3 along = direction_at(strand, k);
            const Vec3 across = sum - along.dot(sum) * along;
            const Vec3 change = options_.amplitude * across - deviation;
            const double most = kSteepest * metres * segment * std::min(1.0, segment / usual_);
            const double far = change.squaredNorm();
            const bool is_limited = far > most * most;
            if (is_limited) ++limited_segments;
            deviation += is_limited ? Vec3(most / std::sqrt(far) * change) : change;
            work.set_point(k, work.old_point(k) + deviation);
        }
        return limited_segments;
    }

  private:
    // The diagonal has no direction in common with the lattice, whose planes would show.
    Vec3 sample(double arc) {
        const double shift = arc / options_.along;
        return noise_.at(root_ + shift * Vec3(0.577, 0.789, -0.211));
    }

    const NoiseOptions& options_;
    NoiseSampler noise_;
    // Fraction of the length that a segment has on average.
    double usual_ = 1.0;
    Vec3 root_, at_root_;
};

}  // namespace

Vec3 smooth_noise(const Vec3& place, std::uint64_t seed) {
    return NoiseSampler(seed).at(place);
}

void noise(Strands& strands, const NoiseOptions& options, const Context& context) {
    require_noise(options);
    Progress progress(context, "noise of strands");
    std::atomic<std::int64_t> limited{0}, segments{0};
    StrandOperatorOptions effect = options.effect;
    effect.keep_length = options.keep_length;
    const auto make = [&] {
        return [&, deviations = Deviations(options)](StrandWork& work) mutable {
            limited += deviations.add_to(work);
            segments += work.count() - 1;
            work.blend();
        };
    };
    change_strand_runs(strands, effect, make, context);
    if (2 * limited > segments) {
        context.log(
            LogLevel::warning,
            "most segments turn as far as noise lets them, so a larger amplitude changes "
            "little; give longer 'along' and 'across', or apply noise again with another seed");
    }
}

}  // namespace lissom
