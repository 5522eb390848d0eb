#include "kernel/hair/operators/strand_frizz.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/lanes.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kFrizzStream = 31;
constexpr double kLongWave = 2.3;

void require_frizz(const FrizzOptions& options) {
    require(options.amplitude >= 0.0 && std::isfinite(options.amplitude) &&
                options.flyaway >= 0.0 && std::isfinite(options.flyaway),
            "'amplitude' and 'flyaway' of frizz must be finite and not negative");
    require(options.wavelength > 0.0 && std::isfinite(options.wavelength),
            "the wavelength of frizz must be positive and finite");
    require(options.flyaways >= 0.0 && options.flyaways <= 1.0,
            "the part of flyaways must be from 0 to 1");
}

// The sine of 2 pi x to 1e-5 for x up to a thousand turns, in 32 bits: four at a time.
LISSOM_INLINE float sine_of_few_turns(float x) {
    constexpr float kRound = 12582912.0f;
    x -= (x + kRound) - kRound;
    const float folded = (x < 0.0f ? -0.5f : 0.5f) - x;
    x = x * x > 0.0625f ? folded : x;
    constexpr auto kTurn = static_cast<float>(2.0 * kPi);
    const float y = kTurn * x, q = y * y;
    return y * (1.0f + q * (-1.0f / 6 + q * (1.0f / 120 + q * (-1.0f / 5040 + q / 362880))));
}

// Two waves: turns a metre, and phases in turns.
struct TwoWaves {
    float short_frequency, long_frequency, short_phase, long_phase;
};

LISSOM_INLINE void sum_waves(const TwoWaves& w, std::size_t count, const float* arcs, float* sums) {
    for (std::size_t k = 0; k < count; ++k) {
        sums[k] = 0.5f * sine_of_few_turns(arcs[k] * w.short_frequency + w.short_phase) +
                  sine_of_few_turns(arcs[k] * w.long_frequency + w.long_phase);
    }
}

#ifdef LISSOM_HAS_AVX2_PATH
// Without fused instructions, which round otherwise.
__attribute__((target("avx2"))) void sum_waves_avx2(const TwoWaves& waves, std::size_t count,
                                                    const float* arcs, float* sums) {
    sum_waves(waves, count, arcs, sums);
}
__attribute__((target("avx2,avx512f,avx512bw,avx512dq,avx512vl"))) void sum_waves_avx512(
    const TwoWaves& waves, std::size_t count, const float* arcs, float* sums) {
    sum_waves(waves, count, arcs, sums);
}
#endif

// Sums of the waves at each arc, in the widest vectors.
void set_waves(const TwoWaves& waves, const std::vector<float>& arcs, std::vector<float>& sums) {
    sums.resize(arcs.size());
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx512()) return sum_waves_avx512(waves, arcs.size(), arcs.data(), sums.data());
    if (has_avx2()) return sum_waves_avx2(waves, arcs.size(), arcs.data(), sums.data());
#endif
    sum_waves(waves, arcs.size(), arcs.data(), sums.data());
}

// Random numbers of one strand: waves a metre, and phases in turns.
struct Waves {
    double amplitude;
    std::array<float, 2> frequencies;
    std::array<float, 6> phases;

    Waves(const FrizzOptions& options, std::uint32_t id) {
        std::uint64_t bits = mixed(options.seed, id, kFrizzStream);
        const auto random = [&] { return signed_random(bits = mixed(bits)); };
        const auto frequency = [&](double wavelength) {
            return static_cast<float>(1.0 / (wavelength * (1.0 + 0.3 * random())));
        };
        const bool flies = 0.5 + 0.5 * random() < options.flyaways;
        amplitude = options.amplitude * (flies ? options.flyaway : 1.0);
        frequencies[0] = frequency(options.wavelength);
        frequencies[1] = frequency(kLongWave * options.wavelength);
        for (float& phase : phases) phase = static_cast<float>(random());
    }

    // The wave along one axis at each arc.
    void set(std::size_t axis, const std::vector<float>& arcs, std::vector<float>& sums) const {
        set_waves({frequencies[0], frequencies[1], phases[axis], phases[axis + 3]}, arcs, sums);
    }
};

// Frizzes one strand after the other; keeps room for them.
struct Frizzer {
    const FrizzOptions& options;
    std::vector<float> arcs = {};
    std::array<std::vector<float>, 3> moves = {};

    void operator()(StrandWork& work) {
        const Waves waves(options, work.id());
        arcs.assign(work.arcs().begin(), work.arcs().end());
        for (std::size_t axis = 0; axis < 3; ++axis) waves.set(axis, arcs, moves[axis]);
        StrandEdit made = work.points();
        for (Index k = 1; k < work.count(); ++k) {
            const auto size = static_cast<float>(waves.amplitude * work.weight(k));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                made(index_of(axis), k) += size * moves[axis][at(k)];
            }
        }
        if (options.keep_length) work.restore_lengths();
    }
};

}  // namespace

void frizz(Strands& strands, const FrizzOptions& options, const Context& context) {
    require_frizz(options);
    Progress progress(context, "frizz strands");
    change_strand_runs(
        strands, options, [&] { return Frizzer{options}; }, context);
}

}  // namespace lissom
