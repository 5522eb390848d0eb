/// GridGreen: the pseudo-inverse of the zero-flux operator of a box; private to kernel/solve.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/solve/grid/cosine_transform.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// The operator A0 = D'D - tau D of equations (4.1) and (4.3). D is the Laplacian with weights 1/6
/// and mirrored neighbours at the faces, so that nothing flows out, and tau the tension. In the
/// cosine basis A0 is diagonal with the eigenvalues mu^2 + tau mu, with mu = sum over the axes of
/// (2 - 2 cos(pi k_a / n_a)) / 6. Entries of the pseudo-inverse are sums of eight entries of one
/// table
///     K(p) = sum over k != 0 of prod_a w(k_a) cos(pi k_a p_a / n_a) / (mu^2 + tau mu),
/// w(0) = 1 / 2n and else 1 / n, 0 <= p_a <= n_a: those at |i_a - j_a| and i_a + j_a + 1, folded at
/// n_a.
class GridGreen {
  public:
    GridGreen(const GridSize& size, double tension, const Context& context);

    const GridSize& size() const { return transform_.size(); }
    /// Bytes of the tables for a grid of this size.
    static std::size_t bytes(const GridSize& size);
    /// Bytes that the constructor takes besides.
    static std::size_t working_bytes(const GridSize& size);

    /// entries[i] = the entry of the pseudo-inverse for the points points[i] and `other`.
    void column(const GridPoint& other, std::span<const GridPoint> points, double* entries) const;
    double entry(const GridPoint& a, const GridPoint& b) const;
    /// Returns the number added to every entry so that matrices of entries are well conditioned for
    /// the constant mode, too.
    double shift() const { return shift_; }

    /// A0+ f for the three fields f at `field`, in place; `scratch` is as large.
    void apply(double* field, double* scratch, const Context& context) const;
    /// A0+ f + sink.constant for fields f that are zero but for values[i] at points[i]. `first` and
    /// `second` are overwritten, each as large as three fields; a sink of components may be
    /// `second`.
    void apply_at(std::span<const GridPoint> points, std::span<const Vec3> values, double* first,
                  double* second, const FieldSink& sink, const Context& context) const;

  private:
    void scale(double* spectra, const Context& context) const;
    void fill_table(const Context& context);

    CosineTransform transform_;
    double tension_;
    /// Terms of mu in the order of the spectra.
    std::array<std::vector<double>, 3> terms_;
    std::vector<double> table_;
    double shift_ = 0.0;
};

}  // namespace lissom
