/// CosineTransform: the discrete cosine transform of three fields over a grid; private to
/// kernel/solve.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// Components of the field, which are transformed together.
inline constexpr int kComponents = 3;

/// Destination of the last step of an inverse transform; exactly one pointer is set.
struct FieldSink {
    /// Component by component, all points of each.
    double* components = nullptr;
    Vec3* vectors = nullptr;
    /// Four numbers a point; the last is left as it is.
    float* quads = nullptr;
    /// Added to every point.
    Vec3 constant = Vec3::Zero();
};

/// The orthonormal DCT-II along each axis: its basis diagonalises the Laplacian of the box with
/// mirrored neighbours. Fields are stored component by component. Small matrix products, each of
/// half the size because basis vectors are even or odd; each turns the axes round by one, so that
/// all three are the same product. Spectra keep the even frequencies of an axis before the odd
/// ones. Results do not depend on the number of threads.
class CosineTransform {
  public:
    explicit CosineTransform(const GridSize& size);

    const GridSize& size() const { return size_; }
    /// Bytes of the tables for a grid of this size.
    static std::size_t bytes(const GridSize& size);
    /// Returns the frequency at position `q` of the spectrum of an axis with `n` points.
    static Index frequency(Index q, Index n);

    /// Spectra of the fields at `from`, written to `to`; `from` is overwritten.
    void forward(double* from, double* to, const Context& context) const;
    /// Spectra of fields that are zero but for values[i] at points[i], which must differ, written
    /// to `to`; `scratch` is overwritten.
    void forward_at(std::span<const GridPoint> points, std::span<const Vec3> values,
                    double* scratch, double* to, const Context& context) const;
    /// Fields of the spectra at `from`, written to `sink`; `from` and `scratch` are overwritten. A
    /// sink of components may be `scratch`.
    void inverse(double* from, double* scratch, const FieldSink& sink,
                 const Context& context) const;

  private:
    /// The transform of one axis. Tables are column-major and negated, because the dense product
    /// that reads them subtracts.
    struct Axis {
        explicit Axis(Index points);
        Index n, even, odd;
        std::vector<double> forward_even, forward_odd, inverse_even, inverse_odd;
        /// Entry q + n j: the value of the basis vector at position q at point j.
        std::vector<double> basis;
    };

    void forward_step(const Axis& axis, const double* from, double* to,
                      const Context& context) const;
    void inverse_step(const Axis& axis, const double* from, const FieldSink& sink,
                      const Context& context) const;
    void scatter(std::span<const GridPoint> points, std::span<const Vec3> values, double* to,
                 const Context& context) const;

    GridSize size_;
    std::array<Axis, 3> axes_;
};

}  // namespace lissom
