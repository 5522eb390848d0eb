#include "kernel/deform/system/linear_solution.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "kernel/core/clock.h"
#include "kernel/core/extended.h"
#include "kernel/deform/system/frame_loops.h"

namespace lissom {
namespace {

// Row of each local vertex in the system, or kNoIndex.
std::vector<Index> rows_of(const LinearProblem& problem) {
    std::vector<Index> row(problem.patch.vertex_count, kNoIndex);
    const std::vector<Index>& free = problem.system.free_vertices();
    for (std::size_t r = 0; r < free.size(); ++r) row[free[r]] = index_of(r);
    return row;
}

// M_i (v_i - v'_i) for each displaced free vertex; `at(k)` is the value at local vertex k.
template <typename Value, typename At>
std::vector<Value> folds(const LinearProblem& problem, const At& at) {
    std::vector<Value> result;
    const GradientStencils& g = problem.gradients;
    for (const Index i : g.displaced) {
        if (!g.defined[i]) {
            result.push_back(Value::Zero());
            continue;
        }
        const Vec3 back = problem.patch.rest[i] - g.displaced_rest[i];
        Value sum = g.self[i].dot(back) * at(i);
        for (Index e = problem.rings.begin[i]; e < problem.rings.begin[i + 1]; ++e) {
            sum += g.neighbor[e].dot(back) * at(problem.rings.neighbor[e]);
        }
        result.push_back(sum);
    }
    return result;
}

}  // namespace

Mat4 matrix_of(const Affine& transform) {
    Mat4 m = Mat4::Zero();
    m.topLeftCorner<3, 3>() = transform.linear;
    m.topRightCorner<3, 1>() = transform.translation;
    return m;
}

// A loop over the weights of handles that move beside the base, with the lists that it refers to.
struct LinearSolution::Loop {
    // Of so many handles without memory: blocks are many.
    static constexpr std::size_t kUsual = 64;
    std::array<const Vec4*, kUsual> usual;
    std::array<Mat4, kUsual> usual_transforms;
    std::vector<const Vec4*> more;
    std::vector<Mat4> more_transforms;
    BasisLoop loop;

