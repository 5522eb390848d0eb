/// Cubic B-splines fitted to points of the plane; private to kernel/sketch.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

/// A uniform cubic B-spline over parameters 0 to 1.
class PlaneSpline {
  public:
    explicit PlaneSpline(std::vector<Vec2> controls) : controls_(std::move(controls)) {}
    Vec2 at(double parameter) const;

  private:
    std::vector<Vec2> controls_;
};

/// Samples of a curve at ascending parameters from 0 to 1.
struct CurveSamples {
    std::span<const Vec2> points;
    std::span<const double> parameters;
};

/// Returns the spline of `intervals` polynomials nearest to the samples in the sense of least
/// squares. The first and last sample count as `end_weight` others; `smoothness` weighs the squared
/// second differences of the controls, so that spans without a sample are determined.
PlaneSpline fit_spline(const CurveSamples& samples, Index intervals, double end_weight = 50.0,
                       double smoothness = 1e-3);

/// Root of the mean squared distance between the samples and the spline at their parameters.
double fit_error(const PlaneSpline& spline, const CurveSamples& samples);

}  // namespace lissom
