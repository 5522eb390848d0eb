#include "kernel/deform/rest_shape.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Rings around the region that the stencils of its vertices reach.
constexpr Index kPatchRings = 1;

// Distance from the origin, in sizes of a mesh, that costs three digits of its coordinates.
constexpr double kFarAway = 1e3;

// Vertices around the region that have moved by less than this fraction of its size count as
// unmoved: no tear would be seen.
constexpr double kMoved = 1e-6;

// Memory of a rest shape for each vertex of the region, its construction included.
constexpr std::size_t kBytesPerVertex = 800;

// Measures the patch.
void measure(RestShape& rest) {
    const Patch& patch = rest.patch();
    const Region& region = rest.region();
    rest.region_row.assign(patch.vertex_count, kNoIndex);
    for (Index row = 0; row < region.size(); ++row) {
        rest.region_row[patch.of_region[row]] = row;
        rest.size = std::max(rest.size, patch.rest[patch.of_region[row]].norm());
    }
    rest.far_away = patch.origin.norm() > kFarAway * rest.size;
}

void write(const RestShape& rest, std::span<const Vec3> positions,
           const std::vector<Mat3>& turns_without_faces, Mesh& mesh) {
    require_same_topology(mesh, rest.region().topology(), "the deformer");
    require_surroundings(rest, mesh);
    const std::span<Vec3> out = mesh.edit_positions();
    for (Index row = 0; row < rest.region().size(); ++row) {
        out[rest.region().vertices()[row]] = positions[row];
    }
    rest.directions.apply_to(mesh, turns_without_faces);
}

std::vector<Mat3> no_turns(const RestShape& rest) {
    return std::vector<Mat3>(rest.directions.without_faces().size(), Mat3::Identity());
}

}  // namespace

std::shared_ptr<const RestShape> make_rest_shape(const Mesh& mesh, const Region& region,
                                                 const DeformOptions& options,
                                                 const Context& context) {
    context.checkpoint();
    MemoryHold hold(context.memory(), "the region of a deformation");
    hold.resize(at(region.size()) * kBytesPerVertex);
    auto scope = std::make_shared<DeformScope>(DeformScope{region, options});
    std::vector<Index> order = near_order(region, kPatchRings);
    context.checkpoint();
    Patch patch_at_rest = build_patch(region, mesh.positions(), kPatchRings, std::move(order));
    context.checkpoint();
    auto work = std::make_shared<WorkingPatch>(std::move(patch_at_rest), options);
    context.checkpoint();
    auto rest = std::make_shared<RestShape>(RestShape{
        std::move(scope), std::move(work), {}, {}, 0.0, false, RestDirections(mesh, region), {}});
    context.checkpoint();
    for (const Index v : region.vertices()) rest->positions.push_back(mesh.position(v));
    const Patch& patch = rest->patch();
    for (Index i = 0; i < patch.mesh_count(); ++i) {
        const Index v = patch.mesh_vertex[i];
        if (!patch.in_region[i]) rest->surroundings.emplace_back(v, mesh.position(v));
    }
    if (options.refine > 0 && region.size() < mesh.vertex_count()) {
        rest->beyond.assign(mesh.positions().begin(), mesh.positions().end());
        hold.resize(at(region.size()) * kBytesPerVertex + rest->beyond.size() * sizeof(Vec3));
    }
    measure(*rest);
    rest->hold = std::move(hold);
    return rest;
}

// The patch keeps its faces and numbers; vertices around the region stay.
std::shared_ptr<const RestShape> rebased(const RestShape& rest, const DeformFrame& frame) {
    require_frame(rest, frame);
    const Patch& before = rest.patch();
    const Region& region = rest.region();
    MemoryHold hold = rest.hold;
    auto next = std::make_shared<RestShape>(RestShape{
        rest.scope, nullptr, {}, frame.positions, 0.0, false, rest.directions, rest.surroundings});
    next->beyond = rest.beyond;
    next->directions.rebase(region, frame.positions, frame.turns_without_faces);
    std::vector<Vec3> at(region.topology()->vertex_count(), Vec3::Zero());
    for (Index i = 0; i < before.real_count; ++i) {
        at[before.mesh_vertex[i]] = before.rest[i] + before.origin;
    }
    for (Index row = 0; row < region.size(); ++row) {
        at[region.vertices()[row]] = frame.positions[row];
    }
    next->work = std::make_shared<WorkingPatch>(
        build_patch(region, at, kPatchRings, before.mesh_vertex), rest.options());
    measure(*next);
    next->hold = std::move(hold);
    return next;
}

Index RestShape::local_vertex(Index mesh_vertex) const {
    const std::vector<Index>& ids = region().vertices();
    const auto place = std::lower_bound(ids.begin(), ids.end(), mesh_vertex);
    if (place != ids.end() && *place == mesh_vertex) {
        return patch().of_region[place - ids.begin()];
    }
    const std::vector<Index>& all = patch().mesh_vertex;
    return index_of(std::find(all.begin(), all.end(), mesh_vertex) - all.begin());
}

Vec3 RestShape::position_of(const SparseRow& row) const {
    Vec3 at = Vec3::Zero();
    for (const auto& [v, c] : row) at += c * patch().rest[v];
    return at;
}

Vec3 RestShape::center_of(const Handle& handle) const {
    const double count = handle.points.size() + handle.local.size();
    Vec3 center = Vec3::Zero();
    for (const Index v : handle.local) center += patch().rest[v] / count;
    for (const SparseRow& row : handle.points) center += position_of(row) / count;
    return center + origin();
}

Index RestShape::frame_row(const Patch& of, Index v) const {
    if (v < of.mesh_count()) return region_row[v];
    return v < of.real_count ? region().size() + v - of.mesh_count() : kNoIndex;
}

void require_surroundings(const RestShape& rest, const Mesh& mesh) {
    Elements moved{ElementKind::vertex, 0, {}};
    for (const auto& [v, at] : rest.surroundings) {
        if (!((mesh.position(v) - at).norm() <= kMoved * rest.size)) moved.add(v);
    }
    if (moved.count == 0) return;
    const std::string names = describe(moved);
    throw Error(ErrorCode::topology_mismatch,
                "the mesh has changed around the region since the deformation was made, at " +
                    names +
                    "; the result would tear there. Make a new deformation, or undo the change",
                std::move(moved));
}

void require_frame(const RestShape& rest, const DeformFrame& frame) {
    const auto require_as_many = [](std::size_t given, std::size_t expected, const char* what) {
        if (given == expected) return;
        throw Error(ErrorCode::invalid_argument,
                    "the frame is of another deformation: it has " + std::to_string(given) + " " +
                        what + ", but the region has " + std::to_string(expected));
    };
    require_as_many(frame.positions.size(), rest.positions.size(), "positions");
    require_as_many(frame.turns_without_faces.size(), rest.directions.without_faces().size(),
                    "vertices without faces");
}

void write_frame(const RestShape& rest, const DeformFrame& frame, Mesh& mesh) {
    require_frame(rest, frame);
    write(rest, frame.positions, frame.turns_without_faces, mesh);
}

void write_rest(const RestShape& rest, Mesh& mesh) {
    write(rest, rest.positions, no_turns(rest), mesh);
}

DeformFrame rest_frame(const RestShape& rest) {
    DeformFrame frame;
    frame.positions = rest.positions;
    frame.turns_without_faces = no_turns(rest);
    frame.gradients.emplace(rest.positions.size(), Mat3::Identity());
    return frame;
}

}  // namespace lissom
