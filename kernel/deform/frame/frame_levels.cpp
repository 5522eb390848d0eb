// Preparation and frames on two levels.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/levels/level_method.h"
#include "kernel/deform/levels/thinned_surface.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/mesh/edit/triangulate.h"

namespace lissom {
namespace {

// A region of so many times the vertices of its thinned surface is worth two levels.
constexpr Index kWorthLevels = 4;

// The surface of a patch as triangles, in the patch's coordinates.
struct PatchSurface {
    Mesh mesh;
    /// The vertex of `mesh` that each local vertex is.
    std::vector<Index> vertex;
};

// A patch that is all of a triangle mesh keeps its topology.
PatchSurface whole_surface(const Patch& patch, const std::shared_ptr<const Topology>& topology,
                           const Context& context) {
    std::vector<Vec3> positions(at(topology->vertex_count()));
    for (Index v = 0; v < patch.mesh_count(); ++v) {
        positions[at(patch.mesh_vertex[at(v)])] = patch.rest[at(v)];
    }
    return {Mesh(std::move(positions), topology, context), patch.mesh_vertex};
}

PatchSurface part_surface(const Patch& patch, const Topology& topology, const Context& context) {
    PatchSurface surface;
    std::vector<Index> local(at(topology.vertex_count()), kNoIndex);
    for (Index v = 0; v < patch.mesh_count(); ++v) {
        local[at(patch.mesh_vertex[at(v)])] = v;
        surface.vertex.push_back(v);
    }
    std::vector<Index> numbers = patch.triangles.face;
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    FaceList faces;
    std::vector<Index> corners;
    for (const Index f : numbers) {
        corners.clear();
        for (const Index v : topology.face(f)) corners.push_back(local[at(v)]);
        faces.add(corners);
    }
    surface.mesh = Mesh({patch.rest.begin(), patch.rest.begin() + patch.mesh_count()},
                        std::move(faces), context);
    triangulate(surface.mesh, context);
    return surface;
}

PatchSurface patch_surface(const RestShape& rest, const Context& context) {
    const std::shared_ptr<const Topology>& topology = rest.region().topology();
    const bool whole = rest.patch().mesh_count() == topology->vertex_count();
    return whole && topology->is_triangle_mesh() ? whole_surface(rest.patch(), topology, context)
                                                 : part_surface(rest.patch(), *topology, context);
}

DeformOptions coarse_options(DeformOptions options) {
    options.level_vertices = 0;
    return options;
}

// A handle of the thinned surface that holds `vertices`.
std::shared_ptr<const Handle> thinned_handle(const RestShape& rest, std::vector<Index> vertices) {
    Handle handle{Region(rest.region().topology(), std::move(vertices)), {}};
    for (const Index v : handle.region.vertices()) handle.local.push_back(rest.local_vertex(v));
    handle.center = rest.center_of(handle);
    return std::make_shared<const Handle>(std::move(handle));
}

// Holds the vertices of the thinned surface as their owners do: handles, and all that rests.
std::shared_ptr<const ConstraintSet> thinned_constraints(const RestShape& rest, Index handles,
                                                         LevelMethod& levels) {
    std::vector<std::vector<Index>> held(at(handles) + 1);
    for (Index v = 0; v < levels.thinned.vertex_count(); ++v) {
        const Index owner = levels.owner[at(v)];
        if (owner != kFree) held[at(owner >= 0 ? owner : handles)].push_back(v);
    }
    auto constraints = std::make_shared<ConstraintSet>();
    levels.handles.resize(at(handles));
    for (Index h = 0; h <= handles; ++h) {
        if (held[at(h)].empty()) continue;
        if (h < handles) levels.handles[at(h)].value = count_of(constraints->handles);
        constraints->handles.push_back(thinned_handle(rest, std::move(held[at(h)])));
    }
    return constraints;
}

LevelMethod made_levels(const Preparation& next, const Context& context) {
    const RestShape& rest = *next.rest;
    const PatchSurface surface = patch_surface(rest, context);
    std::vector<Index> owner(surface.vertex.size());
    for (std::size_t v = 0; v < owner.size(); ++v) owner[at(surface.vertex[v])] = next.owner[v];
    ThinnedSurface thinned =
        thinned_surface(surface.mesh, owner, rest.options().level_vertices, context);
    LevelMethod levels;
    for (const Index v : thinned.from) levels.owner.push_back(owner[at(v)]);
    const std::vector<SurfaceFollow> follows = bind_surface(surface.mesh, thinned, context);
    for (const Index v : surface.vertex) levels.follows.push_back(follows[at(v)]);
    levels.thinned = std::move(thinned.mesh);
    const auto coarse =
        make_rest_shape(levels.thinned, Region::all(levels.thinned.shared_topology()),
                        coarse_options(rest.options()), context);
    levels.coarse = prepare_deformation(
        coarse, thinned_constraints(*coarse, count_of(next.constraints->handles), levels), context);
    const ImplicitMethod* method = levels.coarse->implicit();
    if (method && method->solution) method->solution->find_all_weights(context);
    return levels;
}

Poses coarse_poses(const LevelMethod& levels, const Poses& poses) {
    Poses coarse{
        std::vector<HandlePose>(constraints_of(*levels.coarse)->handles.size()), {}, poses.volume};
    for (std::size_t h = 0; h < levels.handles.size(); ++h) {
        if (levels.handles[h] == HandleId{}) continue;
        const HandlePose& pose = poses.handles[h];
        pose_handle(*levels.coarse, coarse, levels.handles[h], pose.local_transform, Vec3::Zero(),
                    pose.turn);
    }
    return coarse;
}

// Motions of the thinned surface, which at held vertices are those of their handles.
std::vector<Affine> level_motions(const Preparation& prepared, const Poses& poses,
                                  FrameScratch::State& scratch, FrameQuality quality,
                                  const Context& context) {
    const LevelMethod& levels = *prepared.levels();
    if (!scratch.coarse) scratch.coarse = std::make_unique<FrameScratch>();
    DeformFrame frame =
        solve_frame(levels.coarse, coarse_poses(levels, poses), *scratch.coarse, quality, context);
    const bool scales = prepared.rest->options().local_size == LocalSize::scale;
    std::vector<Affine> motions = surface_motions(levels.thinned, frame.positions, scales, context);
    for (std::size_t v = 0; v < motions.size(); ++v) {
        const Index owner = levels.owner[v];
        if (owner >= 0) motions[v] = poses.handles[at(owner)].local_transform;
        if (owner == kPinned || owner == kLoose) motions[v] = {};
    }
    scratch.coarse->recycle(std::move(frame));
    return motions;
}

}  // namespace

bool wants_levels(const DeformOptions& options, Index region_vertices) {
    return options.level_vertices > 0 && region_vertices / kWorthLevels >= options.level_vertices;
}

std::string refused_levels(const DeformOptions& options, const ConstraintSet& constraints) {
    if (options.transition > 0.0) return "a transition";
    if (options.loose == UnheldParts::follow) return "loose parts that follow";
    if (!constraints.targets.empty()) return "constraints of points";
    if (changes_patch(constraints, 0.0)) return "soft handles, points, falloffs and stiffness";
    const bool whole = std::all_of(
        constraints.handles.begin(), constraints.handles.end(),
        [](const auto& h) { return !h || (h->options.position && h->options.gradient); });
    return whole ? "" : "handles without position or gradient";
}

std::optional<LevelMethod> prepare_levels(const Preparation& next, const Context& context) {
    try {
        return made_levels(next, context);
    } catch (const Error& error) {
        const ErrorCode code = error.code();
        if (code == ErrorCode::cancelled || code == ErrorCode::memory_limit) throw;
        return std::nullopt;
    }
}

DeformFrame solve_levels(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                         FrameScratch::State& scratch, FrameQuality quality,
                         const Context& context) {
    const Preparation& prepared = *preparation;
    const Patch& patch = prepared.patch();
    const std::vector<SurfaceFollow>& follows = prepared.levels()->follows;
    const FrameInput motion(prepared, poses, target_rhs(preparation, poses.targets, scratch.asked));
    const std::vector<Affine> motions = level_motions(prepared, poses, scratch, quality, context);
    std::vector<Vec3> positions = std::exchange(scratch.positions, {});
    positions.resize(patch.of_region.size());
    for_each_part(context, count_of(positions), [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            const Index v = patch.of_region[at(row)];
            positions[at(row)] =
                patch.origin + followed(follows[at(v)], motions, patch.rest[at(v)]);
        }
    });
    return framed(preparation, motion, scratch, std::move(positions));
}

std::vector<Mat3> level_gradients(const Preparation& prepared, const Poses& poses,
                                  FrameScratch::State& scratch) {
    const std::vector<Affine> motions =
        level_motions(prepared, poses, scratch, FrameQuality::full, {});
    std::vector<Mat3> gradients;
    gradients.reserve(prepared.patch().of_region.size());
    for (const Index v : prepared.patch().of_region) {
        gradients.push_back(followed_linear(prepared.levels()->follows[at(v)], motions));
    }
    return gradients;
}

}  // namespace lissom
