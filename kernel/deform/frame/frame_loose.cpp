// Positions of parts that follow the surface near them.
#include <cmath>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

// The similarity, or the rigid motion if details keep their size, that fits how guides moved best,
// in the coordinates of the patch.
class GuideFit {
  public:
    GuideFit(const Preparation& prepared, const std::vector<Vec3>& positions)
        : prepared_(prepared), positions_(positions) {}

    Affine fit(const std::vector<Index>& guides) const {
        const double count = static_cast<double>(guides.size());
        Vec3 before = Vec3::Zero(), after = Vec3::Zero();
        for (const Index v : guides) {
            before += rest_of(v) / count;
            after += place_of(v) / count;
        }
        Mat3 product = Mat3::Zero();
        double size_before = 0.0, size_after = 0.0;
        for (const Index v : guides) {
            const Vec3 a = rest_of(v) - before, b = place_of(v) - after;
            product += b * a.transpose();
            size_before += a.squaredNorm();
            size_after += b.squaredNorm();
        }
        Affine map;
        map.linear = nearest_rotation(product);
        const bool scales = prepared_.rest->options().local_size == LocalSize::scale;
        if (scales && size_before > 0.0) map.linear *= std::sqrt(size_after / size_before);
        map.translation = after - map.linear * before;
        return map;
    }

  private:
    const Vec3& rest_of(Index v) const { return prepared_.patch().rest[at(v)]; }
    Vec3 place_of(Index v) const {
        const Index row = prepared_.rest->frame_row(prepared_.patch(), v);
        return row == kNoIndex ? rest_of(v) : Vec3(positions_[at(row)] - prepared_.patch().origin);
    }

    const Preparation& prepared_;
    const std::vector<Vec3>& positions_;
};

Affine motion_of(const FollowingPart& part, const Preparation& prepared, const Poses& poses,
                 const std::vector<Vec3>& positions) {
    if (part.owner >= 0) return poses.handles[at(part.owner)].local_transform;
    if (part.owner == kPinned) return {};
    return GuideFit(prepared, positions).fit(part.guides);
}

template <typename Use>
void for_each_follower(const Preparation& prepared, const Poses& poses,
                       const std::vector<Vec3>& positions, const Use& use) {
    for (const FollowingPart& part : prepared.following) {
        const Affine map = motion_of(part, prepared, poses, positions);
        for (const Index v : part.members) {
            const Index row = prepared.rest->frame_row(prepared.patch(), v);
            if (row != kNoIndex) use(v, row, map);
        }
    }
}

}  // namespace

void place_followers(const Preparation& prepared, const Poses& poses,
                     std::vector<Vec3>& positions) {
    for_each_follower(prepared, poses, positions, [&](Index v, Index row, const Affine& map) {
        if (map.is_identity()) return;
        positions[at(row)] = map(prepared.patch().rest[at(v)]) + prepared.patch().origin;
    });
}

void turn_followers(const Preparation& prepared, const Poses& poses,
                    const std::vector<Vec3>& positions, std::vector<Mat3>& gradients) {
    for_each_follower(prepared, poses, positions, [&](Index, Index row, const Affine& map) {
        if (at(row) < gradients.size()) gradients[at(row)] = map.linear;
    });
}

}  // namespace lissom
