// What changes the rest shape of a Deformer, or lets go of a preparation.
#include "kernel/deform/deformer_state.h"

namespace lissom {

void Deformer::State::drop_prepared() {
    if (prepared) find_gradients();
    prepared.reset();
}

// The patch keeps its faces and numbers; what is around the region stays.
void Deformer::State::rebase() {
    drop_prepared();
    directions.rebase(region, positions, turns_without_faces());
    const Patch& before = rest_patch->patch;
    std::vector<Vec3> at(static_cast<std::size_t>(region.topology()->vertex_count()), Vec3::Zero());
    for (Index i = 0; i < before.real_count; ++i) {
        at[before.mesh_vertex[i]] = before.rest[i] + before.origin;
    }
    rest = positions;
    for (Index row = 0; row < region.size(); ++row) at[region.vertices()[row]] = rest[row];
    rest_patch = std::make_shared<WorkingPatch>(
        build_patch(region, at, kPatchRings, before.mesh_vertex), options);
    number_rows();
    for (HandleState& handle : handles) {
        if (handle.removed) continue;
        handle.set_at_rest();
        handle.center = center_of(handle);
    }
    // Whatever a constraint holds stays where it is now.
    for (auto& [v, constraint] : constraints) {
        if (constraint.position) constraint.position = rest[region_row[v]];
        if (constraint.gradient) constraint.gradient = Mat3::Identity();
    }
    for (PointState& point : points) {
        if (point.asked.position) {
            point.asked.position = rest_position(point.row) + rest_patch->patch.origin;
        }
        if (point.asked.gradient) point.asked.gradient = Mat3::Identity();
    }
    to_rest();
}

void Deformer::rebase() {
    state_->rebase();
}

}  // namespace lissom
