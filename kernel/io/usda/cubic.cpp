#include <algorithm>
#include <array>
#include <utility>

#include "kernel/io/usda/prim.h"

namespace lissom {
namespace {

// Points on each segment of a cubic curve, beside the last of the curve.
constexpr Index kSamples = 4;

using Weights = std::array<double, 4>;

Weights bezier(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

Weights bspline(double t) {
    const double s = 1.0 - t;
    return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

Weights catmull_rom(double t) {
    const double t2 = t * t, t3 = t2 * t;
    return {0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
            0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)};
}

[[noreturn]] void refuse_cubic(const CurvesPrim& prim, const std::string& what, ErrorCode code) {
    refuse(code, "BasisCurves " + in_quotes(prim.name) + ": " + what, prim.place);
}

// Basis of a prim: the position of segments on the control points.
class CubicBasis {
  public:
    explicit CubicBasis(const CurvesPrim& prim) : prim_(prim), pinned_(prim.wrap == "pinned") {
        if (prim.basis == "bezier") {
            weights_ = bezier;
            step_ = 3;
            pinned_ = false;
        } else if (prim.basis == "bspline") {
            weights_ = bspline;
        } else if (prim.basis == "catmullRom") {
            weights_ = catmull_rom;
        } else {
            refuse_cubic(prim, "its basis " + in_quotes(prim.basis) + " is not known",
                         ErrorCode::unsupported);
        }
    }

    Index segments(Index controls) const {
        if (pinned_ && controls >= 2) return controls - 1;
        if (!pinned_ && controls >= 4 && (controls - 4) % step_ == 0) {
            return (controls - 4) / step_ + 1;
        }
        refuse_cubic(prim_, "a cubic curve cannot have " + std::to_string(controls) + " points",
                     ErrorCode::file_syntax);
    }

    // A value at `t` of a segment, of `controls` values of `width` numbers each.
    double value(const float* values, Index controls, std::size_t width, std::size_t component,
                 Index segment, double t) const {
        const Weights w = weights_(t);
        const Index first = segment * step_ - (pinned_ ? 1 : 0);
        double sum = 0.0;
        for (Index i = 0; i < 4; ++i) {
            sum += w[i] * control(values, controls, width, component, first + i);
        }
        return sum;
    }

  private:
    // Pinned curves go through their ends: a point beyond them lies opposite the next one.
    static double control(const float* values, Index controls, std::size_t width,
                          std::size_t component, Index i) {
        const auto at = [&](Index k) -> double { return values[k * width + component]; };
        if (i < 0) return 2.0 * at(0) - at(1);
        return i < controls ? at(i) : 2.0 * at(controls - 1) - at(controls - 2);
    }

    const CurvesPrim& prim_;
    bool pinned_;
    Index step_ = 1;
    Weights (*weights_)(double) = nullptr;
};

// Values at the control points become values at the points on the curves.
std::vector<float> sampled(const std::vector<float>& values, std::size_t width,
                           const std::vector<Index>& counts, const CubicBasis& basis) {
    std::vector<float> result;
    const float* curve = values.data();
    for (const Index controls : counts) {
        const Index samples = kSamples * basis.segments(controls);
        for (Index k = 0; k <= samples; ++k) {
            const Index segment = std::min(k, samples - 1) / kSamples;
            const double t = double(k - segment * kSamples) / kSamples;
            for (std::size_t c = 0; c < width; ++c) {
                result.push_back(
                    static_cast<float>(basis.value(curve, controls, width, c, segment, t)));
            }
        }
        curve += controls * width;
    }
    return result;
}

// Values at the ends of segments, linear between.
std::vector<float> spread(const std::vector<float>& values, std::size_t width,
                          const std::vector<Index>& counts, const CubicBasis& basis) {
    std::vector<float> result;
    const float* curve = values.data();
    for (const Index controls : counts) {
        const Index segments = basis.segments(controls);
        for (Index k = 0; k <= kSamples * segments; ++k) {
            const Index segment = std::min(k, kSamples * segments - 1) / kSamples;
            const float t = float(k - segment * kSamples) / kSamples;
            const float* const a = curve + segment * width;
            for (std::size_t c = 0; c < width; ++c) {
                result.push_back(a[c] + t * (a[width + c] - a[c]));
            }
        }
        curve += (segments + 1) * width;
    }
    return result;
}

}  // namespace

void make_linear(CurvesPrim& prim) {
    const std::vector<Index> counts = curve_counts(prim);
    const CubicBasis basis(prim);
    std::size_t controls = 0, ends = 0;
    std::vector<double> new_counts;
    for (const Index count : counts) {
        const Index segments = basis.segments(count);
        controls += count;
        ends += at(segments) + 1;
        new_counts.push_back(kSamples * double(segments) + 1.0);
    }
    const auto convert = [&](CurveValues& values, std::size_t width, const char* what) {
        const bool vertex = values.interpolation == CurveInterpolation::vertex;
        if (!values.found || values.interpolation < CurveInterpolation::varying) return;
        if (values.numbers.size() != width * (vertex ? controls : ends)) {
            refuse_cubic(prim,
                         std::string("the number of '") + what + "' does not fit its interpolation",
                         ErrorCode::file_syntax);
        }
        values.numbers = vertex ? sampled(values.numbers, width, counts, basis)
                                : spread(values.numbers, width, counts, basis);
    };
    convert(prim.widths, 1, "widths");
    convert(prim.uvs, 2, "st");
    convert(prim.colors, 3, "displayColor");
    convert(prim.opacities, 1, "displayOpacity");
    prim.points = sampled(prim.points, 3, counts, basis);
    prim.counts = std::move(new_counts);
    prim.type = "linear";
}

}  // namespace lissom
