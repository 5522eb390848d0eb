/// Parts that are deformed many times, for other places and by other boundaries; private to
/// kernel/merge.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/stats.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct MovedPart {
    Mesh mesh;
    DeformStats stats;
    /// For each vertex of the part's loop, how far the part draws it.
    std::vector<Vec3> pulls;
};

/// A part with its systems factored: to move it anew costs no more than to solve them.
class MovingPart {
  public:
    /// Errors: as BoundaryDeformer.
    MovingPart(PastePart part, const BoundaryDeformOptions& options, const Context& context);

    const PastePart& part() const { return part_; }
    /// `values` are of the part's loop, in its order. Errors: as BoundaryDeformer::solve.
    MovedPart moved(std::span<const BoundaryValue> values, const Context& context);
    /// Goes on from that with ARAP iterations. Errors: as BoundaryDeformer::refine.
    MovedPart refined(int steps, const Context& context);

  private:
    MovedPart moved_by(const BoundaryDeformation& deformed) const;

    PastePart part_;
    BoundaryDeformer deformer_;
    /// Place of each vertex of the loop among the held vertices.
    std::vector<std::size_t> held_;
};

/// The parts inside the last boundaries: most moves change the place of a boundary, and not its
/// vertices.
class MovingParts {
  public:
    enum class Boundary { line, loop, outline, outline_line, inner, inner_line, foot };
    using Make = std::function<PastePart()>;

    /// Returns the part inside a boundary, from `make` if it is not the last one of its kind.
    std::shared_ptr<MovingPart> inside(Boundary kind, std::span<const Index> loop, const Make& make,
                                       const BoundaryDeformOptions& options,
                                       const Context& context);
    std::shared_ptr<MovingPart> inside(Boundary kind, std::span<const Vec2> line, const Make& make,
                                       const BoundaryDeformOptions& options,
                                       const Context& context);

  private:
    struct Kept {
        std::vector<Index> loop;
        std::vector<Vec2> line;
        std::shared_ptr<MovingPart> part;
    };
    std::array<Kept, 7> kept_;
};

}  // namespace lissom
