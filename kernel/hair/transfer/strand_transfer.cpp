#include "kernel/hair/transfer/strand_transfer.h"

#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/follow/skin_contact.h"
#include "kernel/hair/follow/strand_follow.h"
#include "kernel/hair/operators/strand_attach.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/hair/transfer/head_fit.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Metres under the skin within which points are seen to be inside.
constexpr double kDeepest = 0.1;

void require_transfer_options(const TransferOptions& options) {
    require(!options.scale || (*options.scale > 0.0 && std::isfinite(*options.scale)),
            "the scale of transferred hair must be finite and above 0");
    require(!options.clearance || is_length(*options.clearance),
            "the clearance must be finite and not negative");
}

// The old head with the shape, place and size of the new one, in the unit of the old.
std::vector<Vec3> fitted_places(const ScalpedHead& from, const ScalpedHead& to, double unit,
                                const Context& context) {
    const HeadFit fit(from.scalp, to.scalp, context);
    const double units = to.scalp.unit() / unit;
    std::vector<Vec3> places;
    places.reserve(at(from.head.vertex_count()));
    for (const Vec3& p : from.head.positions()) places.push_back(units * fit(p));
    return places;
}

double size_of(const Scalp& scalp) {
    return scalp.scale() * scalp.unit();
}

void push_out_of(const ScalpedHead& to, double clearance, Strands& strands,
                 const Context& context) {
    const double unit = to.scalp.unit();
    std::vector<Vec3> places(to.head.positions().begin(), to.head.positions().end());
    for (Vec3& place : places) place *= unit;
    const double sign = volume(to.head) < 0.0 ? -1.0 : 1.0;
    const SkinSurface skin(std::move(places),
                           triangulate_faces(to.head.topology(), to.head.positions()),
                           to.head.topology(), sign, context);
    PushOutOptions options;
    options.distance = [&](const Vec3& point) {
        const std::optional<SkinHeight> height = skin.height(point, kDeepest);
        return height ? height->height : kDeepest;
    };
    options.clearance = clearance;
    push_out(strands, options, context);
}

}  // namespace

Strands transferred(const Strands& strands, const ScalpedHead& from, const ScalpedHead& to,
                    const TransferOptions& options, const Context& context) {
    require_transfer_options(options);
    Progress progress(context, "transfer strands");
    progress.step(0.5);
    FollowOptions follow;
    follow.unit = unit_of_roots(strands, from.head).value_or(from.scalp.unit());
    follow.scale = options.scale.value_or(size_of(to.scalp) / size_of(from.scalp));
    follow.collision = FollowCollision::none;
    StrandFollower follower(strands, from.head, follow, context);
    Strands result = strands;
    follower.move(fitted_places(from, to, *follow.unit, context), result.edit_points(), context);
    StrandGuides guides = result.guides();
    for (float& arc : guides.arcs) arc = static_cast<float>(arc * *follow.scale);
    result.set_guides(std::move(guides));
    progress.step(0.1);
    attach(result, to.head, to.scalp, {}, context);
    progress.step(0.4);
    if (options.clearance) push_out_of(to, *options.clearance, result, context);
    return result;
}

}  // namespace lissom
