#include "kernel/hair/strands/strand_noise.h"

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
constexpr double kSpread = 1.5;

// How much the deviation may change along a segment, as a fraction of its length: so much turns it
// by 27 degrees. For segments shorter than usual it is less still: sharply turning hair, as at tips
// that run out in a weak field, has short segments.
constexpr double kSteepest = 0.5;

double fade_curve(double x) {
    return x * x * x * (x * (x * 6.0 - 15.0) + 10.0);
}

// The dot product with `d` of one of the twelve gradients from the middle of a cube to its edges.
double gradient(std::uint64_t bits, const Vec3& d) {
    const auto edge = static_cast<unsigned>(bits % 12);
    const double a = (edge & 1u) != 0 ? 1.0 : -1.0, b = (edge & 2u) != 0 ? 1.0 : -1.0;
    if (edge < 4) return a * d.x() + b * d.y();
    return edge < 8 ? a * d.x() + b * d.z() : a * d.y() + b * d.z();
}

std::uint64_t corner_bits(const std::array<std::int64_t, 3>& cell, unsigned corner,
                          std::uint64_t seed) {
    std::uint64_t bits = seed;
    for (unsigned k = 0; k < 3; ++k) {
        bits = mixed(bits ^ static_cast<std::uint64_t>(cell[k] + (corner >> k & 1u)));
    }
    return bits;
}

// A cell far outside the range of integers is as good as any other.
std::int64_t cell_of(double floor) {
    constexpr double kFar = 0x1p52;
    return std::abs(floor) < kFar ? static_cast<std::int64_t>(floor) : 0;
}

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

// Deviations of the points of one strand, across it.
class Deviations {
  public:
    Deviations(const StrandView& strand, const NoiseOptions& options)
        : strand_(strand), options_(options), length_(length(strand)) {
        arc_fractions(strand, t_);
        usual_ = 1.0 / (t_.size() - 1);
        root_ = strand.col(0).cast<double>() / options.across;
        at_root_ = sample(0.0);
    }

    // Adds them and returns the number of segments that turned as far as they may.
    Index add_to(StrandEdit& made) const {
        Index limited_segments = 0;
        Vec3 sum = Vec3::Zero(), deviation = Vec3::Zero();
        for (Index k = 1; k < strand_.cols(); ++k) {
            const std::size_t i = k;
            const Vec3 wanted =
                std::pow(t_[i], options_.shape) * (sample(t_[i] * length_) - at_root_);
            sum = options_.cumulative ? Vec3(sum + (t_[i] - t_[i - 1]) * wanted) : wanted;
            const Vec3 along = direction_at(strand_, k);
            const Vec3 across = sum - along.dot(sum) * along;
            const Vec3 change = options_.amplitude * across - deviation;
            const Vec3 allowed = limited(change, t_[i] - t_[i - 1]);
            if (allowed != change) ++limited_segments;
            deviation += allowed;
            made.col(k) += deviation.cast<float>();
        }
        return limited_segments;
    }

  private:
    // A change of the deviation along a segment of this fraction of the strand.
    Vec3 limited(const Vec3& change, double segment) const {
        const double most = kSteepest * length_ * segment * std::min(1.0, segment / usual_);
        const double size = change.norm();
        return size > most ? Vec3(most / size * change) : change;
    }

    // The diagonal has no direction in common with the lattice, whose planes would show.
    Vec3 sample(double arc) const {
        const double shift = arc / options_.along;
        return smooth_noise(root_ + shift * Vec3(0.577, 0.789, -0.211), options_.seed);
    }

    const StrandView& strand_;
    const NoiseOptions& options_;
    double length_;
    std::vector<double> t_;
    // Fraction of the length that a segment has on average.
    double usual_ = 1.0;
    Vec3 root_, at_root_;
};

}  // namespace

Vec3 smooth_noise(const Vec3& place, std::uint64_t seed) {
    std::array<std::int64_t, 3> cell{};
    Vec3 inside, fade;
    for (int k = 0; k < 3; ++k) {
        const double floor = std::floor(place[k]);
        cell[k] = cell_of(floor);
        inside[k] = place[k] - floor;
        fade[k] = fade_curve(inside[k]);
    }
    Vec3 sum = Vec3::Zero();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 offset(corner & 1u, corner >> 1 & 1u, corner >> 2 & 1u);
        double weight = 1.0;
        for (int k = 0; k < 3; ++k) weight *= offset[k] > 0.0 ? fade[k] : 1.0 - fade[k];
        const std::uint64_t bits = corner_bits(cell, corner, seed);
        const Vec3 d = inside - offset;
        sum += weight * Vec3(gradient(bits & 0xffff, d), gradient(bits >> 16 & 0xffff, d),
                             gradient(bits >> 32 & 0xffff, d));
    }
    return kSpread * sum;
}

void noise(Strands& strands, const NoiseOptions& options, const Context& context) {
    require_noise(options);
    Progress progress(context, "noise of strands");
    std::atomic<std::int64_t> limited{0}, segments{0};
    const auto move = [&](Index, const StrandView& old, StrandEdit& made) {
        limited += Deviations(old, options).add_to(made);
        segments += old.cols() - 1;
        if (options.keep_length) restore_lengths(old, made);
    };
    StrandOperatorOptions effect = options.effect;
    effect.keep_length = options.keep_length;
    move_points(strands, effect, move, context);
    if (2 * limited > segments) {
        context.log(
            LogLevel::warning,
            "most segments turn as far as noise lets them, so a larger amplitude changes "
            "little; give longer 'along' and 'across', or apply noise again with another seed");
    }
}

}  // namespace lissom
