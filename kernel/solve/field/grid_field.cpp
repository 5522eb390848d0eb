#include "kernel/solve/field/grid_field.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/solve/dual/dual_system.h"
#include "kernel/solve/field/boundary_correction.h"
#include "kernel/solve/field/grid_cholesky.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/field_workspace.h"
#include "kernel/solve/grid/grid_green.h"
#include "kernel/solve/grid/grid_laplacian.h"

namespace lissom {
namespace {

constexpr double kMinTolerance = 1e-12, kMaxTolerance = 1e-2;
// How much more exactly multipliers are found than the field that is asked for, and the most that
// double precision gives.
constexpr double kInnerTolerance = 0.1, kMinInnerTolerance = 1e-13;
constexpr Index kCopyGrain = 1 << 14;
// The dense limit balances an edit's cost: the square of the constraints below it, the points of
// the grid at each iteration above it.
constexpr double kDenseShare = 8.0, kMinDenseLimit = 3000.0, kMaxDenseLimit = 6000.0;

void require_valid(const GridFieldOptions& options) {
    const auto refuse = [](const char* what) { throw Error(ErrorCode::invalid_argument, what); };
    if (!std::isfinite(options.tension) || options.tension < 0.0) {
        refuse("the tension of a grid field must be a number from 0 on");
    }
    if (options.dense_limit.value_or(0) < 0)
        refuse("the dense limit of a grid field must not be negative");
    if (options.refinements < 0) refuse("the refinements of a grid field must not be negative");
    if (!(options.tolerance >= kMinTolerance && options.tolerance <= kMaxTolerance)) {
        refuse("the tolerance of a grid field must lie between 1e-12 and 1e-2");
    }
}

Index dense_limit(const GridSize& size, const GridFieldOptions& options) {
    if (options.dense_limit) return *options.dense_limit;
    const double limit = kDenseShare * std::sqrt(size.count());
    return static_cast<Index>(std::clamp(limit, kMinDenseLimit, kMaxDenseLimit));
}

// Whether the field is stored, and not only its multipliers.
bool is_stored(const GridFieldOptions& options) {
    return options.solver == GridSolver::cholesky || options.boundary == GridBoundary::thesis;
}

// Bytes held from the beginning on.
std::size_t standing_bytes(const GridSize& size, const GridFieldOptions& options) {
    const std::size_t field = field_entries(size) * sizeof(double);
    std::size_t bytes = 2 * field + (is_stored(options) ? field : 0);
    if (options.solver == GridSolver::dual) bytes += GridGreen::bytes(size);
    // The matrix has up to 13 entries a column.
    if (options.solver == GridSolver::cholesky) bytes += field / 3 * 13 * 2;
    return bytes;
}

double max_component(std::span<const Vec3> vectors) {
    double most = 0.0;
    for (const Vec3& v : vectors) most = std::max(most, v.cwiseAbs().maxCoeff());
    return most;
}

}  // namespace

struct GridField::State {
    State(const GridSize& grid, const GridFieldOptions& chosen, const Context& context)
        : size(grid),
          options(chosen),
          charge(context.charge(standing_bytes(size, options), "the grid of a field")),
          constraints(size),
          laplacian(size, options.boundary, options.tension),
          workspace(size) {
        if (is_stored(options)) {
            stored = make_field(size);
            std::fill_n(stored.get(), field_entries(size), 0.0);
        }
        if (options.solver == GridSolver::cholesky) {
            cholesky = make_grid_cholesky(laplacian);
            return;
        }
        const MemoryCharge working =
            context.charge(GridGreen::working_bytes(size), "the tables of a grid");
        green = std::make_unique<GridGreen>(size, options.tension, context);
        dual = std::make_unique<DualSystem>(
            *green, dense_limit(size, options),
            std::max(kMinInnerTolerance, kInnerTolerance * options.tolerance));
    }

    void solve_dual(std::span<const MergedConstraint> merged, const Context& context);
    void refine(const ConstraintRows& rows, std::span<const Vec3> known, DualSolution& next,
                const Context& context);
    void solve_cholesky(std::span<const MergedConstraint> merged, const Context& context);
    void write(const FieldSink& sink, const Context& context);

    GridSize size;
    GridFieldOptions options;
    MemoryCharge charge;
    GridConstraints constraints;
    GridLaplacian laplacian;
    FieldWorkspace workspace;
    std::unique_ptr<GridGreen> green;
    std::unique_ptr<DualSystem> dual;
    std::unique_ptr<GridCholesky> cholesky;

