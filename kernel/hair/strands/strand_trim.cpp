#include "kernel/hair/strands/strand_trim.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kLengthStream = 1, kPlaneStream = 2;

void require_trim(const StrandTrimOptions& options) {
    require(options.length > 0.0, "the length to trim to must be positive");
    require(options.factor >= 0.0 && options.factor <= 1.0,
            "the factor of a trim must be from 0 to 1");
    require(options.variation >= 0.0 && options.variation <= 1.0,
            "the variation of a trim must be from 0 to 1");
    require(options.jitter >= 0.0 && std::isfinite(options.jitter),
            "the jitter of a trim must be finite and not negative");
    require(options.least > 0.0 && std::isfinite(options.least),
            "the least length of a trim must be positive and finite");
    if (!options.plane) return;
    const Vec3& normal = options.plane->normal;
    require(options.plane->point.allFinite() && normal.allFinite() && normal.norm() > 0.0,
            "the plane of a trim needs a finite point and a normal with a length");
}

// The part of a strand before it first passes the plane at a distance of `shift`; 1 if it does not.
double part_before_plane(const StrandView& strand, const std::vector<double>& fractions,
                         const StrandTrimPlane& plane, double shift) {
    const Vec3 normal = plane.normal.normalized();
    double before = 0.0;
    for (Index k = 0; k < strand.cols(); ++k) {
        const double side = (strand.col(k).cast<double>() - plane.point).dot(normal) - shift;
        const std::size_t i = k;
        if (side > 0.0 && k == 0) return 0.0;
        if (side > 0.0) {
            const double u = before / (before - side);
            return fractions[i - 1] + u * (fractions[i] - fractions[i - 1]);
        }
        before = side;
    }
    return 1.0;
}

// The part of a strand that is left, 0 to 1.
double kept_part(const StrandView& strand, std::uint32_t id, const std::vector<double>& fractions,
                 double whole, const StrandTrimOptions& options) {
    if (!(whole > 0.0) || !std::isfinite(whole)) return 1.0;
    double part = std::min(options.factor, options.length / whole);
    const double random = 0.5 + 0.5 * signed_random(mixed(options.seed, id, kLengthStream));
    part *= 1.0 - options.variation * random;
    if (options.plane) {
        const double shift = options.jitter * signed_random(mixed(options.seed, id, kPlaneStream));
        part = std::min(part, part_before_plane(strand, fractions, *options.plane, shift));
    }
    return std::clamp(part, std::min(1.0, options.least / whole), 1.0);
}

}  // namespace

void trim(Strands& strands, const StrandTrimOptions& options, const Context& context) {
    require_trim(options);
    Progress progress(context, "trim strands");
    const auto part = [&](Index s, const std::vector<double>& fractions, double whole) {
        return kept_part(strands.strand(s), strands.id(s), fractions, whole, options);
    };
    strands = shortened(strands, part, context);
}

}  // namespace lissom
