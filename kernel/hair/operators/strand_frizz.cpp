#include "kernel/hair/operators/strand_frizz.h"

#include <array>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
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

// Random numbers of one strand: waves a metre, and phases in turns.
struct Waves {
    double amplitude;
    std::array<double, 2> frequencies;
    std::array<double, 6> phases;

    Waves(const FrizzOptions& options, std::uint32_t id) {
        std::uint64_t bits = mixed(options.seed, id, kFrizzStream);
        const auto random = [&] { return signed_random(bits = mixed(bits)); };
        const bool flies = 0.5 + 0.5 * random() < options.flyaways;
        amplitude = options.amplitude * (flies ? options.flyaway : 1.0);
        frequencies[0] = 1.0 / (options.wavelength * (1.0 + 0.3 * random()));
        frequencies[1] = 1.0 / (kLongWave * options.wavelength * (1.0 + 0.3 * random()));
        for (double& phase : phases) phase = random();
    }

    // Adds the wave along one axis at each arc.
    void add(std::size_t axis, const std::vector<double>& arcs, std::vector<double>& sums) const {
        const double short_phase = phases[axis], long_phase = phases[axis + 3];
        const double short_frequency = frequencies[0], long_frequency = frequencies[1];
        const double* const arc = arcs.data();
        double* const sum = sums.data();
        for (std::size_t k = 0; k < arcs.size(); ++k) {
            sum[k] = 0.5 * sine_of_turns(arc[k] * short_frequency + short_phase) +
                     sine_of_turns(arc[k] * long_frequency + long_phase);
        }
    }
};

}  // namespace

void frizz(Strands& strands, const FrizzOptions& options, const Context& context) {
    require_frizz(options);
    Progress progress(context, "frizz strands");
    const auto change = [&](StrandWork& work) {
        const Waves waves(options, work.id());
        std::array<std::vector<double>, 3> moves;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            moves[axis].resize(at(work.count()));
            waves.add(axis, work.arcs(), moves[axis]);
        }
        for (Index k = 1; k < work.count(); ++k) {
            const double size = waves.amplitude * work.weight(k);
            const Vec3 move(moves[0][at(k)], moves[1][at(k)], moves[2][at(k)]);
            work.set_point(k, work.old_point(k) + size * move);
        }
        if (options.keep_length) work.restore_lengths();
    };
    change_strands(strands, options, change, context);
}

}  // namespace lissom
