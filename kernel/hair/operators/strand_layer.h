/// Hair that lies over other hair: the thickness of a lower layer, and an operator that lifts
/// strands over it.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Height above a body that hair reaches, by the direction from the middle of the head: in cells of
/// four degrees the height below which nine tenths of its points lie, smoothed over the neighbours.
class LayerThickness {
  public:
    /// `distance` is that to the body; `center` lies inside, in the unit of the strands. Hair
    /// higher than 0.128 metres counts as so high. Errors: memory_limit; cancelled.
    LayerThickness(const Strands& lower, const BodyDistance& distance, const Vec3& center,
                   const Context& context = {});

    /// Returns metres above the body in the direction of a point; 0 if no hair lies there, linear
    /// between cells.
    double at(const Vec3& point) const;

  private:
    struct Row {
        Index first, cells;
    };

    Index cell_of(const Vec3& point) const;
    double in_row(Index row, double turn) const;
    double at_angles(double rise, double turn) const;
    void set_heights(const std::vector<float>& counts);
    void smooth_heights();

    Vec3 center_;
    /// Rows from pole to pole, with cells of about equal width.
    std::vector<Row> rows_;
    std::vector<double> heights_;
};

struct LiftOverOptions : StrandOperatorOptions {
    /// The lower layer; not null.
    const LayerThickness* layer = nullptr;
    BodyDistance distance;
    /// Metres that strands lie above the lower layer at least, and by up to how much more at
    /// random; 0 or more.
    double gap = 0.001, spread = 0.006;
    /// Length in metres from the root over which strands rise so far; 0 or more.
    double ramp = 0.02;
};

/// Lifts strands that lie in a lower layer over it, away from the body. Others stay to the bit.
/// Errors: invalid_argument without a layer or a distance, or for options out of range; not_finite;
/// memory_limit, cancelled.
void lift_over(Strands& strands, const LiftOverOptions& options, const Context& context = {});

}  // namespace lissom
