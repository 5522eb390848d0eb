// Bones of deformers.
#include <cmath>

#include "bindings/c/data.h"
#include "kernel/deform/bones/bone_chain.h"
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/bones/framed_curve.h"
#include "kernel/deform/deformer.h"

namespace lissom::c {
namespace {

Deformer& boned_deformer(lissom_context& context, lissom_deformer deformer) {
    return context.content<Deformer>(deformer.id, Kind::deformer);
}

BonesOptions bones_options(const lissom_context& context, const lissom_input* joints,
                           const lissom_bones_options* given) {
    const auto taken = take_options(given, lissom_default_bones_options());
    BonesOptions options;
    options.joints = read_points(joints, context.space, "joints");
    if (taken.limits.count > 0) options.limits = read_numbers(&taken.limits, 1, "limits");
    options.share = taken.share;
    options.radius = taken.radius;
    return options;
}

// Changes a chain by work(chain), and moves its handles along.
template <typename Work>
void change_bones(lissom_context& context, lissom_deformer deformer, int32_t bones,
                  const Work& work) {
    Deformer& own = boned_deformer(context, deformer);
    const Bones& chain_bones = bones_with(own, HandleId{bones});
    BoneChain chain = chain_of(own, chain_bones);
    work(chain);
    set_bones(own, chain_bones, chain);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_bones_options lissom_default_bones_options(void) {
    lissom_bones_options options{};
    options.struct_size = sizeof options;
    options.share = BonesOptions().share;
    return options;
}

lissom_status lissom_deformer_add_bones(lissom_context* context, lissom_deformer deformer,
                                        lissom_mesh mesh, const lissom_input* joints,
                                        const lissom_bones_options* options, int32_t* bones) {
    return run(context, [&] {
        require_given(bones, "bones");
        *bones = add_bones(boned_deformer(*context, deformer), shown_mesh(*context, mesh),
                           bones_options(*context, joints, options), context->kernel)
                     .handles.front()
                     .value;
    });
}

lissom_status lissom_deformer_remove_bones(lissom_context* context, lissom_deformer deformer,
                                           int32_t bones) {
    return run(context, [&] {
        Deformer& own = boned_deformer(*context, deformer);
        remove_bones(own, Bones(bones_with(own, HandleId{bones})));
    });
}

lissom_status lissom_deformer_turn_bone(lissom_context* context, lissom_deformer deformer,
                                        int32_t bones, int32_t bone, const double axis[3],
                                        double angle) {
    return run(context, [&] {
        require_given(axis, "axis");
        const Vec3 about = context->space.to_kernel(axis);
        const double turn = context->space.mirrors() ? -angle : angle;
        change_bones(*context, deformer, bones,
                     [&](BoneChain& chain) { chain.turn(bone, about, turn); });
    });
}

lissom_status lissom_deformer_reach_with_bones(lissom_context* context, lissom_deformer deformer,
                                               int32_t bones, const double target[3],
                                               const double axis[3], double* distance) {
    return run(context, [&] {
        require_given(target, "target");
        require_given(axis, "axis");
        require_given(distance, "distance");
        const Vec3 place = context->space.to_kernel(target);
        ReachOptions options;
        options.axis = context->space.to_kernel(axis);
        if (context->space.mirrors()) options.axis = -options.axis;
        change_bones(*context, deformer, bones,
                     [&](BoneChain& chain) { *distance = chain.reach(place, options); });
    });
}

lissom_status lissom_deformer_move_bones(lissom_context* context, lissom_deformer deformer,
                                         int32_t bones, const double base[3]) {
    return run(context, [&] {
        require_given(base, "base");
        const Vec3 place = context->space.to_kernel(base);
        change_bones(*context, deformer, bones, [&](BoneChain& chain) { chain.set_base(place); });
    });
}

lissom_status lissom_deformer_follow_with_bones(lissom_context* context, lissom_deformer deformer,
                                                int32_t bones, const lissom_input* points,
                                                bool stretch, double twist) {
    return run(context, [&] {
        Deformer& own = boned_deformer(*context, deformer);
        const FramedCurve curve(read_points(points, context->space, "points"));
        follow(own, bones_with(own, HandleId{bones}), curve,
               {stretch, context->space.mirrors() ? -twist : twist});
    });
}

lissom_status lissom_deformer_carry_handle(lissom_context* context, lissom_deformer deformer,
                                           int32_t handle, const lissom_input* points, double start,
                                           double share, double twist) {
    return run(context, [&] {
        Deformer& own = boned_deformer(*context, deformer);
        const FramedCurve curve(read_points(points, context->space, "points"));
        require(std::isfinite(start) && std::isfinite(share), "a place on the curve is not finite",
                ErrorCode::not_finite);
        CarryOptions options;
        options.from = start < 0.0 ? curve.nearest(own.handle(HandleId{handle}).center)
                                   : start * curve.length();
        options.along = share * curve.length();
        options.twist = context->space.mirrors() ? -twist : twist;
        follow(own, HandleId{handle}, curve, options);
    });
}

lissom_status lissom_deformer_reset_bones(lissom_context* context, lissom_deformer deformer,
                                          int32_t bones) {
    return run(context, [&] {
        change_bones(*context, deformer, bones,
                     [](BoneChain& chain) { chain = BoneChain(chain.rest(), chain.limits()); });
    });
}

int32_t lissom_deformer_joint_count(lissom_context* context, lissom_deformer deformer,
                                    int32_t bones) {
    if (!context) return -1;
    return context->count([&] {
        return count_of(bones_with(boned_deformer(*context, deformer), HandleId{bones}).joints);
    });
}

lissom_status lissom_deformer_read_joints(lissom_context* context, lissom_deformer deformer,
                                          int32_t bones, const lissom_output* joints) {
    return run(context, [&] {
        const Deformer& own = boned_deformer(*context, deformer);
        const auto places = joints_of(own, bones_with(own, HandleId{bones}));
        write_points(joints, places.size(), "joints",
                     [&](std::size_t i) { return context->space.to_host(places[i]); });
    });
}

}  // extern "C"
