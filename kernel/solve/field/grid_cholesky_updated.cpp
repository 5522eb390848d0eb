#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/solve/field/grid_cholesky.h"
#include "kernel/solve/field/grid_dissection.h"
#include "kernel/solve/grid/cosine_transform.h"
#include "kernel/solve/sparse/cholmod_view.h"

namespace lissom {
namespace {

// Changed constraints from which on it is cheaper to factor again. Both costs grow with the grid,
// and their ratio little.
constexpr std::size_t kMostChanges = 256;

class Common {
  public:
    Common() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_GIVEN;
        common_.postorder = 1;
    }
    ~Common() { cholmod_finish(&common_); }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;

    cholmod_common* get() { return &common_; }
    int status() const { return common_.status; }

    void require_memory() const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
            throw Error(ErrorCode::memory_limit,
                        "the Cholesky factor of the grid does not fit into memory; use a smaller "
                        "grid or the dual solver");
        }
    }

  private:
    cholmod_common common_{};
};

// A change of one entry of the diagonal.
struct Change {
    Index point;
    double amount;
};

}  // namespace

struct GridCholesky::State {
    explicit State(const GridLaplacian& laplacian)
        : size(laplacian.size()), matrix(laplacian.matrix()), square(size.count(), 0.0) {}
    ~State() { release(); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    void release() {
        cholmod_free_factor(&factor, common.get());
        charge = {};
    }

    void factor_again(const Context& context);
    bool modify(const std::vector<Change>& changes, bool add);
    std::vector<double> squares(const ConstraintRows& rows) const;
    void solve_once(const double* b, double* x);

    GridSize size;
    SymmetricMatrix matrix;
    /// w^2 of each point, as it is in the matrix.
    std::vector<double> square;
    /// The row of the factor that holds each point.
    std::vector<Index> row_of;
    Common common;
    cholmod_factor* factor = nullptr;
    MemoryCharge charge;
    GridCholeskyStats stats;
};

GridCholesky::GridCholesky(const GridLaplacian& laplacian)
    : state_(std::make_unique<State>(laplacian)) {}
GridCholesky::~GridCholesky() = default;

std::vector<double> GridCholesky::State::squares(const ConstraintRows& rows) const {
    std::vector<double> result(square.size(), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result[size.index(rows.point[i])] = rows.weight[i] * rows.weight[i];
    }
    return result;
}

// Supernodal, then converted: a simplicial factorisation takes ten times as long.
void GridCholesky::State::factor_again(const Context& context) {
    release();
    cholmod_sparse view = cholmod_view(matrix);
    std::vector<Index> order = dissect_grid(size);
    factor = cholmod_analyze_p(&view, order.data(), nullptr, 0, common.get());
    common.require_memory();
    if (!factor) throw Error(ErrorCode::internal, "CHOLMOD could not analyse the grid");
    stats.factor_nonzeros = static_cast<std::size_t>(common.get()->lnz);
    charge = context.charge(
        factor->xsize * sizeof(double) + stats.factor_nonzeros * (sizeof(double) + sizeof(Index)),
        "the Cholesky factor of the grid");
    context.checkpoint();
    cholmod_factorize(&view, factor, common.get());
    common.require_memory();
    if (common.status() == CHOLMOD_NOT_POSDEF) {
        throw Error(ErrorCode::not_positive_definite,
                    "the system of the grid is not positive definite in double precision; use "
                    "weights that differ less");
    }
    context.checkpoint();
    cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, factor, common.get());
    common.require_memory();
    const auto* permutation = static_cast<const Index*>(factor->Perm);
    row_of.resize(square.size());
    for (Index i = 0; i < size.count(); ++i) row_of[permutation[i]] = i;
    ++stats.factorisations;
}

// The columns sqrt(amount) e_i of one update or downdate. Returns false if the factor is lost.
bool GridCholesky::State::modify(const std::vector<Change>& changes, bool add) {
    if (changes.empty()) return true;
    std::vector<Index> begin{0}, row;
    std::vector<double> value;
    for (const Change& change : changes) {
        row.push_back(row_of[change.point]);
        value.push_back(std::sqrt(std::abs(change.amount)));
        begin.push_back(count_of(row));
    }
    cholmod_sparse columns{};
    columns.nrow = square.size();
    columns.ncol = changes.size();
    columns.nzmax = row.size();
    columns.p = begin.data();
    columns.i = row.data();
    columns.x = value.data();
    columns.itype = CHOLMOD_INT;
    columns.xtype = CHOLMOD_REAL;
    columns.dtype = CHOLMOD_DOUBLE;
    columns.sorted = columns.packed = 1;
    const int done = cholmod_updown(add ? 1 : 0, &columns, factor, common.get());
    common.require_memory();
    stats.updated += count_of(changes);
    return done != 0 && common.status() == CHOLMOD_OK;
}

void GridCholesky::update(const ConstraintRows& rows, const Context& context) {
    State& s = *state_;
    const std::vector<double> next = s.squares(rows);
    std::vector<Change> added, removed;
    for (Index i = 0; i < s.size.count(); ++i) {
        const double amount = next[i] - s.square[i];
        if (amount > 0.0) added.push_back({i, amount});
        if (amount < 0.0) removed.push_back({i, amount});
        s.matrix.value[s.matrix.begin[i]] += amount;
    }
    s.square = next;
    const bool few = added.size() + removed.size() < kMostChanges;
    try {
        context.checkpoint();
        // Added first, so that the matrix is positive definite all the time.
        if (s.factor && few && s.modify(added, true) && s.modify(removed, false)) return;
        s.factor_again(context);
    } catch (...) {
        s.release();
        throw;
    }
}

void GridCholesky::State::solve_once(const double* b, double* x) {
    cholmod_dense right{};
    right.nrow = right.d = square.size();
    right.ncol = kComponents;
    right.nzmax = right.nrow * kComponents;
    right.x = const_cast<double*>(b);
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, &right, common.get());
    common.require_memory();
    if (!solution) throw Error(ErrorCode::internal, "CHOLMOD could not solve for the grid");
    std::copy_n(static_cast<const double*>(solution->x), right.nzmax, x);
    cholmod_free_dense(&solution, common.get());
}

void GridCholesky::solve(const double* b, double* x, int refinements,
                         const Context& context) const {
    State& s = *state_;
    s.solve_once(b, x);
    const std::size_t count = kComponents * s.square.size();
    std::vector<double> residual(refinements > 0 ? count : 0);
    for (int i = 0; i < refinements; ++i) {
        context.checkpoint();
        s.matrix.multiply(x, residual.data(), kComponents);
        for (std::size_t k = 0; k < count; ++k) residual[k] = b[k] - residual[k];
        s.solve_once(residual.data(), residual.data());
        for (std::size_t k = 0; k < count; ++k) x[k] += residual[k];
    }
}

const GridCholeskyStats& GridCholesky::stats() const {
    return state_->stats;
}

}  // namespace lissom
