#include "kernel/hair/operators/strand_cut.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/roots.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kCutStream = 51, kGuideCutStream = 52, kCullStream = 53;

void require_cut(const Strands& strands, const StrandCutOptions& options) {
    require_operator(strands, options);
    require(static_cast<bool>(options.inside), "a cut needs a shape");
    require(options.frame.is_finite(), "the frame of a cut must be finite");
    require(options.jitter >= 0.0 && std::isfinite(options.jitter) && options.guide_jitter >= 0.0 &&
                std::isfinite(options.guide_jitter),
            "the jitter of a cut must be finite and not negative");
    require(options.least > 0.0 && std::isfinite(options.least),
            "the least length of a cut must be positive and finite");
}

double shift_of(const Strands& strands, Index s, const StrandCutOptions& options) {
    std::uint32_t guide = strands.id(s);
    const std::vector<std::uint32_t>& guides = strands.guides().ids;
    if (!guides.empty() && guides[at(s)] != kNoGuide) guide = guides[at(s)];
    return options.jitter * signed_random(mixed(options.seed, strands.id(s), kCutStream)) +
           options.guide_jitter * signed_random(mixed(options.seed, guide, kGuideCutStream));
}

// The part of a strand before it first leaves the shape; 1 if it does not.
double part_inside(const Strands& strands, Index s, const StrandCutOptions& options,
                   const std::vector<double>& fractions) {
    const StrandView strand = strands.strand(s);
    const double shift = shift_of(strands, s, options);
    double before = 0.0;
    for (Index k = 0; k < strand.cols(); ++k) {
        const Vec3 place = options.frame(point_of(strand, k));
        const double inside = options.inside(place, strands.first_point(s) + k) + shift;
        if (inside < 0.0 && k == 0) return 0.0;
        if (inside < 0.0) {
            const double u = before / (before - inside);
            return fractions[at(k - 1)] + u * (fractions[at(k)] - fractions[at(k - 1)]);
        }
        before = inside;
    }
    return 1.0;
}

// The part of a strand that stays.
double part_left(const Strands& strands, Index s, const StrandCutOptions& options,
                 const std::vector<double>& fractions, double whole) {
    if (!(whole > 0.0) || !std::isfinite(whole)) return 1.0;
    const double mask = options.factor * (options.mask.empty() ? 1.0 : options.mask[at(s)]);
    if (mask == 0.0) return 1.0;
    const double part = 1.0 - mask * (1.0 - part_inside(strands, s, options, fractions));
    return std::clamp(part, std::min(1.0, options.least / whole), 1.0);
}

}  // namespace

CutShape inside_plane(const Vec3& point, const Vec3& normal) {
    require(point.allFinite() && normal.allFinite() && normal.norm() > 0.0,
            "the plane of a cut needs a finite point and a normal with a length");
    const Vec3 unit = normal.normalized();
    return [point, unit](const Vec3& place, Index) { return (point - place).dot(unit); };
}

CutShape inside_ellipsoid(const Vec3& center, const Vec3& radii) {
    require(center.allFinite() && radii.allFinite() && radii.minCoeff() > 0.0,
            "an ellipsoid needs a finite center and positive radii");
    return [center, radii](const Vec3& place, Index) {
        const double r = (place - center).cwiseQuotient(radii).norm();
        return (1.0 - r) * radii.mean();
    };
}

CutShape above_hem(std::vector<HemPlace> places) {
    require(!places.empty(), "a hem needs at least one place");
    bool both = true;
    for (const HemPlace& place : places) {
        require(std::isfinite(place.azimuth) && std::isfinite(place.height),
                "the places of a hem must be finite");
        both = both && place.azimuth >= 0.0;
    }
    std::sort(places.begin(), places.end(),
              [](const HemPlace& a, const HemPlace& b) { return a.azimuth < b.azimuth; });
    return [places = std::move(places), both](const Vec3& p, Index) {
        double azimuth = std::atan2(p.x(), p.z());
        if (both) azimuth = std::abs(azimuth);
        const auto above = std::find_if(places.begin(), places.end(), [&](const HemPlace& place) {
            return place.azimuth > azimuth;
        });
        if (above == places.begin()) return p.y() - places.front().height;
        const HemPlace& a = *(above - 1);
        if (above == places.end()) return p.y() - a.height;
        const double u = (azimuth - a.azimuth) / (above->azimuth - a.azimuth);
        return p.y() - (a.height + u * (above->height - a.height));
    };
}

void cut(Strands& strands, const StrandCutOptions& options, const Context& context) {
    require_cut(strands, options);
    if (options.factor == 0.0) return;
    Progress progress(context, "cut strands");
    const auto part = [&](Index s, const std::vector<double>& fractions, double whole) {
        return part_left(strands, s, options, fractions, whole);
    };
    strands = shortened(strands, part, context);
}

void cull(Strands& strands, std::span<const char> marks, bool locks) {
    require(marks.size() == at(strands.size()), "culling needs one mark for each strand");
    const std::vector<std::uint32_t>& guides = strands.guides().ids;
    std::unordered_set<std::uint32_t> culled;
    if (locks && !guides.empty()) {
        for (Index s = 0; s < strands.size(); ++s) {
            if (marks[at(s)] && guides[at(s)] != kNoGuide) culled.insert(guides[at(s)]);
        }
    }
    strands = select(strands, [&](Index s) {
        return !marks[at(s)] && (culled.empty() || !culled.contains(guides[at(s)]));
    });
}

std::vector<char> random_marks(const Strands& strands, double part, std::uint64_t seed) {
    require(part >= 0.0 && part <= 1.0, "the part of strands must be from 0 to 1");
    std::vector<char> marks;
    for (Index s = 0; s < strands.size(); ++s) {
        const double random = 0.5 + 0.5 * signed_random(mixed(seed, strands.id(s), kCullStream));
        marks.push_back(random < part ? 1 : 0);
    }
    return marks;
}

}  // namespace lissom