    /// The last solution: its multipliers, or the field itself.
    ConstraintRows rows;
    DualSolution solution;
    FieldBuffer stored;
    /// Version of the constraints that it belongs to.
    std::uint64_t version = 0;
};

// One more solve for the residual of the equations: known - U't - W^-2 lambda, and a sum that is
// not zero.
void GridField::State::refine(const ConstraintRows& next, std::span<const Vec3> known,
                              DualSolution& result, const Context& context) {
    FieldSink sink;
    sink.components = workspace.second.get();
    sink.constant = result.constant;
    green->apply_at(next.point, result.multiplier, workspace.first.get(), workspace.second.get(),
                    sink, context);
    std::vector<Vec3> residual(known.begin(), known.end());
    Vec3 excess = Vec3::Zero();
    for (std::size_t i = 0; i < residual.size(); ++i) {
        residual[i] -= vector_at(workspace.second.get(), size, size.index(next.point[i])) +
                       result.multiplier[i] / (next.weight[i] * next.weight[i]);
        excess += result.multiplier[i];
    }
    const DualSolution more = dual->solve(residual, -excess, workspace, context);
    for (std::size_t i = 0; i < residual.size(); ++i) result.multiplier[i] += more.multiplier[i];
    result.constant += more.constant;
}

void GridField::State::solve_dual(std::span<const MergedConstraint> merged,
                                  const Context& context) {
    const std::vector<Index> order = arrange_rows(merged);
    ConstraintRows next = rows_in_order(size, merged, order);
    std::vector<Vec3> known;
    known.reserve(order.size());
    for (const Index at : order) known.push_back(merged[at].value);

    Progress progress(context, "solve the field");
    progress.step(0.7);
    dual->update(next, context);
    progress.step(0.3);
    DualSolution result = dual->solve(known, Vec3::Zero(), workspace, context);
    for (int i = 0; i < options.refinements; ++i) refine(next, known, result, context);
    if (options.boundary == GridBoundary::thesis) {
        FieldBuffer field = make_field(size);
        FieldSink sink;
        sink.components = field.get();
        sink.constant = result.constant;
        green->apply_at(next.point, result.multiplier, workspace.first.get(),
                        workspace.second.get(), sink, context);
        correct_boundary({laplacian, *green, *dual, options.tolerance * max_component(known)},
                         result.multiplier, field.get(), workspace, context);
        stored = std::move(field);
    }
    rows = std::move(next);
    solution = std::move(result);
}

void GridField::State::solve_cholesky(std::span<const MergedConstraint> merged,
                                      const Context& context) {
    std::vector<Index> order(merged.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = index_of(i);
    ConstraintRows next = rows_in_order(size, merged, order);
    Progress progress(context, "factor the field");
    progress.step(0.9);
    cholesky->update(next, context);
    progress.step(0.1);
    double *b = workspace.first.get(), *x = workspace.second.get();
    const std::size_t count = size.count();
    std::fill_n(b, field_entries(size), 0.0);
    for (const MergedConstraint& m : merged) {
        for (int c = 0; c < kComponents; ++c) {
            b[c * count + m.point] = m.weight * m.weight * m.value[c];
        }
    }
    cholesky->solve(b, x, options.refinements, context);
    std::swap(stored, workspace.second);
    rows = std::move(next);
}

// The last solution into `sink`.
void GridField::State::write(const FieldSink& sink, const Context& context) {
    if (!is_stored(options)) {
        FieldSink whole = sink;
        whole.constant = solution.constant;
        green->apply_at(rows.point, solution.multiplier, workspace.first.get(),
                        workspace.second.get(), whole, context);
        return;
    }
    context.parallel_for(0, size.count(), kCopyGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Vec3 v = vector_at(stored.get(), size, i);
            if (sink.vectors) {
                sink.vectors[i] = v;
                continue;
            }
            float* to = sink.quads + 4 * at(i);
            for (int c = 0; c < kComponents; ++c) to[c] = static_cast<float>(v[c]);
        }
    });
}

GridField::GridField(const GridSize& size, const GridFieldOptions& options,
                     const Context& context) {
    require_valid(size);
    require_valid(options);
    state_ = std::make_unique<State>(size, options, context);
}
GridField::~GridField() = default;
GridField::GridField(GridField&&) noexcept = default;
GridField& GridField::operator=(GridField&&) noexcept = default;

std::size_t GridField::predicted_bytes(const GridSize& size, std::size_t constraints,
                                       const GridFieldOptions& options) {
    require_valid(size);
    require_valid(options);
    const std::size_t field = field_entries(size) * sizeof(double);
    std::size_t working = 0;
    if (options.solver == GridSolver::dual) {
        working = std::max(GridGreen::working_bytes(size),
                           DualSystem::bytes(constraints, dense_limit(size, options)));
        if (options.boundary == GridBoundary::thesis) working += (kCorrectionFields + 1) * field;
    }
    return standing_bytes(size, options) + working;
}

const GridSize& GridField::size() const {
    return state_->size;
}

const GridFieldOptions& GridField::options() const {
    return state_->options;
}

void GridField::set_constraints(ConstraintOwner owner, std::vector<GridConstraint> constraints) {
    state_->constraints.set(owner, std::move(constraints));
}

const GridConstraints& GridField::constraints() const {
    return state_->constraints;
}

void GridField::clear() {
    state_->constraints.clear();
}

void GridField::solve(const Context& context) {
    State& state = *state_;
    context.checkpoint();
    if (solved()) return;
    const std::vector<MergedConstraint> merged = state.constraints.merged();
    if (merged.empty()) {
        state.rows = {};
        state.solution = {};
        if (state.stored) std::fill_n(state.stored.get(), field_entries(state.size), 0.0);
    } else if (state.options.solver == GridSolver::cholesky) {
        state.solve_cholesky(merged, context);
    } else {
        state.solve_dual(merged, context);
    }
    state.version = state.constraints.version();
}

bool GridField::solved() const {
    return state_->version == state_->constraints.version();
}

void GridField::evaluate(std::span<Vec3> vectors, const Context& context) const {
    if (vectors.size() != at(size().count())) {
        throw Error(ErrorCode::invalid_argument, "the grid to evaluate into needs " +
                                                     std::to_string(size().count()) + " vectors");
    }
    FieldSink sink;
    sink.vectors = vectors.data();
    state_->write(sink, context);
}

void GridField::evaluate(std::span<float> quads, const Context& context) const {
    if (quads.size() != 4 * at(size().count())) {
        throw Error(ErrorCode::invalid_argument, "the grid to evaluate into needs " +
                                                     std::to_string(size().count()) +
                                                     " times four floats");
    }
    FieldSink sink;
    sink.quads = quads.data();
    state_->write(sink, context);
}

Index GridField::constraint_count() const {
    return count_of(state_->rows);
}

GridCholeskyStats GridField::cholesky_stats() const {
    return state_->cholesky ? state_->cholesky->stats() : GridCholeskyStats{};
}

}  // namespace lissom
