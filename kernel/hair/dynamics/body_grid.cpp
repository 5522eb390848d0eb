#include "kernel/hair/dynamics/body_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

constexpr Index kBodyPoints = 500'000;
// Grid points from one that is asked first to the next.
constexpr Index kCoarse = 4;
// Points nearer to the body than this many steps, by those around them, are asked too.
constexpr double kNearSteps = 3.5;

}  // namespace

BodyGrid::BodyGrid(const BodyDistance& distance, const Box& box, const Context& context)
    : layout_(fit_grid(box, kBodyPoints)) {
    for (std::size_t c = 0; c < 3; ++c) {
        coarse_counts_[c] = (layout_.counts[c] + kCoarse - 2) / kCoarse + 1;
    }
    charge_ = context.charge(at(layout_.size()) * sizeof(float), "the distances to a body");
    ask_coarse(distance, context);
    ask_near(distance, context);
    coarse_ = {};
}

Index BodyGrid::coarse_number(Index i, Index j, Index k) const {
    return i + coarse_counts_[0] * (j + coarse_counts_[1] * k);
}

// The last coarse points may lie beyond the grid.
void BodyGrid::ask_coarse(const BodyDistance& distance, const Context& context) {
    coarse_.resize(at(coarse_counts_[0] * coarse_counts_[1] * coarse_counts_[2]));
    context.parallel_for(0, coarse_counts_[2], 1, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            for (Index j = 0; j < coarse_counts_[1]; ++j) {
                for (Index i = 0; i < coarse_counts_[0]; ++i) {
                    const Vec3 place = layout_.point(kCoarse * i, kCoarse * j, kCoarse * k);
                    coarse_[at(coarse_number(i, j, k))] = static_cast<float>(distance(place));
                }
            }
        }
    });
}

double BodyGrid::between_coarse(Index i, Index j, Index k) const {
    const std::array<Index, 3> cell{i / kCoarse, j / kCoarse, k / kCoarse};
    const std::array<double, 3> t{static_cast<double>(i % kCoarse) / kCoarse,
                                  static_cast<double>(j % kCoarse) / kCoarse,
                                  static_cast<double>(k % kCoarse) / kCoarse};
    double value = 0.0;
    for (Index corner = 0; corner < 8; ++corner) {
        const std::array<Index, 3> up{corner & 1, (corner >> 1) & 1, corner >> 2};
        double weight = 1.0;
        for (std::size_t c = 0; c < 3; ++c) weight *= up[c] != 0 ? t[c] : 1.0 - t[c];
        if (weight == 0.0) continue;
        value +=
            weight * coarse_[at(coarse_number(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]))];
    }
    return value;
}

void BodyGrid::ask_near(const BodyDistance& distance, const Context& context) {
    values_.resize(at(layout_.size()));
    context.parallel_for(0, layout_.counts[2], 1, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            for (Index j = 0; j < layout_.counts[1]; ++j) {
                for (Index i = 0; i < layout_.counts[0]; ++i) {
                    double value = between_coarse(i, j, k);
                    if (std::abs(value) < kNearSteps * layout_.step) {
                        value = distance(layout_.point(i, j, k));
                    }
                    values_[at(layout_.index(i, j, k))] = static_cast<float>(value);
                }
            }
        }
    });
}

BodyGrid::Sample BodyGrid::sample(const Vec3& place) const {
    Sample found;
    found.distance = std::numeric_limits<double>::infinity();
    if (values_.empty()) return found;
    const Vec3 steps = (place - layout_.origin) / layout_.step;
    std::array<Index, 3> cell{};
    Vec3 t;
    for (Index c = 0; c < 3; ++c) {
        const double last = layout_.counts[at(c)] - 1;
        if (!(steps[c] >= 0.0 && steps[c] <= last)) return found;
        cell[at(c)] = std::min(static_cast<Index>(steps[c]), layout_.counts[at(c)] - 2);
        t[c] = steps[c] - cell[at(c)];
    }
    const float* const corner = values_.data() + layout_.index(cell[0], cell[1], cell[2]);
    const std::size_t up = at(layout_.counts[0]), far = up * at(layout_.counts[1]);
    // Along x on the four edges of the cell, then along y on two, then along z.
    const auto along_x = [&](std::size_t from) {
        return corner[from] + t.x() * (corner[from + 1] - corner[from]);
    };
    const double low = along_x(0), high = along_x(up);
    const double low_far = along_x(far), high_far = along_x(far + up);
    const auto slope_x = [&](std::size_t from) { return corner[from + 1] - corner[from]; };
    const double near_value = low + t.y() * (high - low);
    const double far_value = low_far + t.y() * (high_far - low_far);
    const double slope = (1.0 - t.z()) * ((1.0 - t.y()) * slope_x(0) + t.y() * slope_x(up)) +
                         t.z() * ((1.0 - t.y()) * slope_x(far) + t.y() * slope_x(far + up));
    found.distance = near_value + t.z() * (far_value - near_value);
    found.gradient = Vec3(slope, (1.0 - t.z()) * (high - low) + t.z() * (high_far - low_far),
                          far_value - near_value) /
                     layout_.step;
    return found;
}

}  // namespace lissom
