#include "kernel/hair/operators/strand_frizz.h"

#include <array>
#include <cmath>

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

    Vec3 at_arc(double arc) const {
        std::array<double, 6> sines;
        for (std::size_t i = 0; i < 3; ++i) {
            sines[i] = 0.5 * sine_of_turns(arc * frequencies[0] + phases[i]);
        }
        for (std::size_t i = 3; i < 6; ++i) {
            sines[i] = sine_of_turns(arc * frequencies[1] + phases[i]);
        }
        return {sines[0] + sines[3], sines[1] + sines[4], sines[2] + sines[5]};
    }
};

}  // namespace

void frizz(Strands& strands, const FrizzOptions& options, const Context& context) {
    require_frizz(options);
    Progress progress(context, "frizz strands");
    const auto change = [&](StrandWork& work) {
        const Waves waves(options, work.id());
        for (Index k = 1; k < work.count(); ++k) {
            const double size = waves.amplitude * work.weight(k);
            work.set_point(k, work.old_point(k) + size * waves.at_arc(work.arc(k)));
        }
        if (options.keep_length) work.restore_lengths();
    };
    change_strands(strands, options, change, context);
}

}  // namespace lissom
