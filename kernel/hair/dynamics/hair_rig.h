/// Rigs of hair: guides as chains with lengths, frames and constraints, as simulations take them.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/dynamics/body_capsules.h"
#include "kernel/hair/guides/guide_set.h"
#include "kernel/hair/operators/strand_collision.h"

namespace lissom {

/// A ball that holds the hair in it to the head, as an elastic or a pin does; metres.
struct RigTie {
    std::string name = {};
    Vec3 center = Vec3::Zero();
    double radius = 0.02;
};

struct HairRigOptions {
    std::vector<RigTie> ties = {};
    /// Groups of strands whose guides are bound to one another wherever they touch, as in a braid.
    std::vector<std::string> bound = {};
    /// Metres between points of two guides up to which they are linked; 0 or more.
    double reach = 0.015;
    /// Links of a point at most to others; 0 to 8.
    int links = 2;
    /// The body that hair does not enter, with capsules for it in the box of all guides; none if
    /// absent.
    BodyDistance body = {};
    CapsuleOptions capsules = {};
};

/// Two points of different guides, numbered over all guides, that were `length` metres apart at
/// rest.
struct HairLink {
    Index a = 0, b = 0;
    float length = 0.0f;
    /// True within a bound group.
    bool bound = false;
};

/// Points held by a tie, numbered over all guides, ascending.
struct TiedPoints {
    RigTie tie;
    std::vector<Index> points;
};

/// Guides at rest with all that holds them. Lists of guides are in the order of the set.
struct HairRig {
    /// Points of each guide.
    Index points = 0;
    /// x y z of the guides' points, one guide after the other; metres, in the space of the head.
    std::vector<Eigen::Vector3f> curves;
    /// Ids of the strands that they are.
    std::vector<std::uint32_t> ids;
    /// Lengths of the segments, points - 1 a guide; metres.
    std::vector<float> lengths;
    /// Rotations that take the z axis to the first segment of each guide by the least angle.
    std::vector<Eigen::Quaternionf> root_frames;
    std::vector<TiedPoints> ties;
    std::vector<HairLink> links;
    std::vector<Capsule> capsules;
    /// Part of the body around the guides that lies in a capsule.
    double capsule_cover = 0.0;
    /// Length of each strand of the set, as it is rebuilt at rest; metres.
    std::vector<float> strand_lengths;

    Index guide_count() const { return count_of(ids); }
    std::size_t memory_bytes() const;
};

/// Makes the rig of a set of guides. Errors: invalid_argument for options out of range, a tie that
/// holds no point of a guide, and unknown groups; as fit_capsules; memory_limit; cancelled.
HairRig make_hair_rig(const GuideSet& set, const HairRigOptions& options = {},
                      const Context& context = {});

}  // namespace lissom
