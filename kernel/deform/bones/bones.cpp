#include "kernel/deform/bones/bones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"
#include "kernel/deform/constraint_edits.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Least number of vertices that hold a bone firmly.
constexpr std::size_t kLeastHeld = 3;
constexpr double kShareGrowth = 1.3;
// Part of its bone by which an end of the chain may stick out of the surface.
constexpr double kEndSlack = 0.25;

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
        : options_(options), tree_(rest, context), is_turned_over_(volume(rest) < 0.0) {
        for (const Index v : region.vertices()) {
            if (v % 256 == 0) context.checkpoint();
            const BoneSide side = side_of(options.joints, rest.position(v));
            if (std::abs(side.along) > 1.0 || !is_beside(side.foot, rest.position(v))) continue;
            beside_.emplace_back(v, side);
        }
    }

    // A surface with an inside, which is told by its closedness or by one of the joints, has all of
    // them there.
    void require_inside() const {
        if (options_.radius > 0.0) return;
        const std::vector<Vec3>& joints = options_.joints;
        std::vector<std::size_t> outside;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            Vec3 place = joints[i];
            if (i == 0) place += kEndSlack * (joints[1] - place);
            if (i + 1 == joints.size()) place += kEndSlack * (joints[i - 1] - place);
            // An end may stick out a little, and a long bone may leave a bend of the limb.
            if (!is_inside(joints[i]) && !is_inside(place)) outside.push_back(i);
        }
        const bool has_inside = tree_.topology().is_closed() || outside.size() < joints.size();
        require(outside.empty() || !has_inside,
                outside.empty() ? std::string()
                                : "joint " + std::to_string(outside.front() + 1) +
                                      " lies outside the surface: move it into the limb");
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
                    (options_.radius > 0.0
                         ? " has no part of the surface within its radius"
                         : " is seen by no part of the surface: lay its joints within the limb, "
                           "or fewer and longer bones"));
        return held;
    }

  private:
    // Whether most directions first meet the surface from its inner side.
    bool is_inside(const Vec3& point) const {
        int within = 0, all = 0;
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                for (int z = -1; z <= 1; ++z) {
                    if (x == 0 && y == 0 && z == 0) continue;
                    // A little beside the axes, along which edges of models run.
                    const Vec3 way(x + 0.0123, y - 0.0231, z + 0.0312);
                    const auto hit = tree_.pick(point, way);
                    within += hit && (hit->normal.dot(way) > 0.0) != is_turned_over_ ? 1 : 0;
                    ++all;
                }
            }
        }
        return 2 * within >= all;
    }

    bool is_beside(const Vec3& foot, const Vec3& vertex) const {
        if (options_.radius > 0.0) return (vertex - foot).norm() <= options_.radius;
        return sees(foot, vertex);
    }

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
    bool is_turned_over_;
    std::vector<std::pair<Index, BoneSide>> beside_;
};

}  // namespace

std::vector<Region> bone_regions(const Mesh& rest, const Region& region,
                                 const BonesOptions& options, const Context& context) {
    const BoneChain chain(options.joints, options.limits);
    require(options.share > 0.0 && options.share <= 1.0,
            "the share of a bone is above 0 and at most 1");
    require(is_length(options.radius), "the radius of bones is 0 or more");
    const BoneHolds holds(rest, region, options, context);
    holds.require_inside();
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
    return with_memory_errors([&] {
        return DeformerAccess::state(deformer).edit([&](ConstraintEdit& edit) {
            Bones bones{options.joints, options.limits, {}};
            for (const Region& region : regions)
                bones.handles.push_back(edit.add_handle(region, {}));
            edit.add_bones(bones);
            return bones;
        });
    });
}

std::vector<Bones> bones_of(const Deformer& deformer) {
    std::vector<Bones> chains;
    for (const auto& bones : DeformerAccess::state(deformer).constraints->bones) {
        chains.push_back(*bones);
    }
    return chains;
}

const Bones& bones_with(const Deformer& deformer, HandleId first) {
    for (const auto& bones : DeformerAccess::state(deformer).constraints->bones) {
        if (bones->handles.front() == first) return *bones;
    }
    throw Error(ErrorCode::handle_removed, "the bones were removed, or one of their handles was");
}

void remove_bones(Deformer& deformer, const Bones& bones) {
    DeformerAccess::state(deformer).edit([&](ConstraintEdit& edit) {
        for (const HandleId handle : bones.handles) edit.remove_handle(handle);
    });
}

BoneChain chain_of(const Deformer& deformer, const Bones& bones) {
    BoneChain chain(bones.joints, bones.limits);
    std::vector<Eigen::Quaterniond> rotations;
    Vec3 base = bones.joints.front();
    for (std::size_t i = 0; i < bones.handles.size(); ++i) {
        const HandlePose& pose = deformer.pose(bones.handles[i]);
        rotations.emplace_back(nearest_rotation(pose.transform.linear));
        if (i == 0) base = pose.transform(bones.joints.front());
    }
    chain.set(rotations, base);
    return chain;
}

std::vector<Vec3> joints_of(const Deformer& deformer, const Bones& bones) {
    std::vector<Vec3> joints;
    for (std::size_t i = 0; i < bones.handles.size(); ++i) {
        joints.push_back(deformer.pose(bones.handles[i]).transform(bones.joints[i]));
    }
    joints.push_back(deformer.pose(bones.handles.back()).transform(bones.joints.back()));
    return joints;
}

void set_bones(Deformer& deformer, const Bones& bones, const BoneChain& chain) {
    require(count_of(bones.handles) == chain.size(), "the chain has another number of bones");
    // All are known before the first moves.
    for (const HandleId handle : bones.handles) (void)deformer.pose(handle);
    const std::vector<Affine> maps = chain.transforms();
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Vec3& joint = bones.joints[i];
        // About the joint, so that far coordinates keep their digits.
        deformer.set_transform(bones.handles[i], {maps[i].linear, maps[i](joint) - joint}, joint);
    }
}

}  // namespace lissom
