#include "kernel/deform/frame/frame_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

VertexConstraint constraint_of(const Target& target, const TargetPose& pose) {
    VertexConstraint constraint{target.point.vertices.front(), {}, {}, {}};
    if (target.position) constraint.position = pose.position;
    if (target.gradient) constraint.gradient = pose.gradient;
    return constraint;
}

VertexConstraints asked_of(const Preparation& prepared, const std::vector<TargetPose>& poses) {
    const auto& targets = prepared.constraints->targets;
    VertexConstraints asked;
    for (std::size_t t = 0; t < targets.size(); ++t) {
        if (!targets[t]->is_hard_vertex()) continue;
        asked[targets[t]->row.front().first] = constraint_of(*targets[t], poses[t]);
    }
    for (const auto& [v, number] : prepared.asked) {
        VertexConstraint constraint = constraint_of(*targets[number], poses[number]);
        constraint.vertex = v;
        const bool anchor = v >= prepared.patch().surface_count;
        if (!anchor) constraint.position.reset();
        asked[v] = constraint;
    }
    return asked;
}

}  // namespace

TargetRhs target_rhs(const Preparation& prepared, const std::vector<TargetPose>& targets) {
    TargetRhs part{asked_of(prepared, targets), {}};
    const ImplicitMethod* method = prepared.implicit();
    if (method && method->solution) {
        part.fixed = method->solution->fixed_part(prepared.problem(), part.at);
    }
    return part;
}

FrameInput::FrameInput(const Preparation& prepared, const Poses& poses, const TargetRhs& asked,
                       std::vector<Mat4> room)
    : prepared_(prepared),
      poses_(poses),
      asked_(asked),
      base_(matrix_of({})),
      differences_(std::move(room)) {
    differences_.clear();
    const ImplicitMethod* method = prepared.implicit();
    if (!method || !method->solution) return;
    const LinearSolution& solution = *method->solution;
    if (solution.base() != kNoIndex) base_ = matrix_of(pose(solution.base()).local_transform);
    for (const Index h : solution.handles()) {
        differences_.push_back(matrix_of(pose(h).local_transform) - base_);
    }
}

Vec3 FrameInput::known_position(Index v) const {
    const Index o = prepared_.owner[v];
    if (o >= 0) return pose(o).local_transform(patch().rest[v]);
    if (o == kConstrained && asked_.at.at(v).position) {
        return *asked_.at.at(v).position - patch().origin;
    }
    return patch().rest[v];
}

Vec3 FrameInput::known_deviation(Index v) const {
    const Index o = prepared_.owner[v];
    const Vec4 rest_point = homogeneous(patch().rest[v]);
    if (o < 0) return known_position(v) - (base_ * rest_point).head<3>();
    return ((matrix_of(pose(o).local_transform) - base_) * rest_point).head<3>();
}

Mat3 FrameInput::known_gradient(Index v) const {
    const Index o = prepared_.owner[v];
    if (o >= 0) return pose(o).local_transform.linear;
    if (o != kConstrained) return Mat3::Identity();
    return asked_.at.at(v).gradient.value_or(Mat3(Mat3::Identity()));
}

void FrameInput::add_relative_turns(std::vector<Vec4>& turns) const {
    const bool based = solution().base() != kNoIndex;
    const Mat3 base =
        based ? pose(solution().base()).local_transform.linear : Mat3(Mat3::Identity());
    const Vec3 base_turn = based ? pose(solution().base()).turn : Vec3(Vec3::Zero());
    const Mat3 back = nearest_rotation(base).transpose();
    for (const Index h : solution().handles()) {
        Vec4 relative;
        const Mat3& linear = pose(h).local_transform.linear;
        relative.head<3>() = turn_near(nearest_rotation(linear) * back, pose(h).turn - base_turn);
        relative[3] = std::log(uniform_scale(linear) / uniform_scale(base));
        turns.push_back(relative);
    }
}

void FrameInput::find_relative_turns(std::vector<Vec4>& turns) const {
    turns.clear();
    add_relative_turns(turns);
}

double FrameInput::max_turn(std::vector<Vec4>& turns) const {
    if (!method().solution || !options().scale_free) return 0.0;
    turns.assign(1, Vec4::Zero());
    add_relative_turns(turns);
    double greatest = 0.0;
    for (const Vec4& a : turns) {
        for (const Vec4& b : turns) greatest = std::max(greatest, (a - b).head<3>().norm());
    }
    return greatest;
}

void FrameInput::spread(const std::vector<Vec4>& value, std::vector<Vec4>& field,
                        const Context& context) const {
    const std::vector<Index>& free = method().first->free_vertices();
    field.assign(patch().vertex_count, Vec4::Zero());
    for (std::size_t n = 0; n < value.size(); ++n) {
        for (const Index v : prepared_.held[solution().handles()[n]]) {
            if (prepared_.known.position[v]) field[v] = value[n];
        }
    }
    for_each_block(context, count_of(free), [&](Index begin, Index end) {
        for (std::size_t n = 0; n < value.size(); ++n) {
            if (value[n].isZero(0.0)) continue;
            const std::vector<Vec4>& weight = solution().row_weights(n);
            for (Index row = begin; row < end; ++row) {
                field[free[row]] += weight[row][3] * value[n];
            }
        }
    });
}

void FrameInput::add_asked_moves(std::vector<Vec4>& field) const {
    if (asked_.at.empty()) return;
    for (const auto& entry : asked_.at) field[entry.first] += padded(known_deviation(entry.first));
    const std::vector<Index>& free = method().first->free_vertices();
    for (std::size_t row = 0; row < free.size(); ++row) {
        field[free[row]] += padded(asked_.fixed.at(index_of(row)));
    }
}

}  // namespace lissom
