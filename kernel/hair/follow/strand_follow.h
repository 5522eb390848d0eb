/// Hair that follows its head as it bends, morphs, is scaled or skinned: once, or for each frame of
/// an animation.
///
/// Roots stay on their places of the skin. A strand begins with the rotation of the skin at its
/// root, smoothed over the scalp, and passes over to the mean of the rigid motions of the skin
/// around it; its length stays, or grows with a head that is scaled as a whole. Heads may have
/// polygons, and need not be closed.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Ways to keep moved hair out of the head. No point is pushed farther out than it was at rest.
enum class FollowCollision {
    none,
    /// Points near the skin at rest stay over the place of the skin that they lay over: fast.
    near,
    /// All points, and the middles between them, stay outside of all skin.
    all,
};

struct FollowOptions {
    /// Metres in one unit of the head; if absent, as places of the roots on the head say.
    std::optional<double> unit = std::nullopt;
    /// Factor of the strands' lengths, above 0; if absent, the ratio of lengths that the edges of
    /// the head share: 1 unless it is scaled as a whole.
    std::optional<double> scale = std::nullopt;
    /// Metres along a strand over which the rotation at its root passes over to that of the head
    /// around it, and metres over which rotations of the skin are smoothed; 0 or more.
    double ramp = 0.04, smoothing = 0.015;
    FollowCollision collision = FollowCollision::all;
    /// Metres that points stay off the skin, from 0 at the root on up to this at 10 mm along the
    /// strand; 0 or more.
    double clearance = 0.0005;
};

/// Strands prepared for their head's motion. Not for several threads at a time.
class StrandFollower {
  public:
    /// `rest` is the head with the shape it has under these strands. Errors: invalid_argument for
    /// strands that have no roots on a head or grew on another, and for options out of range;
    /// memory_limit; cancelled.
    StrandFollower(Strands strands, const Mesh& rest, const FollowOptions& options = {},
                   const Context& context = {});
    StrandFollower(StrandFollower&&) noexcept;
    StrandFollower& operator=(StrandFollower&&) noexcept;
    ~StrandFollower();

    const Strands& strands() const;

    /// Returns the strands on a deformed head, with all that they hold; equal to the bit if it has
    /// the shape at rest. Widths and guide arcs grow with a head that is scaled as a whole. Errors:
    /// topology_mismatch for a head of other faces; as `move`.
    Strands follow(const Mesh& head, const Context& context = {});

    /// Writes x y z of all points for other positions of the head's vertices; allocates little.
    /// The same for any number of threads. Errors: invalid_argument for another number of positions
    /// or points, and for a head that is turned inside out or has no size; not_finite naming the
    /// vertices; memory_limit, cancelled.
    void move(std::span<const Vec3> positions, std::span<float> points,
              const Context& context = {});

    std::size_t memory_bytes() const;

  private:
    class Prepared;

    std::unique_ptr<Prepared> prepared_;
};

}  // namespace lissom
