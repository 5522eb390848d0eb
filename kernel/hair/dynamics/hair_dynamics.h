/// Dynamics of hair: guides as rods that gravity, wind and the motion of the head move, to see
/// whether a style holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/dynamics/hair_rig.h"
#include "kernel/hair/operators/strand_collision.h"

namespace lissom {

struct HairDynamicsOptions {
    /// Metres per second squared, in the world; at most 100 long.
    Vec3 gravity{0.0, -9.81, 0.0};
    /// Metres per second, in the world; at most 60 long.
    Vec3 wind = Vec3::Zero();
    /// Part of the wind that comes and goes; 0 to 1.
    double gusts = 0.5;
    /// Length in metres of a straight strand that droops by an eighth of it if its root is held
    /// level; 0.001 to 10. Hair as it is: 0.05; with gel: 0.2.
    double stiffness = 0.05;
    /// Part of the weight at rest that the style carries: with 1 it stays as it is until head or
    /// wind move it; 0 to 1.
    double hold = 0.0;
    /// Rate at which hair takes the speed of the air, 1 / s; 0 to 50.
    double drag = 4.0;
    /// Strength of links between guides that are not bound; 0 to 1.
    double cohesion = 0.2;
    /// Friction at the body; 0 to 10.
    double friction = 0.4;
    /// Metres that points stay off the body, if they did so at rest; 0 to 1.
    double clearance = 0.001;
    /// Steps in a thirtieth of a second; 4 to 1000.
    int substeps = 20;
    /// Of the gusts.
    std::uint64_t seed = 1;
};

/// Errors: invalid_argument for options out of range, not_finite.
void require_dynamics(const HairDynamicsOptions& options);

/// State of hair against the one at rest, as seen from the head.
struct HairMotion {
    /// Seconds since the beginning.
    double time = 0.0;
    /// Distances of points from their places at rest, in metres, and the guide with the greatest.
    double rms = 0.0, max = 0.0;
    Index guide = kNoIndex;
    /// Root of the mean square of the points' speeds in the world, in metres per second.
    double speed = 0.0;
    /// Greatest change of a segment's length, as a part of it.
    double stretch = 0.0;
    /// Greatest depth of a point in the body, in metres, beyond that at rest.
    double depth = 0.0;
};

/// Hair in motion, by position-based dynamics in small steps (Macklin and others 2016, "XPBD", and
/// 2019, "Small Steps in Physics Simulation"). Rods have no state but places and speeds of points:
/// frames are carried along each from its root by the least rotations, and a rod resists being bent
/// away from the place that its frame has for the next point. Lengths are kept by a tridiagonal
/// system a rod. Not for several threads at a time.
class HairDynamics {
  public:
    /// `body` is a distance in the space of the head that hair does not enter; it is asked here
    /// alone, at the points of a grid of some millimetres. Errors: as require_dynamics;
    /// invalid_argument for a rig whose lists do not fit, and for guides that
    /// cannot be in metres; memory_limit; cancelled.
    explicit HairDynamics(HairRig rig, const BodyDistance& body = {},
                          const HairDynamicsOptions& options = {}, const Context& context = {});
    HairDynamics(HairDynamics&&) noexcept;
    HairDynamics& operator=(HairDynamics&&) noexcept;
    ~HairDynamics();

    const HairRig& rig() const;
    const HairDynamicsOptions& options() const;
    /// Sets the options of the next steps. Errors: as require_dynamics.
    void set_options(const HairDynamicsOptions& options);

    /// Moves on by `seconds`, at most 10, while the head goes evenly from its present place to
    /// `head`, a rotation and a translation in the world. The same for any number of threads. After
    /// an error the hair is as before. Errors: invalid_argument for a time out of range or a head
    /// that is scaled; cancelled.
    void step(double seconds, const Affine& head, const Context& context = {});
    /// The same with a head that stays.
    void step(double seconds, const Context& context = {});
    /// Puts hair and head back to the beginning.
    void reset();

    /// Returns the guides' points in the space of the head, as GuideSet::curves.
    std::vector<Eigen::Vector3f> curves() const;
    /// Returns the place of the head in the world.
    const Affine& head() const;
    HairMotion motion() const;
    std::size_t memory_bytes() const;

  private:
    class Simulation;

    std::unique_ptr<Simulation> simulation_;
};

}  // namespace lissom
