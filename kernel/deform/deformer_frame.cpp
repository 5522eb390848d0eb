// The frames of a drag: what Deformer::State does with a preparation.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// How far beyond the rotations that fit best a refinement goes, in steps from the last ones: far in
// all steps but the last, which takes back what went too far. Two such steps lower the energy as
// four or five without would.
constexpr double kFurther = 1.6;
constexpr double kLastFurther = 0.5;

// Rotations that a refinement would change by more than this are followed less, and by twice as
// much not at all: there the surface has caved in or folded, no rotation fits, and going after the
// best one would fold it further or unwind what was asked for.
constexpr double kSureChange = 25.0 * kPi / 180.0;

// Where handles change the size of the surface by this logarithm or more, nothing is refined: no
// rotation fits, and the best one would trade stretch for a moat beside the handle.
constexpr double kSizeChange = 0.05;
// While it lives the handles stand as they are shown; then, after an error too, as they were asked
// to.
class ShownPoses {
  public:
    ShownPoses(std::vector<HandleState>& handles, std::vector<Affine>& shown)
        : handles_(handles), shown_(shown) {
        exchange();
    }
    ~ShownPoses() { exchange(); }
    ShownPoses(const ShownPoses&) = delete;
    ShownPoses& operator=(const ShownPoses&) = delete;

  private:
    void exchange() {
        for (std::size_t h = 0; h < shown_.size(); ++h) std::swap(handles_[h].in_patch, shown_[h]);
    }

    std::vector<HandleState>& handles_;
    std::vector<Affine>& shown_;
};

}  // namespace

// ---- First system

void Deformer::State::preview(const Context& context) {
    prepare(context);
    if (at_rest()) return to_rest();
    if (prepared->comparison) return solve_comparison(context);
    next_positions.resize(rest.size() + prepared->work->patch.inserted.size());
    if (prepared->solution) {
        const LinearSolution& solution = *prepared->solution;
        const Mat4 shift = base_transform() - matrix_of({});
        const std::vector<Mat4> differences = this->differences();
        const Vec3& origin = rest_patch->patch.origin;
        for_each_block(context, solution.rows(), [&](Index begin, Index end) {
            std::array<Vec4, kFrameBlock> x;
            solution.positions(shift, differences, x.data(), begin, end);
            for (Index row = begin; row < end; ++row) {
                const Index target = prepared->frame_row[row];
                if (target != kNoIndex) next_positions[target] = x[row - begin].head<3>() + origin;
            }
        });
    }
    show_next();
}

void Deformer::State::evaluate_deviation(const Context& context) {
    const Patch& patch = prepared->work->patch;
    frame_base = base_transform();
    deviation.assign(static_cast<std::size_t>(patch.vertex_count), Vec4::Zero());
    for (std::size_t h = 0; h < handles.size(); ++h) {
        const Mat4 difference = matrix_of(handles[h].in_patch) - frame_base;
        for (const Index v : prepared->held[h])
            deviation[v] = difference * homogeneous(patch.rest[v]);
    }
    for (const auto& entry : asked) deviation[entry.first] = padded(known_deviation(entry.first));
    for (Index v = patch.surface_count; v < patch.vertex_count; ++v) {
        deviation[v] = padded(known_deviation(v));
    }
    if (!prepared->solution) return;
    const std::vector<Index>& free = prepared->first->free_vertices();
    const std::vector<Mat4> differences = this->differences();
    for_each_block(context, static_cast<Index>(free.size()), [&](Index begin, Index end) {
        std::array<Vec4, kFrameBlock> x;
        prepared->solution->deviations(differences, x.data(), begin, end);
        for (Index row = begin; row < end; ++row) deviation[free[row]] = x[row - begin];
    });
}

// ---- Deformation gradients

// M_i after the first system, or what `part` of it leads to; where it does not exist, the mean of
// those around it.
Mat3 Deformer::State::gradient_of(Index v, const TurnPart* part) const {
    if (prepared->known.gradient[v]) return known_gradient(v);
    const Mat3 base = frame_base.topLeftCorner<3, 3>();
    const Vec4* x = part ? part->deviation.data() : deviation.data();
    const auto gathered = [&](Index u) -> Mat3 {
        if (prepared->known.gradient[u]) return known_gradient(u);
        Mat3 m;
        prepared->gradient_loop().gather(&u, x, &m, 0, 1);
        m += base;
        if (part) turn_on(*part, {&u, 1}, {&m, 1});
        return m;
    };
    if (prepared->gradients.defined[v]) return gathered(v);
    Mat3 sum = Mat3::Zero();
    int count = 0;
    for (const Index n : prepared->work->rings.ring(v)) {
        if (!prepared->known.gradient[n] && !prepared->gradients.defined[n]) continue;
        sum += gathered(n);
        ++count;
    }
    return count > 0 ? Mat3(sum / count) : Mat3(Mat3::Identity());
}

