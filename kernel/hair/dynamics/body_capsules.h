/// Capsules that stand for a body in simulations.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/operators/strand_collision.h"

namespace lissom {

/// All points within `radius` of the segment from a to b, which may be one point; metres.
struct Capsule {
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    double radius = 0.0;
};

/// Returns the distance of a point to the surface of a capsule, negative inside.
double distance_to(const Capsule& capsule, const Vec3& point);

struct CapsuleOptions {
    /// Greatest number of capsules; 1 to 64.
    Index count = 12;
    /// Part of the body in the box that is enough to cover; above 0, at most 1.
    double cover = 0.98;
    /// Metres by which capsules may stand out of the body; 0 or more.
    double tolerance = 0.002;
};

struct BodyCapsules {
    /// The one that covers most first.
    std::vector<Capsule> capsules;
    /// Part of the body in the box that lies in a capsule.
    double covered = 0.0;
};

/// Fits capsules into the part of a body that lies in `box`: between places deep inside, as thick
/// as the body lets them be, each chosen to cover most of what others leave. Errors:
/// invalid_argument without a distance, for options out of range, or if the box holds no body;
/// memory_limit; cancelled.
BodyCapsules fit_capsules(const BodyDistance& distance, const Box& box,
                          const CapsuleOptions& options = {}, const Context& context = {});

}  // namespace lissom
