/// The correspondence of two heads of any faces by directions from their middles; private to
/// kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/scalp/scalp.h"

namespace lissom {

/// Takes points of one head to another: each keeps its direction from the center of the scalp's
/// frame, and its distance changes as those of the skins in this direction do. The ratio of the
/// distances is smoothed over about ten degrees, so that ears and noses that lie elsewhere leave
/// hair as it is, and from 45 degrees below the horizon on it is that of the neck.
class HeadFit {
  public:
    HeadFit(const Scalp& from, const Scalp& to, const Context& context);

    /// Returns the place beside `to` of a point of `from`, each in the unit of its mesh.
    Vec3 operator()(const Vec3& point) const;

  private:
    void measure(const Context& context);
    void fill();
    void smooth();
    double ratio(const ScalpDirection& direction) const;

    const Scalp &from_, &to_;
    /// Logarithms of the ratio on a grid of directions, rows of equal elevation from below up; NaN
    /// while one is not known.
    std::vector<double> log_ratios_;
};

}  // namespace lissom