// Of the frame that is shown, whatever transforms have been asked for since.
void Deformer::State::find_gradients() {
    if (gradients_current) return;
    const ShownPoses in_place(handles, shown);
    evaluate_deviation({});
    for (Index row = 0; row < region.size(); ++row) {
        gradients[row] = gradient_of(prepared->work->patch.of_region[row]);
    }
    gradients_current = true;
}

// S of the second system for a deformation gradient: R, or R s.
Mat3 Deformer::State::rotation_of(const Mat3& gradient) const {
    const Mat3 r = nearest_rotation(gradient);
    return options.local_size == LocalSize::scale ? Mat3(uniform_scale(gradient) * r) : r;
}

// S_i less that of the base, for all vertices of the region, where handles turn by `greatest`
// relative to each other.
void Deformer::State::find_turns(const Mat3& base_rotation, double greatest,
                                 const Context& context) {
    std::optional<TurnPart> part;
    if (const double fraction = turn_fraction(greatest); fraction < 1.0) {
        part = part_of_turns(fraction, context);
    }
    const Vec4* x = part ? part->deviation.data() : deviation.data();
    const Mat3 base = frame_base.topLeftCorner<3, 3>();
    const bool scales = options.local_size == LocalSize::scale;
    if (turns.empty()) {
        const auto count = static_cast<std::size_t>(prepared->work->patch.real_count);
        turns.assign(count, PaddedMat3::Zero());
    }
    const std::vector<Index>& vertices = prepared->gathered;
    for_each_block(context, static_cast<Index>(vertices.size()), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> m;
        std::array<double, kFrameBlock> scale;
        const auto count = static_cast<std::size_t>(end - begin);
        prepared->gradient_loop().gather(vertices.data(), x, m.data(), begin, end);
        for (std::size_t i = 0; i < count; ++i) m[i] += base;
        if (part) turn_on(*part, {vertices.data() + begin, count}, {m.data(), count});
        for (std::size_t i = 0; i < count; ++i) scale[i] = scales ? uniform_scale(m[i]) : 1.0;
        nearest_rotations({m.data(), count}, {m.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const Index v = vertices[static_cast<std::size_t>(begin) + i];
            turns[v].topRows<3>() = scale[i] * m[i] - base_rotation;
        }
    });
    for (const Index v : prepared->averaged) {
        turns[v] =
            padded_columns(rotation_of(gradient_of(v, part ? &*part : nullptr)) - base_rotation);
    }
    turn_held(base_rotation);
}

// Handles turn as a whole.
void Deformer::State::turn_held(const Mat3& base_rotation) {
    for (std::size_t n = 0; n < handles.size(); ++n) {
        const HandleState& h = handles[n];
        if (h.removed || h.soft() || !h.options.gradient) continue;
        const PaddedMat3 turn = padded_columns(rotation_of(h.transform.linear) - base_rotation);
        for (const Index v : prepared->held[n]) turns[v] = turn;
        for (const SparseRow& row : h.points) {
            for (const auto& [v, c] : row) {
                if (prepared->owner[v] == static_cast<Index>(n)) turns[v] = turn;
            }
        }
    }
    for (const auto& entry : asked) {
        const Index v = entry.first;
        if (v >= prepared->work->patch.real_count || !prepared->known.gradient[v]) continue;
        turns[v] = padded_columns(rotation_of(known_gradient(v)) - base_rotation);
    }
}

// ---- Second system

// How handles change the size of the surface, as logarithms in the last entry; empty where none
// does.
std::vector<Vec4> Deformer::State::size_changes() const {
    if (!prepared->solution) return {};
    const std::vector<Vec4> of_handles = relative_turns();
    const bool any = std::any_of(of_handles.begin(), of_handles.end(),
                                 [](const Vec4& h) { return std::abs(h[3]) > 1e-9; });
    return any ? spread(of_handles) : std::vector<Vec4>();
}

