#include "kernel/deform/description.h"

#include <Eigen/LU>
#include <utility>

#include "kernel/deform/constraint_edits.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rest_shape.h"

namespace lissom {
namespace {

MeshPoint point_of(const Patch& patch, const SparseRow& row) {
    MeshPoint point;
    for (const auto& [v, weight] : row) {
        point.vertices.push_back(patch.mesh_vertex[at(v)]);
        point.weights.push_back(weight);
    }
    return point;
}

HandleDescription describe(const Patch& patch, const Handle& handle, const HandlePose& pose) {
    HandleDescription result{{}, {}, handle.options, {}, handle.mirror, pose};
    for (const Index v : handle.local) result.vertices.push_back(patch.mesh_vertex[at(v)]);
    for (const SparseRow& row : handle.points) result.points.push_back(point_of(patch, row));
    if (handle.partner != kNoIndex) result.partner = HandleId{handle.partner};
    return result;
}

// Vertices at which points may hold something: those that the region moves or borders on.
void require_known(const RestShape& rest, const std::vector<Index>& vertices) {
    const auto& topology = *rest.region().topology();
    require_vertices(topology, vertices);
    for (const Index v : vertices) {
        if (rest.local_vertex(v) < rest.patch().mesh_count()) continue;
        throw Error(ErrorCode::handle_outside_region, "a handle reaches outside the region",
                    {ElementKind::vertex, 1, {v}});
    }
}

void require_held(const RestShape& rest, const HandleDescription& given) {
    require(given.options.position || given.options.gradient,
            "a handle must prescribe positions, gradients or both");
    require(!given.vertices.empty() || !given.points.empty(), "the handle has no vertices",
            ErrorCode::region_empty);
    require_known(rest, given.vertices);
    for (const Index v : given.vertices) {
        if (rest.region().contains(v)) continue;
        throw Error(ErrorCode::handle_outside_region, "a handle reaches outside the region",
                    {ElementKind::vertex, 1, {v}});
    }
    for (const MeshPoint& point : given.points) {
        (void)checked_point(*rest.region().topology(), point);
        require_known(rest, point.vertices);
    }
}

// Makes the handle again, with its vertices and points in their order.
Handle handle_from(const RestShape& rest, const HandleDescription& given) {
    require_held(rest, given);
    std::vector<Index> around = given.vertices;
    std::vector<Index> local;
    std::vector<SparseRow> rows;
    for (const Index v : given.vertices) local.push_back(rest.local_vertex(v));
    for (const MeshPoint& point : given.points) {
        around.insert(around.end(), point.vertices.begin(), point.vertices.end());
        SparseRow& row = rows.emplace_back();
        for (std::size_t i = 0; i < point.vertices.size(); ++i) {
            row.emplace_back(rest.local_vertex(point.vertices[i]), point.weights[i]);
        }
    }
    Handle handle{Region(rest.region().topology(), std::move(around)), given.options};
    handle.local = std::move(local);
    handle.points = std::move(rows);
    handle.mirror = given.mirror;
    if (given.partner) handle.partner = given.partner->value;
    handle.center = rest.center_of(handle);
    return handle;
}

// No vertex is held twice.
void require_apart(const RestShape& rest, const ConstraintSet& constraints) {
    std::vector<char> held(at(rest.patch().vertex_count), 0);
    Elements twice{ElementKind::vertex, 0, {}};
    for (const auto& handle : constraints.handles) {
        if (!handle) continue;
        for (const Index v : handle->local) {
            if (std::exchange(held[at(v)], 1)) twice.add(rest.patch().mesh_vertex[at(v)]);
        }
    }
    if (twice.count == 0) return;
    throw Error(ErrorCode::handle_overlap, "two handles hold the same vertices", std::move(twice));
}

void require_partners(const ConstraintSet& constraints) {
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        if (!constraints.handles[h] || constraints.handles[h]->partner == kNoIndex) continue;
        const Index partner = constraints.handles[h]->partner;
        const bool mutual = partner >= 0 && partner < count_of(constraints.handles) &&
                            constraints.handles[at(partner)] &&
                            constraints.handles[at(partner)]->partner == index_of(h);
        require(mutual, "the mirror image of a handle is not that of its image");
    }
}

void require_pose(const HandlePose& pose) {
    const bool finite =
        pose.transform.is_finite() && pose.local_transform.is_finite() && pose.turn.allFinite();
    require(finite && pose.transform.linear.determinant() != 0.0,
            "the transform of a handle flattens space or is not finite",
            ErrorCode::singular_transform);
}

std::shared_ptr<const std::vector<double>> stiffness_of(const RestShape& rest,
                                                        const std::vector<double>& factors) {
    if (factors.empty()) return nullptr;
    require(factors.size() == at(rest.region().size()),
            "a stiffness needs one factor for each vertex of the region");
    auto stiffness = std::make_shared<std::vector<double>>(at(rest.patch().real_count), 1.0);
    for (std::size_t row = 0; row < factors.size(); ++row) {
        require(factors[row] >= 1e-4 && factors[row] <= 1e5, "a stiffness is from 1e-4 to 1e5");
        (*stiffness)[at(rest.patch().of_region[row])] = factors[row];
    }
    return stiffness;
}

template <typename T>
std::size_t bytes_in(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

std::size_t bytes_in(const WeightedTriangles& triangles) {
    return bytes_in(triangles.triangle) + bytes_in(triangles.weight) + bytes_in(triangles.face);
}

std::optional<double> checked_volume(const std::optional<double>& share) {
    require(!share || (*share >= 0.0 && *share <= 1.0),
            "the share of the volume must be from 0 to 1");
    return share;
}

}  // namespace

DeformDescription describe(const DeformSnapshot& snapshot) {
    DeformDescription result;
    const Patch& patch = snapshot.rest->patch();
    const ConstraintSet& constraints = *snapshot.constraints;
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        auto& handle = result.handles.emplace_back();
        if (!constraints.handles[h]) continue;
        handle = describe(patch, *constraints.handles[h], snapshot.poses.handles[h]);
    }
    for (std::size_t t = 0; t < constraints.targets.size(); ++t) {
        const Target& target = *constraints.targets[t];
        PointConstraint& asked = result.constraints.emplace_back();
        asked.point = target.point;
        asked.weight = target.weight;
        if (target.position) asked.position = snapshot.poses.targets[t].position;
        if (target.gradient) asked.gradient = snapshot.poses.targets[t].gradient;
    }
    for (const auto& bones : constraints.bones) result.bones.push_back(*bones);
    if (constraints.stiffness) {
        for (const Index v : patch.of_region)
            result.stiffness.push_back((*constraints.stiffness)[at(v)]);
    }
    result.volume = snapshot.poses.volume;
    return result;
}

