#include "kernel/hair/transfer/head_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

constexpr Index kFitColumns = 72, kFitRows = 37;
constexpr double kFitStep = kPi / 36.0;
// Lower directions pass through necks and shoulders, of which heads have more or less.
constexpr double kLowestFit = -kPi / 4.0;
constexpr int kFitPasses = 4;

std::size_t fit_cell(Index row, Index column) {
    return at(row * kFitColumns + (column + kFitColumns) % kFitColumns);
}

ScalpDirection fit_direction(Index row, Index column) {
    return {column * kFitStep - kPi, row * kFitStep - 0.5 * kPi};
}

// Distance of the skin from the center in metres of the frame; NaN if there is none.
double fit_distance(const Scalp& scalp, const ScalpDirection& direction) {
    const std::optional<SurfacePoint> skin = scalp.surface_in(direction);
    const double distance = skin ? scalp.to_metres(skin->position).norm() : 0.0;
    return distance > 0.0 ? distance : std::numeric_limits<double>::quiet_NaN();
}

// Calls visit(place) for the eight neighbours of a cell.
template <typename Visit>
void visit_neighbours(Index row, Index column, const Visit& visit) {
    for (Index i = -1; i <= 1; ++i) {
        for (Index j = -1; j <= 1; ++j) {
            const Index r = row + i;
            if ((i == 0 && j == 0) || r < 0 || r >= kFitRows) continue;
            visit(fit_cell(r, column + j));
        }
    }
}

// Mean of the known neighbours of a cell; NaN if there is none.
double mean_around(const std::vector<double>& values, Index row, Index column) {
    double sum = 0.0;
    int count = 0;
    visit_neighbours(row, column, [&](std::size_t place) {
        if (std::isnan(values[place])) return;
        sum += values[place];
        ++count;
    });
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

HeadFit::HeadFit(const Scalp& from, const Scalp& to, const Context& context)
    : from_(from),
      to_(to),
      log_ratios_(at(kFitRows) * at(kFitColumns), std::numeric_limits<double>::quiet_NaN()) {
    measure(context);
    fill();
    smooth();
}

void HeadFit::measure(const Context& context) {
    context.parallel_for(0, kFitRows, 1, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            for (Index column = 0; column < kFitColumns; ++column) {
                const ScalpDirection direction = fit_direction(row, column);
                if (direction.elevation < kLowestFit) continue;
                log_ratios_[fit_cell(row, column)] =
                    std::log(fit_distance(to_, direction) / fit_distance(from_, direction));
            }
        }
    });
}

// Unknown cells take the mean of those around them, from the known ones outwards.
void HeadFit::fill() {
    for (Index pass = 0; pass < kFitRows + kFitColumns; ++pass) {
        std::vector<double> next = log_ratios_;
        for (Index row = 0; row < kFitRows; ++row) {
            for (Index column = 0; column < kFitColumns; ++column) {
                if (!std::isnan(log_ratios_[fit_cell(row, column)])) continue;
                next[fit_cell(row, column)] = mean_around(log_ratios_, row, column);
            }
        }
        log_ratios_ = std::move(next);
    }
    for (double& value : log_ratios_) value = std::isfinite(value) ? value : 0.0;
}

void HeadFit::smooth() {
    for (int pass = 0; pass < kFitPasses; ++pass) {
        std::vector<double> next = log_ratios_;
        for (Index row = 0; row < kFitRows; ++row) {
            for (Index column = 0; column < kFitColumns; ++column) {
                next[fit_cell(row, column)] = 0.5 * log_ratios_[fit_cell(row, column)] +
                                              0.5 * mean_around(log_ratios_, row, column);
            }
        }
        log_ratios_ = std::move(next);
    }
    // All columns of the first and last rows are one direction.
    for (const Index row : {Index{0}, kFitRows - 1}) {
        double mean = 0.0;
        for (Index column = 0; column < kFitColumns; ++column) {
            mean += log_ratios_[fit_cell(row, column)] / kFitColumns;
        }
        for (Index column = 0; column < kFitColumns; ++column) {
            log_ratios_[fit_cell(row, column)] = mean;
        }
    }
}

double HeadFit::ratio(const ScalpDirection& direction) const {
    const double x = (direction.azimuth + kPi) / kFitStep,
                 y = std::clamp((direction.elevation + 0.5 * kPi) / kFitStep, 0.0,
                                double(kFitRows - 1));
    // A point too far away has no direction.
    if (!std::isfinite(x) || !std::isfinite(y)) return 1.0;
    const auto column = static_cast<Index>(std::floor(x));
    const Index row = std::min(static_cast<Index>(y), kFitRows - 2);
    const double u = x - column, v = y - row;
    const auto value = [&](Index i, Index j) { return log_ratios_[fit_cell(row + i, column + j)]; };
    return std::exp((1.0 - v) * ((1.0 - u) * value(0, 0) + u * value(0, 1)) +
                    v * ((1.0 - u) * value(1, 0) + u * value(1, 1)));
}

Vec3 HeadFit::operator()(const Vec3& point) const {
    const Vec3 local = from_.to_metres(point);
    if (local.isZero(0.0)) return to_.from_metres(local);
    return to_.from_metres(ratio(from_.direction_of(point)) * local);
}

}  // namespace lissom