// Rotations that fit the present positions best, as in the local step of Sorkine and Alexa,
// "As-rigid-as-possible surface modeling" (2007), for the energy of the second system: with its
// solution in between, that energy never increases. Successive over-relaxation: the rotations then
// go on by `further` times the change, and less where no rotation fits. Scales stay.
void Deformer::State::refine_turns(const Mat3& base_rotation, double further,
                                   const Context& context) {
    const Patch& patch = prepared->work->patch;
    std::vector<Vec4>& x = absolute;
    x.resize(static_cast<std::size_t>(patch.real_count));
    for_each_block(context, patch.real_count, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            x[v] = padded(Vec3(base_rotation * patch.rest[v] + deviation[v].head<3>()));
        }
    });
    const EnergyLoop loop = prepared->second->energy();
    const std::vector<Vec4> sizes = size_changes();
    const bool scales = options.local_size == LocalSize::scale;
    for (const std::vector<Index>* vertices : {&prepared->gathered, &prepared->averaged}) {
        const auto all = static_cast<Index>(vertices->size());
        for_each_block(context, all, [&](Index begin, Index end) {
            std::array<Mat3, kFrameBlock> m;
            const auto count = static_cast<std::size_t>(end - begin);
            loop.fit(x.data(), vertices->data(), m.data(), begin, end);
            nearest_rotations({m.data(), count}, {m.data(), count});
            const auto vertex_of = [&](std::size_t i) {
                return (*vertices)[static_cast<std::size_t>(begin) + i];
            };
            const auto turn_of = [&](std::size_t i) { return turns[vertex_of(i)].topRows<3>(); };
            for (std::size_t i = 0; i < count; ++i) {
                const Mat3 before = base_rotation + turn_of(i);
                const double scale = scales ? uniform_scale(before) : 1.0;
                // Nothing to go on from where the surface has shrunk to a point.
                if (!(scale > 0.0)) continue;
                const Mat3 from = before / scale;
                const Eigen::AngleAxisd change(Mat3(m[i] * from.transpose()));
                double sure = 1.0 - smooth_step((change.angle() - kSureChange) / kSureChange);
                if (!sizes.empty()) {
                    sure *= 1.0 - smooth_step(std::abs(sizes[vertex_of(i)][3]) / kSizeChange);
                }
                const double angle = (1.0 + further) * sure * change.angle();
                turn_of(i) =
                    scale * (rotation_of_turn(angle * change.axis()) * from) - base_rotation;
            }
        });
    }
}

// Solves for deviations from the similarity nearest to the base transform, so that similarities of
// the whole are exact.
void Deformer::State::solve_second(bool draft, const Context& context) {
    const Patch& patch = prepared->work->patch;
    const Mat3 base_rotation = rotation_of(frame_base.topLeftCorner<3, 3>());
    const Mat3 remainder = frame_base.topLeftCorner<3, 3>() - base_rotation;
    const double greatest = greatest_turn(), share = winding_share(greatest);
    find_turns(base_rotation, greatest, context);
    if (!remainder.isZero(0.0)) {
        for_each_block(context, patch.vertex_count, [&](Index begin, Index end) {
            for (Index v = begin; v < end; ++v) {
                deviation[v].head<3>() += remainder * patch.rest[v];
            }
        });
    }
    if (share > 0.0) wind_turns(base_rotation, share, draft, context);
    prepared->second->solve(turns, deviation, draft, context);
    for (int step = 1; step <= options.refine; ++step) {
        const double further = step < options.refine ? kFurther : kLastFurther;
        refine_turns(base_rotation, further * (1.0 - far_share(greatest)), context);
        prepared->second->solve(turns, deviation, draft, context);
    }
    const Vec3 shift = frame_base.topRightCorner<3, 1>();
    const std::vector<Index>& free = prepared->second->free_vertices();
    for_each_block(context, static_cast<Index>(free.size()), [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            const Index v = free[row];
            const Vec3 at = base_rotation * patch.rest[v] + shift + deviation[v].head<3>();
            next_positions[frame_row(patch, v)] = at + patch.origin;
        }
    });
}

void Deformer::State::solve(bool draft, const Context& context) {
    prepare(context);
    if (at_rest()) return to_rest();
    if (prepared->comparison) return solve_comparison(context);
    next_positions.resize(rest.size() + prepared->work->patch.inserted.size());
    evaluate_deviation(context);
    if (!prepared->second->free_vertices().empty()) solve_second(draft, context);
    show_next();
}

// Moves what is behind the region in `next_positions` to `inserted`.
void Deformer::State::take_inserted() {
    const Patch& patch = prepared->work->patch;
    shown_patch = prepared->work;
    inserted.assign(next_positions.begin() + region.size(), next_positions.end());
    next_positions.resize(rest.size());
    for (std::size_t k = 0; k < inserted.size(); ++k) {
        const Index v = patch.mesh_count() + static_cast<Index>(k);
        if (prepared->known.position[v]) inserted[k] = known_position(v) + patch.origin;
    }
}

// The last step of a frame: a cancel before it leaves what was shown. Held vertices lie where they
// were asked to, to the bit; vertices without faces that nothing holds are at rest.
void Deformer::State::show_next() {
    for (const Index row : prepared->resting_rows) next_positions[row] = rest[row];
    for (const HandleState& h : handles) {
        for (const Index v : h.local) {
            if (prepared->known.position[v]) next_positions[region_row[v]] = held_position(h, v);
        }
    }
    for (const auto& [v, constraint] : constraints) {
        if (constraint.position) next_positions[region_row[v]] = *constraint.position;
    }
    take_inserted();
    positions.swap(next_positions);
    shown.clear();
    for (const HandleState& h : handles) shown.push_back(h.in_patch);
    gradients_current = false;
}

void Deformer::State::to_rest() {
    positions = rest;
    inserted.clear();
    shown_patch.reset();
    shown.clear();
    gradients.assign(rest.size(), Mat3::Identity());
    gradients_current = true;
}

}  // namespace lissom
