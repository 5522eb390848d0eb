#include "kernel/deform/frame/displaced_frame.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "kernel/deform/rest_shape.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Rotations that change by more than this are followed less, and by twice as much not at all, as in
// refinements: the surface has folded there.
constexpr double kFittedTurn = 40.0 * kPi / 180.0;

}  // namespace

DisplacedFrame::DisplacedFrame(const Preparation& prepared, const DeformFrame& frame,
                               const Context& context)
    : prepared_(prepared),
      system_(*prepared.implicit()->second),
      free_row_(at(prepared.patch().vertex_count), kNoIndex),
      turning_(prepared.implicit()->gathered),
      displacement_(at(prepared.patch().vertex_count), Vec4::Zero()),
      turned_(displacement_),
      change_(at(prepared.patch().real_count), PaddedMat3::Zero()) {
    const std::vector<Index>& averaged = prepared.implicit()->averaged;
    turning_.insert(turning_.end(), averaged.begin(), averaged.end());
    const std::vector<Index>& free = system_.free_vertices();
    for (std::size_t r = 0; r < free.size(); ++r) free_row_[at(free[r])] = index_of(r);
    take_shape(frame);
    fit(fitted_, context);
}

void DisplacedFrame::take_shape(const DeformFrame& frame) {
    const Patch& patch = prepared_.patch();
    const RestShape& rest = *prepared_.rest;
    const Index own = rest.region().size();
    shape_.resize(at(patch.real_count));
    for (Index v = 0; v < patch.real_count; ++v) {
        const Index row = rest.frame_row(patch, v);
        if (row == kNoIndex) {
            shape_[at(v)] = padded(patch.rest[at(v)]);
        } else {
            const Vec3& place =
                row < own ? frame.positions[at(row)] : frame.inserted[at(row - own)];
            shape_[at(v)] = padded(Vec3(place - patch.origin));
        }
    }
}

Index DisplacedFrame::free_vertex(Index mesh_vertex) const {
    const std::vector<Index>& region = prepared_.rest->region().vertices();
    const auto place = std::lower_bound(region.begin(), region.end(), mesh_vertex);
    if (place == region.end() || *place != mesh_vertex) return kNoIndex;
    const Index v = prepared_.patch().of_region[at(index_of(place - region.begin()))];
    return free_row(v) != kNoIndex ? v : kNoIndex;
}

void DisplacedFrame::answer(std::span<const Vec3> force, std::span<Vec4> x,
                            const Context& context) {
    system_.answer(force, x, scratch_, context);
}

void DisplacedFrame::forget_turns() {
    turned_.assign(turned_.size(), Vec4::Zero());
}

// The rotations that fit the displaced surface best.
void DisplacedFrame::fit(std::vector<Mat3>& rotations, const Context& context) const {
    std::vector<Vec4> x(shape_);
    for (std::size_t v = 0; v < x.size(); ++v) x[v] += displacement_[v];
    rotations.resize(turning_.size());
    const EnergyLoop loop = system_.energy();
    for_each_block(context, count_of(turning_), [&](Index begin, Index end) {
        const auto count = at(end - begin);
        Mat3* const m = rotations.data() + begin;
        loop.fit(x.data(), turning_.data(), m, begin, end);
        nearest_rotations({m, count}, {m, count});
    });
}

void DisplacedFrame::turn(const Context& context) {
    std::vector<Mat3> fitted;
    fit(fitted, context);
    const Mat3 base = Mat3::Identity();
    for (std::size_t i = 0; i < turning_.size(); ++i) {
        const Eigen::AngleAxisd change(Mat3(fitted[i] * fitted_[i].transpose()));
        const double sure = 1.0 - smooth_step((change.angle() - kFittedTurn) / kFittedTurn);
        const Mat3 by = rotation_of_turn(sure * change.angle() * change.axis()) - base;
        change_[at(turning_[i])] = padded_columns(by * fitted_[i]);
    }
    forget_turns();
    system_.solve(change_, turned_, false, scratch_, context);
}

void DisplacedFrame::displace(DeformFrame& frame) const {
    const Patch& patch = prepared_.patch();
    const RestShape& rest = *prepared_.rest;
    const Index own = rest.region().size();
    for (const Index v : system_.free_vertices()) {
        const Index row = v < patch.real_count ? rest.frame_row(patch, v) : kNoIndex;
        if (row == kNoIndex) continue;
        Vec3& place = row < own ? frame.positions[at(row)] : frame.inserted[at(row - own)];
        place += displacement_[at(v)].head<3>();
    }
}

}  // namespace lissom