    Loop(std::span<const Mat4> differences, const LinearSolution& of) {
        const bool many = differences.size() > kUsual;
        if (many) {
            more.resize(differences.size());
            more_transforms.resize(differences.size());
        }
        const Vec4** const weights = many ? more.data() : usual.data();
        Mat4* const transforms = many ? more_transforms.data() : usual_transforms.data();
        std::size_t count = 0;
        for (std::size_t h = 0; h < differences.size(); ++h) {
            if (differences[h].isZero(0.0)) continue;
            transforms[count] = differences[h];
            weights[count++] = of.weights(h).of_rows.data();
        }
        loop = {transforms, weights, count};
    }
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;
};

LinearSolution::LinearSolution(const LinearProblem& problem, const Context& context)
    : problem_(problem) {
    const std::vector<Index>& free = problem.system.free_vertices();
    for (const Index v : free) rest_.push_back(problem.patch.rest[v]);
    const std::vector<Index> row = rows_of(problem);
    fold_of_.assign(free.size(), kNoIndex);
    for (std::size_t f = 0; f < problem.gradients.displaced.size(); ++f) {
        fold_of_[row[problem.gradients.displaced[f]]] = index_of(f);
    }
    for (Index r = 0; r < rows(); ++r) {
        if (fold_of_[r] != kNoIndex) folded_.push_back(r);
    }
    choose_base();
    weights_ = std::vector<Lazy<HandleWeights>>(handles_.size());
    charge_ = context.charge(memory_bytes(), "the handle basis");
}

// Vertices without faces are pinned too, but hold nothing.
void LinearSolution::choose_base() {
    const LinearProblem& problem = problem_;
    bool surrounded = false;
    for (Index i = 0; i < problem.patch.vertex_count; ++i) {
        const Index o = problem.owner[i];
        const bool holds = problem.rings.count(i) > 0 || i >= problem.patch.surface_count;
        surrounded = surrounded || ((o == kPinned || o == kConstrained) && holds);
    }
    for (std::size_t h = 0; h < problem.handles.size(); ++h) {
        if (!problem.handles[h]) continue;
        if (!surrounded && base_ == kNoIndex) {
            base_ = index_of(h);
        } else {
            handles_.push_back(index_of(h));
        }
    }
}

void LinearSolution::find_weights(std::span<const Mat4> differences, const Context& context) const {
    std::vector<std::size_t> moved;
    for (std::size_t h = 0; h < differences.size(); ++h) {
        if (!differences[h].isZero(0.0) && !weights_[h].is_known()) moved.push_back(h);
    }
    if (moved.empty()) return;
    context.parallel_for(0, count_of(moved), 1, [&](Index begin, Index end) {
        for (Index n = begin; n < end; ++n) {
            context.checkpoint();
            (void)weights(moved[at(n)]);
        }
    });
}

void LinearSolution::find_all_weights(const Context& context) const {
    Progress progress(context, "deform: handle basis");
    find_weights(std::vector<Mat4>(handles_.size(), Mat4::Identity()), context);
}

const LinearSolution::HandleWeights& LinearSolution::weights(std::size_t h) const {
    return weights_[h].get([&] { return solved_weights(handles_[h]); });
}

LinearSolution::HandleWeights LinearSolution::solved_weights(Index handle) const {
    const auto start = Clock::now();
    const LinearProblem& problem = problem_;
    const std::size_t rows = rest_.size();
    const auto holds = [&](Index k) { return problem.owner[k] == handle; };
    const auto position = [&](int c, Index k) {
        if (!holds(k)) return 0.0;
        return c < 3 ? problem.patch.rest[k][c] : 1.0;
    };
    std::vector<Extended> right(rows * 4);
    for (int c = 0; c < 4; ++c) {
        problem.system.right_hand_side(
            [&](Index k) { return position(c, k); },
            [&](Index k) { return holds(k) && c < 3 ? Vec3(Vec3::Unit(c)) : Vec3(Vec3::Zero()); },
            right.data() + c * rows);
    }
    std::vector<double> columns = problem.system.solve(right, 4);
    for (int c = 0; c < 4; ++c) {
        problem.system.enforce_ties([&](Index k) { return position(c, k); },
                                    std::span(columns).subspan(c * rows, rows));
    }
    HandleWeights found{std::vector<Vec4>(rows), {}};
    for (std::size_t r = 0; r < rows; ++r) {
        found.of_rows[r] = {columns[r], columns[rows + r], columns[2 * rows + r],
                            columns[3 * rows + r]};
    }
    const std::vector<Index> row = rows_of(problem);
    found.folds = folds<Vec4>(problem, [&](Index k) -> Vec4 {
        if (row[k] != kNoIndex) return found.of_rows[row[k]];
        return holds(k) ? homogeneous(problem.patch.rest[k]) : Vec4(Vec4::Zero());
    });
    nanoseconds_ += static_cast<std::int64_t>(1e9 * seconds_since(start));
    return found;
}

FixedPart LinearSolution::fixed_part(const LinearProblem& problem,
                                     const VertexConstraints& constraints) const {
    FixedPart fixed;
    if (constraints.empty()) return fixed;
    const std::size_t rows = rest_.size();
    const auto shift = [&](Index k) -> Vec3 {
        const auto found = constraints.find(k);
        if (found == constraints.end() || !found->second.position) return Vec3::Zero();
        return *found->second.position - problem.patch.origin - problem.patch.rest[k];
    };
    std::vector<Extended> right(rows * 3);
    for (int d = 0; d < 3; ++d) {
        problem.system.right_hand_side(
            [&](Index k) { return shift(k)[d]; },
            [&](Index k) -> Vec3 {
                const auto found = constraints.find(k);
                if (found == constraints.end() || !found->second.gradient) return Vec3::Zero();
                return found->second.gradient->row(d).transpose() - Vec3::Unit(d);
            },
            right.data() + d * rows);
    }
    std::vector<double> columns = problem.system.solve(right, 3);
    for (int d = 0; d < 3; ++d) {
        problem.system.enforce_ties([&](Index k) { return shift(k)[d]; },
                                    std::span(columns).subspan(d * rows, rows));
    }
    fixed.value.resize(rows);
    for (std::size_t r = 0; r < rows; ++r) {
        fixed.value[r] = {columns[r], columns[rows + r], columns[2 * rows + r]};
    }
    const std::vector<Index> row = rows_of(problem);
    fixed.fold = folds<Vec3>(problem, [&](Index k) -> Vec3 {
        return row[k] != kNoIndex ? fixed.value[row[k]] : shift(k);
    });
    return fixed;
}

void LinearSolution::handle_part(std::span<const Mat4> differences, Vec4* x, Index begin,
                                 Index end) const {
    Loop(differences, *this).loop.evaluate(x, begin, end);
}

void LinearSolution::deviations(std::span<const Mat4> differences, const FixedPart& fixed, Vec4* x,
                                Index begin, Index end) const {
    handle_part(differences, x, begin, end);
    if (fixed.value.empty()) return;
    for (Index row = begin; row < end; ++row) x[row - begin].head<3>() += fixed.value[row];
}

void LinearSolution::place(std::span<const Mat4> differences, const FixedPart& fixed,
                           const Places& places, Index begin, Index end) const {
    Loop(differences, *this)
        .loop.place(
            {rest_.data(), places.shift, places.origin, places.row.data(), places.out.data()},
            begin, end);
    if (!fixed.value.empty()) {
        for (Index row = begin; row < end; ++row) {
            if (places.row[row] != kNoIndex) places.out[places.row[row]] += fixed.value[row];
        }
    }
    const auto first = std::lower_bound(folded_.begin(), folded_.end(), begin);
    for (auto row = first; row != folded_.end() && *row < end; ++row) {
        if (places.row[*row] != kNoIndex) place_folded(differences, fixed, places, *row);
    }
}

// Adds the terms that bring a displaced vertex back.
void LinearSolution::place_folded(std::span<const Mat4> differences, const FixedPart& fixed,
                                  const Places& places, Index row) const {
    const Index f = fold_of_[row];
    Vec3& at = places.out[places.row[row]];
    for (std::size_t h = 0; h < handles_.size(); ++h) {
        if (differences[h].isZero(0.0)) continue;
        at += (differences[h] * weights(h).folds[lissom::at(f)]).head<3>();
    }
    if (!fixed.fold.empty()) at += fixed.fold[f];
}

std::size_t LinearSolution::memory_bytes() const {
    return rest_.size() * (sizeof(Vec3) + handles_.size() * sizeof(Vec4) + sizeof(Index));
}

}  // namespace lissom
