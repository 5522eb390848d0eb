// Bones and handles along curves.
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"
#include "kernel/deform/bones/bone_chain.h"
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/bones/framed_curve.h"

namespace lissom {
namespace {

void require_twist(double twist) {
    require(std::isfinite(twist), "the twist is not finite", ErrorCode::not_finite);
}

// The turn of bone i of `count` about its direction.
Eigen::Quaterniond twist_of(double twist, std::size_t i, std::size_t count, const Vec3& direction) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    return Eigen::Quaterniond(Eigen::AngleAxisd(share * twist, direction.normalized()));
}

// Maps that carry bones at rest to spans between the given joints, stretched along themselves.
std::vector<Affine> spanning_maps(const std::vector<Vec3>& rest, const std::vector<Vec3>& joints,
                                  double twist) {
    std::vector<Affine> maps;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    const std::size_t count = rest.size() - 1;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 bone = rest[i + 1] - rest[i], span = joints[i + 1] - joints[i];
        require(span.norm() > 0.0, "the curve runs back onto itself at a joint");
        turn = (min_rotation(turn * bone, span) * turn).normalized();
        const Vec3 along = bone.normalized();
        const Mat3 stretch =
            Mat3::Identity() + (span.norm() / bone.norm() - 1.0) * along * along.transpose();
        const Mat3 linear = (twist_of(twist, i, count, span) * turn).toRotationMatrix() * stretch;
        maps.push_back({linear, joints[i] - linear * rest[i]});
    }
    return maps;
}

// The points of a curve at the shares that joints have in the length of their chain.
std::vector<Vec3> spread_joints(const std::vector<Vec3>& rest, const FramedCurve& curve) {
    std::vector<double> along = {0.0};
    for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
        along.push_back(along.back() + (rest[i + 1] - rest[i]).norm());
    }
    std::vector<Vec3> joints;
    for (const double s : along)
        joints.push_back(curve.at(curve.length() * s / along.back()).point);
    return joints;
}

}  // namespace

void BoneChain::follow(const FramedCurve& curve, double twist) {
    require_twist(twist);
    const std::size_t count = turns_.size();
    Vec3 joint = curve.at(0.0).point;
    double along = 0.0;
    // As limits leave it, without its twist and with it.
    Eigen::Quaterniond plain = Eigen::Quaterniond::Identity(), before = plain;
    base_ = joint;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 bone = rest_[i + 1] - rest_[i];
        along = curve.leave(joint, bone.norm(), along);
        const Vec3 way = curve.at(along).point - joint;
        if (way.norm() > 0.0) plain = (min_rotation(plain * bone, way) * plain).normalized();
        const Eigen::Quaterniond wanted = twist_of(twist, i, count, plain * bone) * plain;
        turns_[i] = (before.conjugate() * wanted).normalized();
        if (limit(index_of(i))) plain = before * turns_[i];
        before = (before * turns_[i]).normalized();
        joint += before * bone;
    }
}

void follow(Deformer& deformer, const Bones& bones, const FramedCurve& curve,
            const BonesFollowOptions& options) {
    if (!options.stretch) {
        BoneChain chain = chain_of(deformer, bones);
        chain.follow(curve, options.twist);
        set_bones(deformer, bones, chain);
        return;
    }
    require_twist(options.twist);
    const std::vector<Affine> maps =
        spanning_maps(bones.joints, spread_joints(bones.joints, curve), options.twist);
    // All are known before the first moves.
    for (const HandleId handle : bones.handles) (void)deformer.pose(handle);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Vec3& joint = bones.joints[i];
        deformer.set_transform(bones.handles[i], {maps[i].linear, maps[i](joint) - joint}, joint);
    }
}

void follow(Deformer& deformer, HandleId handle, const FramedCurve& curve,
            const CarryOptions& options) {
    require(std::isfinite(options.from) && std::isfinite(options.along),
            "a place on the curve is not finite", ErrorCode::not_finite);
    require_twist(options.twist);
    const CurveFrame start = curve.at(options.from), end = curve.at(options.along);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(Eigen::AngleAxisd(options.twist, end.direction)) * end.turn *
        start.turn.conjugate();
    // About the handle's centre, so that far coordinates keep their digits.
    const Vec3 center = deformer.handle(handle).center;
    const Vec3 place = end.point + turn * (center - start.point);
    deformer.set_transform(handle, {turn.toRotationMatrix(), place - center}, center);
}

}  // namespace lissom
