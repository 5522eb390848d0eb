#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/cholmod/cholmod_view.h"
#include "kernel/core/build_info.h"
#include "kernel/core/error.h"
#include "kernel/solve/field/grid_cholesky.h"
#include "kernel/solve/field/grid_dissection.h"
#include "kernel/solve/grid/cosine_transform.h"

namespace lissom {
namespace {

// Changed constraints from which on it is cheaper to factor again. Both costs grow with the grid,
// and their ratio little.
constexpr std::size_t kMaxChanges = 256;

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

// CHOLMOD factors in supernodes, ordered by nested dissection of the grid, which are then converted
// to the L D L' that it can change. If very many constraints change, it is cheaper to factor anew.
class UpdatedCholesky final : public GridCholesky {
  public:
    explicit UpdatedCholesky(const GridLaplacian& laplacian)
        : size_(laplacian.size()), matrix_(laplacian.matrix()), square_(size_.count(), 0.0) {}
    ~UpdatedCholesky() override { release(); }

    void update(const ConstraintRows& rows, const Context& context) override;
    void solve(const double* b, double* x, int refinements, const Context& context) const override;
    const GridCholeskyStats& stats() const override { return stats_; }

  private:
    void release() {
        cholmod_free_factor(&factor_, common_.get());
        charge_ = {};
    }

    void factor_again(const Context& context);
    bool modify(const std::vector<Change>& changes, bool add);
    std::vector<double> squares(const ConstraintRows& rows) const;
    void solve_once(const double* b, double* x) const;

    GridSize size_;
    SymmetricMatrix matrix_;
    /// w^2 of each point, as it is in the matrix.
    std::vector<double> square_;
    /// The row of the factor that holds each point.
    std::vector<Index> row_of_;
    mutable Common common_;
    cholmod_factor* factor_ = nullptr;
    MemoryCharge charge_;
    GridCholeskyStats stats_;
};

std::vector<double> UpdatedCholesky::squares(const ConstraintRows& rows) const {
    std::vector<double> result(square_.size(), 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result[size_.index(rows.point[i])] = rows.weight[i] * rows.weight[i];
    }
    return result;
}

// Supernodal, then converted: a simplicial factorisation takes ten times as long.
void UpdatedCholesky::factor_again(const Context& context) {
    release();
    cholmod_sparse view = cholmod_view(matrix_);
    std::vector<Index> order = dissect_grid(size_);
    factor_ = cholmod_analyze_p(&view, order.data(), nullptr, 0, common_.get());
    common_.require_memory();
    if (!factor_) throw Error(ErrorCode::internal, "CHOLMOD could not analyse the grid");
    stats_.factor_nonzeros = static_cast<std::size_t>(common_.get()->lnz);
    charge_ = context.charge(
        factor_->xsize * sizeof(double) + stats_.factor_nonzeros * (sizeof(double) + sizeof(Index)),
        "the Cholesky factor of the grid");
    context.checkpoint();
    cholmod_factorize(&view, factor_, common_.get());
    common_.require_memory();
    if (common_.status() == CHOLMOD_NOT_POSDEF) {
        throw Error(ErrorCode::not_positive_definite,
                    "the system of the grid is not positive definite in double precision; use "
                    "weights that differ less");
    }
    context.checkpoint();
    cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, factor_, common_.get());
    common_.require_memory();
    const auto* permutation = static_cast<const Index*>(factor_->Perm);
    row_of_.resize(square_.size());
    for (Index i = 0; i < size_.count(); ++i) row_of_[permutation[i]] = i;
    ++stats_.factorisations;
}

// The columns sqrt(amount) e_i of one update or downdate. Returns false if the factor is lost.
bool UpdatedCholesky::modify(const std::vector<Change>& changes, bool add) {
    if (changes.empty()) return true;
    std::vector<Index> begin{0}, row;
    std::vector<double> value;
    for (const Change& change : changes) {
        row.push_back(row_of_[change.point]);
        value.push_back(std::sqrt(std::abs(change.amount)));
        begin.push_back(count_of(row));
    }
    cholmod_sparse columns{};
    columns.nrow = square_.size();
    columns.ncol = changes.size();
    columns.nzmax = row.size();
    columns.p = begin.data();
    columns.i = row.data();
    columns.x = value.data();
    columns.itype = CHOLMOD_INT;
    columns.xtype = CHOLMOD_REAL;
    columns.dtype = CHOLMOD_DOUBLE;
    columns.sorted = columns.packed = 1;
    const int done = cholmod_updown(add ? 1 : 0, &columns, factor_, common_.get());
    common_.require_memory();
    stats_.updated += count_of(changes);
    return done != 0 && common_.status() == CHOLMOD_OK;
}

void UpdatedCholesky::update(const ConstraintRows& rows, const Context& context) {
    const std::vector<double> next = squares(rows);
    std::vector<Change> added, removed;
    for (Index i = 0; i < size_.count(); ++i) {
        const double amount = next[i] - square_[i];
        if (amount > 0.0) added.push_back({i, amount});
        if (amount < 0.0) removed.push_back({i, amount});
        matrix_.value[matrix_.begin[i]] += amount;
    }
    square_ = next;
    const bool few = added.size() + removed.size() < kMaxChanges;
    try {
        context.checkpoint();
        // Added first, so that the matrix is positive definite all the time.
        if (factor_ && few && modify(added, true) && modify(removed, false)) return;
        factor_again(context);
    } catch (...) {
        release();
        throw;
    }
}

void UpdatedCholesky::solve_once(const double* b, double* x) const {
    cholmod_dense right{};
    right.nrow = right.d = square_.size();
    right.ncol = kComponents;
    right.nzmax = right.nrow * kComponents;
    right.x = const_cast<double*>(b);
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor_, &right, common_.get());
    common_.require_memory();
    if (!solution) throw Error(ErrorCode::internal, "CHOLMOD could not solve for the grid");
    std::copy_n(static_cast<const double*>(solution->x), right.nzmax, x);
    cholmod_free_dense(&solution, common_.get());
}

void UpdatedCholesky::solve(const double* b, double* x, int refinements,
                            const Context& context) const {
    solve_once(b, x);
    const std::size_t count = kComponents * square_.size();
    std::vector<double> residual(refinements > 0 ? count : 0);
    for (int i = 0; i < refinements; ++i) {
        context.checkpoint();
        matrix_.multiply(x, residual.data(), kComponents);
        for (std::size_t k = 0; k < count; ++k) residual[k] = b[k] - residual[k];
        solve_once(residual.data(), residual.data());
        for (std::size_t k = 0; k < count; ++k) x[k] += residual[k];
    }
}

}  // namespace

std::unique_ptr<GridCholesky> make_updated_cholesky(const GridLaplacian& laplacian) {
    return std::make_unique<UpdatedCholesky>(laplacian);
}

bool has_gpl_module() {
    return true;
}

}  // namespace lissom

// The link options of this library ask for it, so that these definitions are taken.
// NOLINTBEGIN(readability-identifier-naming): a name of C.
extern "C" {
extern const char lissom_gpl_module;
const char lissom_gpl_module = 0;
}
// NOLINTEND(readability-identifier-naming)
