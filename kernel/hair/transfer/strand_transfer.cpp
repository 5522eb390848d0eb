#include "kernel/hair/transfer/strand_transfer.h"

#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/hair/follow/strand_follow.h"
#include "kernel/hair/operators/strand_attach.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/scalp/surface_distance.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/hair/transfer/head_fit.h"

namespace lissom {
namespace {

// Points of the grid of distances to the head.
constexpr Index kBodyResolution = 100000;

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

// The head in metres of its scalp's frame.
Mesh framed(const ScalpedHead& head, const Context& context) {
    std::vector<Vec3> places;
    places.reserve(at(head.head.vertex_count()));
    for (const Vec3& p : head.head.positions()) places.push_back(head.scalp.to_metres(p));
    return {std::move(places), head.head.shared_topology(), context};
}

void push_out_of(const ScalpedHead& to, double clearance, Strands& strands,
                 const Context& context) {
    const Scalp& scalp = to.scalp;
    const double metre = size_of(scalp);
    const Mesh head = framed(to, context);
    const DistanceGrid grid(head, fit_grid(Scalp::default_volume(), kBodyResolution), {}, context);
    const SurfaceDistance surface(scalp, grid, head);
    const auto frame = [&](const Vec3& p) { return scalp.to_metres(p / scalp.unit()); };
    PushOutOptions options;
    options.distance = [&](const Vec3& p) { return metre * surface(frame(p)); };
    options.rough = [&](const Vec3& p) { return metre * grid.value(frame(p)); };
    options.rough_error = metre * grid.layout().step;
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
