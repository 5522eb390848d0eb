// The first system alone: as a basis of the handles' transforms, and by its factor.
#include <algorithm>

#include "kernel/core/extended.h"
#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/handle_basis.h"

namespace lissom {
namespace {

// Positions of the region's vertices for deviations `from` the base transform: displaced vertices
// come back by v = M (v - v') + v' (section 2.4.3).
std::vector<Vec3> pulled_back(const FrameInput& motion, const std::vector<Vec3>& from) {
    const Patch& patch = motion.patch();
    const GradientStencils& g = motion.method().gradients;
    std::vector<Vec3> at = from;
    for (const Index i : g.displaced) {
        if (!g.defined[i]) continue;
        at[i] +=
            g.gather(motion.prepared().rings(), from, i) * (patch.rest[i] - g.displaced_rest[i]);
    }
    std::vector<Vec3> result;
    for (const Index v : patch.of_region) {
        result.push_back(at[v] + (motion.base() * homogeneous(patch.rest[v])).head<3>() +
                         patch.origin);
    }
    return result;
}

// Solves for the deviation from the base transform of the rest shape, which the system maps to
// itself: the rounding of its entries then acts on the deviation only.
std::vector<Vec3> solved_directly(const FrameInput& motion) {
    const Preparation& prepared = motion.prepared();
    const GradientSystem& first = *motion.method().first;
    const Mat3 base_gradient = motion.base_linear();
    std::vector<Vec3> x(motion.patch().vertex_count, Vec3::Zero());
    for (Index v = 0; v < motion.patch().vertex_count; ++v) {
        if (prepared.known.position[v]) x[v] = motion.known_deviation(v);
    }
    const std::vector<Index>& free = first.free_vertices();
    const std::size_t rows = free.size();
    if (rows == 0) return pulled_back(motion, x);
    std::vector<Extended> b(3 * rows);
    for (int d = 0; d < 3; ++d) {
        first.right_hand_side(
            [&](Index k) { return x[k][d]; },
            [&](Index k) -> Vec3 {
                return (motion.known_gradient(k) - base_gradient).row(d).transpose();
            },
            b.data() + d * rows);
    }
    std::vector<double> y = first.solve(b, 3);
    for (int d = 0; d < 3; ++d) {
        first.enforce_ties([&](Index k) { return x[k][d]; }, std::span(y).subspan(d * rows, rows));
    }
    for (std::size_t r = 0; r < rows; ++r) x[free[r]] = {y[r], y[rows + r], y[2 * rows + r]};
    return pulled_back(motion, x);
}

std::vector<Vec4>& weights_of(HandleBasis& basis, Index handle) {
    const auto place = std::find(basis.handles.begin(), basis.handles.end(), HandleId{handle});
    return basis.weights[place - basis.handles.begin()];
}

void add_known(const FrameInput& motion, HandleBasis& basis) {
    const Preparation& prepared = motion.prepared();
    const RestShape& rest = *prepared.rest;
    for (Index row = 0; row < rest.region().size(); ++row) {
        const Index v = rest.patch().of_region[row], owner = prepared.owner[v];
        if (!prepared.known.position[v]) continue;
        if (owner == kLoose) continue;
        if (owner >= 0) {
            weights_of(basis, owner)[row] = homogeneous(rest.positions[row]);
        } else {
            basis.fixed[row] = motion.known_position(v) + rest.origin();
        }
    }
}

// Loose parts stay, or go with the handle that holds all that is near them.
void add_loose(const FrameInput& motion, HandleBasis& basis) {
    const Preparation& prepared = motion.prepared();
    const RestShape& rest = *prepared.rest;
    for (const Index row : prepared.resting_rows) basis.fixed[row] = rest.positions[row];
    for (const FollowingPart& part : prepared.following) {
        if (part.owner < 0) continue;
        for (const Index v : part.members) {
            const Index row = rest.frame_row(prepared.patch(), v);
            if (row == kNoIndex || row >= rest.region().size()) continue;
            basis.fixed[row].setZero();
            weights_of(basis, part.owner)[row] = homogeneous(rest.positions[row]);
        }
    }
}

// The affine map of the patch by which a part follows its guides: their mean, and the mean of their
// gradients. Unlike the nearest rotation it is linear in the handles' transforms.
Affine affine_follow(const FrameInput& motion, const FollowingPart& part,
                     std::span<const Vec4> deviation) {
    const double share = 1.0 / static_cast<double>(part.guides.size());
    Vec3 before = Vec3::Zero(), after = Vec3::Zero();
    Affine map;
    map.linear.setZero();
    for (const Index v : part.guides) {
        const Vec3& rest = motion.patch().rest[at(v)];
        before += share * rest;
        after +=
            share * ((motion.base() * homogeneous(rest)).head<3>() + deviation[at(v)].head<3>());
        map.linear += share * gradient_of(motion, deviation, v);
    }
    map.translation = after - map.linear * before;
    return map;
}

// The maps of the parts that follow a surface if the handles stand at `transforms`, in the space of
// the mesh.
std::vector<Affine> affine_follows(const FrameInput& given, const std::vector<Affine>& transforms,
                                   const Context& context) {
    const Preparation& prepared = given.prepared();
    const Vec3& o = prepared.patch().origin;
    Poses poses = given.poses();
    for (std::size_t h = 0; h < poses.handles.size(); ++h) {
        const Affine& t = transforms[h];
        poses.handles[h] = {t, {t.linear, t.translation + t.linear * o - o}, Vec3::Zero()};
    }
    const FrameInput motion(prepared, poses, given.asked());
    Deviation deviation;
    solve_first(motion, context, deviation);
    std::vector<Affine> maps;
    for (const FollowingPart& part : prepared.following) {
        if (part.owner == kFree) {
            const Affine map = affine_follow(motion, part, deviation);
            maps.push_back({map.linear, map.translation + o - map.linear * o});
        }
    }
    return maps;
}

template <typename Use>
void for_each_follower_row(const Preparation& prepared, const Use& use) {
    std::size_t n = 0;
    for (const FollowingPart& part : prepared.following) {
        if (part.owner != kFree) continue;
        for (const Index v : part.members) {
            const Index row = prepared.rest->frame_row(prepared.patch(), v);
            if (row != kNoIndex && row < prepared.rest->region().size()) use(n, row);
        }
        ++n;
    }
}

// The maps of parts that follow a surface are linear in each transform, so that unit transforms
// tell their weights.
void add_followers(const FrameInput& motion, const Context& context, HandleBasis& basis) {
    const Preparation& prepared = motion.prepared();
    const std::vector<Vec3>& rest = prepared.rest->positions;
    const Affine zero{Mat3::Zero(), Vec3::Zero()};
    std::vector<Affine> transforms(motion.poses().handles.size(), zero);
    const std::vector<Affine> fixed = affine_follows(motion, transforms, context);
    if (fixed.empty()) return;
    for_each_follower_row(prepared, [&](std::size_t n, Index row) {
        basis.fixed[at(row)] = fixed[n](rest[at(row)]);
    });
    for (const HandleId handle : basis.handles) {
        Affine& unit = transforms[at(handle.value)];
        for (Index column = 0; column < 4; ++column) {
            unit = zero;
            (column < 3 ? unit.linear(0, column) : unit.translation[0]) = 1.0;
            const std::vector<Affine> moved = affine_follows(motion, transforms, context);
            for_each_follower_row(prepared, [&](std::size_t n, Index row) {
                const Vec3& p = rest[at(row)];
                weights_of(basis, handle.value)[at(row)][column] = (moved[n](p) - fixed[n](p))[0];
            });
        }
        unit = zero;
    }
}

// Weights and fixed part leave the coordinates of the patch: for a transform [L t] of the mesh's
// space the patch sees [L, L o + t - o].
void add_free(const FrameInput& motion, HandleBasis& basis) {
    const RestShape& rest = *motion.prepared().rest;
    const Vec3& o = rest.origin();
    const LinearSolution& solution = motion.solution();
    const std::vector<Index>& free = motion.method().first->free_vertices();
    for (std::size_t f = 0; f < free.size(); ++f) {
        const Index row = motion.method().frame_row[f];
        if (row == kNoIndex || row >= rest.region().size()) continue;
        Vec4 rest_part = homogeneous(motion.patch().rest[free[f]] + o);
        for (std::size_t h = 0; h < solution.handles().size(); ++h) {
            Vec4 w = solution.weight(h, index_of(f));
            w.head<3>() += w[3] * o;
            weights_of(basis, solution.handles()[h])[row] = w;
            rest_part -= w;
        }
        basis.fixed[row] = solution.fixed(motion.asked().fixed, index_of(f));
        if (solution.base() == kNoIndex) {
            basis.fixed[row] += rest_part.head<3>();
        } else {
            weights_of(basis, solution.base())[row] = rest_part;
        }
    }
}

}  // namespace

std::vector<Vec3> solve_first_directly(Deformer& deformer, const Context& given) {
    auto& s = DeformerAccess::state(deformer);
    const Context& context = s.chosen(given);
    require_whole_surface(s.options(), "the first system");
    return with_memory_errors([&] {
        const auto& prepared = s.prepare(context);
        const TargetRhs& asked = target_rhs(prepared, s.poses.targets, s.scratch.state().asked);
        return solved_directly(FrameInput(*prepared, s.poses, asked));
    });
}

HandleBasis basis_of(Deformer& deformer, const Context& given) {
    auto& s = DeformerAccess::state(deformer);
    const Context& context = s.chosen(given);
    require_whole_surface(s.options(), "the handle basis");
    return with_memory_errors([&] {
        const auto& prepared = s.prepare(context);
        const TargetRhs& asked = target_rhs(prepared, s.poses.targets, s.scratch.state().asked);
        const FrameInput motion(*prepared, s.poses, asked);
        HandleBasis basis;
        basis.vertices = s.rest->region().vertices();
        basis.handles = deformer.handles();
        const std::size_t rows = basis.vertices.size();
        basis.fixed.assign(rows, Vec3::Zero());
        basis.weights.assign(basis.handles.size(), std::vector<Vec4>(rows, Vec4::Zero()));
        add_known(motion, basis);
        add_loose(motion, basis);
        if (motion.method().solution) {
            motion.solution().find_all_weights(context);
            add_free(motion, basis);
            add_followers(motion, context, basis);
        }
        return basis;
    });
}

}  // namespace lissom
