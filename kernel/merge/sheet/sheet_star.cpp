#include "kernel/merge/sheet/sheet_star.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Angles that differ by less are equal, so that rounding does not decide.
constexpr double kSameStar = 1e-7;

// The greatest angles at edges across seams, and at others.
struct StarAngles {
    const SheetTriangles& sheet;
    GreatestAngle seam = {}, other = {};

    void add(Index a, Index b, const Vec3& n, const Vec3& m) {
        GreatestAngle& greatest = sheet.is_on_seam(a, b) ? seam : other;
        if (n.isZero(0.0) || m.isZero(0.0)) {
            greatest.add(kPi);
        } else {
            greatest.add(n, m);
        }
    }

    // At an edge whose other side is no facet.
    void add_outer(Index a, Index b, const Vec3& n, std::span<const Index> instead_of) {
        const Index f = sheet.left_of(b, a);
        if (f != kNoIndex &&
            std::find(instead_of.begin(), instead_of.end(), f) == instead_of.end()) {
            add(a, b, n, sheet.normal[f]);
        } else if (sheet.fixed[a] && sheet.fixed[b]) {
            const auto beyond = sheet.beyond.find(edge_key(a, b));
            if (beyond != sheet.beyond.end()) add(a, b, n, beyond->second);
        }
    }
};

}  // namespace

bool is_allowed(const SheetStar& before, const SheetStar& after, const SheetLimits& limits,
                double good_angle) {
    return after.seam <= std::max(before.seam, limits.seam) + kSameStar &&
           after.other <= std::max(before.other, limits.other) + kSameStar &&
           after.angle >= std::min(before.angle, good_angle) - kSameStar;
}

SheetStar StarMeter::of(std::span<const Index> faces) {
    facets_.clear();
    for (const Index f : faces) {
        facets_.push_back({sheet_.triangles[f], sheet_.normal[f], sheet_.min_angle_of(f)});
    }
    return measured(faces);
}

SheetStar StarMeter::with(std::span<const Triangle> triangles, std::span<const Index> instead_of,
                          Index moved, const Vec3& to) {
    facets_.clear();
    for (const Triangle& t : triangles) {
        facets_.push_back({t, sheet_.normal_of(t, moved, to), sheet_.min_angle(t, moved, to)});
    }
    return measured(instead_of);
}

SheetStar StarMeter::measured(std::span<const Index> instead_of) const {
    SheetStar star;
    StarAngles angles{sheet_};
    const auto facet_left_of = [&](Index a, Index b) {
        std::size_t i = 0;
        while (i < facets_.size() && !is_along(facets_[i].corners, a, b)) ++i;
        return i;
    };
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        const Facet& facet = facets_[i];
        star.angle = std::min(star.angle, facet.angle);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = facet.corners[k], b = facet.corners[(k + 1) % 3];
            const std::size_t j = facet_left_of(b, a);
            if (j == facets_.size()) {
                angles.add_outer(a, b, facet.normal, instead_of);
            } else if (i < j) {
                angles.add(a, b, facet.normal, facets_[j].normal);
            }
        }
    }
    star.seam = angles.seam.value();
    star.other = angles.other.value();
    return star;
}

}  // namespace lissom