DeformSnapshot snapshot_of(const DeformDescription& description,
                           std::shared_ptr<const RestShape> rest) {
    ConstraintSet constraints;
    Poses poses;
    for (const auto& given : description.handles) {
        auto& handle = constraints.handles.emplace_back();
        HandlePose& pose = poses.handles.emplace_back();
        if (!given) continue;
        require_pose(given->pose);
        handle = std::make_shared<const Handle>(handle_from(*rest, *given));
        pose = given->pose;
    }
    require_apart(*rest, constraints);
    require_partners(constraints);
    constraints.stiffness = stiffness_of(*rest, description.stiffness);
    poses.volume = checked_volume(description.volume);
    ConstraintEdit edit{*rest, constraints, poses};
    for (const PointConstraint& asked : description.constraints) {
        edit.set_target(checked_target(*rest, constraints, asked),
                        {asked.position.value_or(Vec3(Vec3::Zero())),
                         asked.gradient.value_or(Mat3(Mat3::Identity()))});
    }
    for (const Bones& bones : description.bones) edit.add_bones(bones);
    auto shown = std::make_shared<const DeformFrame>(rest_frame(*rest));
    return {std::move(rest), std::make_shared<const ConstraintSet>(std::move(constraints)),
            std::move(poses), std::move(shown)};
}

std::shared_ptr<const RestShape> rest_of(const Deformer& deformer) {
    return DeformerAccess::state(deformer).rest;
}

const Region& region_of(const RestShape& rest) {
    return rest.region();
}
const DeformOptions& options_of(const RestShape& rest) {
    return rest.options();
}
const std::vector<Vec3>& positions_of(const RestShape& rest) {
    return rest.positions;
}

std::size_t memory_bytes(const RestShape& rest) {
    const WorkingPatch& work = *rest.work;
    const Patch& patch = work.patch;
    return bytes_in(rest.positions) + bytes_in(rest.region_row) + bytes_in(rest.surroundings) +
           bytes_in(patch.mesh_vertex) + bytes_in(patch.rest) + bytes_in(patch.of_region) +
           bytes_in(patch.in_region) + bytes_in(patch.on_boundary) + bytes_in(patch.triangles) +
           bytes_in(patch.split_triangles) + bytes_in(work.rings.begin) +
           bytes_in(work.rings.neighbor) + bytes_in(work.geometry.cotangent) +
           bytes_in(work.geometry.area) + bytes_in(work.geometry.normal) +
           bytes_in(work.laplacian.self) + bytes_in(work.laplacian.neighbor) +
           bytes_in(work.laplacian.weight);
}

std::size_t memory_bytes(const ConstraintSet& constraints) {
    std::size_t bytes = constraints.stiffness ? bytes_in(*constraints.stiffness) : 0;
    for (const auto& handle : constraints.handles) {
        if (!handle) continue;
        bytes += sizeof *handle + 2 * bytes_in(handle->local);
        for (const SparseRow& row : handle->points) bytes += sizeof(SparseRow) + 2 * bytes_in(row);
    }
    for (const auto& target : constraints.targets)
        bytes += sizeof *target + 2 * bytes_in(target->row);
    for (const auto& bones : constraints.bones) {
        bytes += sizeof *bones + bytes_in(bones->joints) + bytes_in(bones->limits) +
                 bytes_in(bones->handles);
    }
    return bytes;
}

std::size_t memory_bytes(const DeformFrame& result) {
    return bytes_in(result.positions) + bytes_in(result.inserted) +
           bytes_in(result.turns_without_faces) +
           (result.gradients ? bytes_in(*result.gradients) : 0);
}

}  // namespace lissom
