#include "kernel/hair/cards/card_light.h"

#include <algorithm>
#include <cmath>

#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

constexpr double kFarHair = 0.08;
constexpr double kMostCells = 4e6;

}  // namespace

HairDensity::HairDensity(const Strands& strands) : box_(bounds(strands)) {
    if (box_.empty()) return;
    const Vec3 size = (box_.max - box_.min).cwiseMax(1e-6);
    cell_ = std::max(cell_, std::cbrt(size.prod() / kMostCells));
    for (int axis = 0; axis < 3; ++axis) {
        counts_[axis] = static_cast<int>(std::min(size[axis] / cell_, 1e3)) + 1;
    }
    density_.assign(at(counts_.prod()), 0.0f);
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        if (!strand.allFinite()) continue;
        for (Index k = 1; k < index_of(strand.cols()); ++k) {
            const Vec3 a = point_of(strand, k - 1), b = point_of(strand, k);
            const Index cell = cell_of(0.5 * (a + b));
            const double width = strands.widths().at(s, strands.first_point(s) + k);
            if (cell == kNoIndex) continue;
            density_[at(cell)] +=
                static_cast<float>((b - a).norm() * width / (cell_ * cell_ * cell_));
        }
    }
}

Index HairDensity::cell_of(const Vec3& point) const {
    const Eigen::Array3d place = (point - box_.min).array() / cell_;
    if (!(place >= 0.0).all() || !(place < counts_.cast<double>()).all()) return kNoIndex;
    const Eigen::Array3i cell = place.cast<int>();
    return (cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0];
}

double HairDensity::openness(const Vec3& point) const {
    if (density_.empty()) return 1.0;
    double sum = 0.0;
    int rays = 0;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                const Vec3 direction(x, y, z);
                if (direction.isZero()) continue;
                double depth = 0.0;
                const Vec3 step = cell_ * direction.normalized();
                Vec3 p = point + step;
                for (double way = cell_; way < kFarHair; way += cell_, p += step) {
                    const Index cell = cell_of(p);
                    if (cell != kNoIndex) depth += cell_ * density_[at(cell)];
                }
                sum += std::exp(-depth);
                ++rays;
            }
        }
    }
    return std::min(1.0, 2.0 * sum / rays);
}

Vec3 away_from_head(const std::function<double(const Vec3&)>& distance, const Vec3& middle,
                    const Vec3& p, double step) {
    Vec3 out = p - middle;
    if (distance) {
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 aside = step * Vec3::Unit(axis);
            out[axis] = distance(p + aside) - distance(p - aside);
        }
    }
    return out.norm() > 0.0 && out.allFinite() ? Vec3(out.normalized()) : Vec3(Vec3::UnitY());
}

}  // namespace lissom
