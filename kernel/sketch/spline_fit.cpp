#include "kernel/sketch/spline_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lissom {
namespace {

// Controls that a polynomial depends on; the normal equations have as many diagonals on one side.
constexpr std::size_t kOrder = 4;

// The polynomial at a parameter and the weights of its four controls.
struct SplineSpan {
    std::size_t first;
    std::array<double, kOrder> weights;
};

SplineSpan span_at(double parameter, std::size_t intervals) {
    const double place = std::clamp(parameter, 0.0, 1.0) * intervals;
    const std::size_t first = std::min(static_cast<std::size_t>(place), intervals - 1);
    const double t = place - first, u = 1.0 - t;
    return {first,
            {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
             (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0, t * t * t / 6.0}};
}

// A symmetric positive definite system with three diagonals on each side, for two right-hand sides.
class NarrowSystem {
  public:
    explicit NarrowSystem(std::size_t size) : rows_(size), right_(size, Vec2::Zero()) {}

    // Adds weight (sum_k c_k x_(first + k) - value)^2.
    template <std::size_t N>
    void add(std::size_t first, const std::array<double, N>& c, const Vec2& value, double weight) {
        for (std::size_t i = 0; i < N; ++i) {
            right_[first + i] += weight * c[i] * value;
            for (std::size_t j = 0; j <= i; ++j) rows_[first + i][i - j] += weight * c[i] * c[j];
        }
    }

    // By the factorisation L D L^T, whose L has the same diagonals.
    std::vector<Vec2> solve() {
        for (std::size_t i = 0; i < rows_.size(); ++i) eliminate(i);
        for (std::size_t i = 0; i < rows_.size(); ++i) right_[i] /= rows_[i][0];
        for (std::size_t i = rows_.size(); i-- > 0;) {
            for (std::size_t k = 1; k < std::min(kOrder, i + 1); ++k) {
                right_[i - k] -= rows_[i][k] * right_[i];
            }
        }
        return right_;
    }

  private:
    // Row i holds L(i, i - k) D(i - k) while it is eliminated, and L(i, i - k) from then on.
    void eliminate(std::size_t i) {
        const std::size_t reach = std::min(kOrder - 1, i);
        for (std::size_t k = reach; k >= 1; --k) {
            for (std::size_t m = k + 1; m <= reach; ++m) {
                rows_[i][k] -= rows_[i][m] * rows_[i - k][m - k];
            }
        }
        for (std::size_t k = reach; k >= 1; --k) {
            const double product = rows_[i][k];
            rows_[i][k] /= rows_[i - k][0];
            rows_[i][0] -= product * rows_[i][k];
            right_[i] -= rows_[i][k] * right_[i - k];
        }
    }

    // Diagonal of each row, and the entries 1, 2 and 3 places before it.
    std::vector<std::array<double, kOrder>> rows_;
    std::vector<Vec2> right_;
};

}  // namespace

Vec2 PlaneSpline::at(double parameter) const {
    const SplineSpan span = span_at(parameter, controls_.size() - kOrder + 1);
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = 0; k < kOrder; ++k) sum += span.weights[k] * controls_[span.first + k];
    return sum;
}

PlaneSpline fit_spline(const CurveSamples& samples, Index intervals, double end_weight,
                       double smoothness) {
    const std::size_t count = intervals;
    NarrowSystem system(count + kOrder - 1);
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == samples.points.size();
        const SplineSpan span = span_at(samples.parameters[i], count);
        system.add(span.first, span.weights, samples.points[i], is_end ? end_weight : 1.0);
    }
    constexpr std::array<double, 3> kSecondDifference = {1.0, -2.0, 1.0};
    for (std::size_t i = 0; i + 2 < count + kOrder - 1; ++i) {
        system.add(i, kSecondDifference, Vec2::Zero(), smoothness * samples.points.size());
    }
    return PlaneSpline(system.solve());
}

double fit_error(const PlaneSpline& spline, const CurveSamples& samples) {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        sum += (spline.at(samples.parameters[i]) - samples.points[i]).squaredNorm();
    }
    return std::sqrt(sum / samples.points.size());
}

}  // namespace lissom
