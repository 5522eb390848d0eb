#include "kernel/deform/bones/bones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Least number of vertices that hold a bone firmly.
constexpr std::size_t kLeastHeld = 3;
constexpr double kShareGrowth = 1.3;

// The place of a vertex beside a chain.
struct BoneSide {
    Index bone = kNoIndex;
    // From -1 at its first joint to 1 at the second, and the foot of the vertex on it.
    double along = 0.0;
    Vec3 foot = Vec3::Zero();
};

BoneSide side_of(const std::vector<Vec3>& joints, const Vec3& point) {
    BoneSide best;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i + 1 < count_of(joints); ++i) {
        const Vec3 bone = joints[at(i + 1)] - joints[at(i)];
        const double t = (point - joints[at(i)]).dot(bone) / bone.squaredNorm();
        const Vec3 foot = joints[at(i)] + std::clamp(t, 0.0, 1.0) * bone;
        const double distance = (point - foot).norm();
        if (distance >= least) continue;
        least = distance;
        best = {i, 2.0 * t - 1.0, foot};
    }
    return best;
}

class BoneHolds {
  public:
    BoneHolds(const Mesh& rest, const Region& region, const BonesOptions& options,
              const Context& context)
        : options_(options), tree_(rest, context) {
        for (const Index v : region.vertices()) {
            if (v % 256 == 0) context.checkpoint();
            const BoneSide side = side_of(options.joints, rest.position(v));
            if (std::abs(side.along) > 1.0 || !sees(side.foot, rest.position(v))) continue;
            beside_.emplace_back(v, side);
        }
    }

    // The middle share grows until it holds enough.
    std::vector<Index> of(Index bone) const {
        std::vector<Index> held;
        for (double share = options_.share; held.size() < kLeastHeld; share *= kShareGrowth) {
            held.clear();
            for (const auto& [v, side] : beside_) {
                if (side.bone == bone && std::abs(side.along) <= share) held.push_back(v);
            }
            if (share >= 1.0) break;
        }
        require(held.size() >= kLeastHeld,
                "bone " + std::to_string(bone + 1) +
                    " is seen by no part of the surface: lay its joints within the limb");
        return held;
    }

  private:
    bool sees(const Vec3& foot, const Vec3& vertex) const {
        const Vec3 way = vertex - foot;
        const double distance = way.norm();
        if (distance == 0.0) return true;
        RayOptions ray;
        ray.limit = distance * (1.0 - 1e-6);
        const auto hit = tree_.pick(foot, way, ray);
        return !hit || hit->distance > distance * (1.0 - 1e-3);
    }

    const BonesOptions& options_;
    SpatialTree tree_;
    std::vector<std::pair<Index, BoneSide>> beside_;
};

}  // namespace

std::vector<Region> bone_regions(const Mesh& rest, const Region& region,
                                 const BonesOptions& options, const Context& context) {
    const BoneChain chain(options.joints, options.limits);
    require(options.share > 0.0 && options.share <= 1.0,
            "the share of a bone is above 0 and at most 1");
    const BoneHolds holds(rest, region, options, context);
    std::vector<Region> regions;
    for (Index bone = 0; bone < chain.size(); ++bone) {
        regions.emplace_back(rest.shared_topology(), holds.of(bone));
    }
    return regions;
}

Bones add_bones(Deformer& deformer, const Mesh& mesh, const BonesOptions& options,
                const Context& context) {
    Mesh rest(mesh);
    apply_rest(deformer, rest);
    const std::vector<Region> regions = bone_regions(rest, deformer.region(), options, context);
    Bones bones{options.joints, options.limits, {}};
    try {
        for (const Region& region : regions) bones.handles.push_back(deformer.add_handle(region));
    } catch (...) {
        for (const HandleId handle : bones.handles) deformer.remove_handle(handle);
        throw;
    }
    return bones;
}

BoneChain chain_of(const Deformer& deformer, const Bones& bones) {
    BoneChain chain(bones.joints, bones.limits);
    std::vector<Eigen::Quaterniond> rotations;
    Vec3 base = bones.joints.front();
    for (std::size_t i = 0; i < bones.handles.size(); ++i) {
        const HandlePose& pose = deformer.pose(bones.handles[i]);
        rotations.push_back(Eigen::Quaterniond(pose.transform.linear).normalized());
        if (i == 0) base = pose.transform(bones.joints.front());
    }
    chain.set(rotations, base);
    return chain;
}

void set_bones(Deformer& deformer, const Bones& bones, const BoneChain& chain) {
    require(count_of(bones.handles) == chain.size(), "the chain has another number of bones");
    // All are known before the first moves.
    for (const HandleId handle : bones.handles) (void)deformer.pose(handle);
    for (Index i = 0; i < chain.size(); ++i) {
        const Vec3& joint = bones.joints[at(i)];
        const Affine map = chain.transform(i);
        // About the joint, so that far coordinates keep their digits.
        deformer.set_transform(bones.handles[at(i)], {map.linear, map(joint) - joint}, joint);
    }
}

}  // namespace lissom
