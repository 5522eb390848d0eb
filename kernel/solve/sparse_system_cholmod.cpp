#include <cholmod.h>
#ifdef LISSOM_HAS_OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "kernel/solve/sparse_system.h"
#include "kernel/solve/sparse_system_check.h"
#include "kernel/solve/supernodal_solve.h"

namespace lissom {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// A view of `matrix` as CHOLMOD sees it; CHOLMOD does not write to it.
cholmod_sparse view_of(const SymmetricMatrix& matrix) {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
    view.nzmax = matrix.row.size();
    view.p = const_cast<Index*>(matrix.begin.data());
    view.i = const_cast<Index*>(matrix.row.data());
    view.x = const_cast<double*>(matrix.value.data());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

SupernodalFactor view_of(const cholmod_factor& factor) {
    return {static_cast<Index>(factor.n),
            static_cast<Index>(factor.nsuper),
            {static_cast<const Index*>(factor.super), static_cast<const Index*>(factor.pi),
             static_cast<const Index*>(factor.px), static_cast<const Index*>(factor.s),
             static_cast<const double*>(factor.x)},
            static_cast<const Index*>(factor.Perm)};
}

// Keeps CHOLMOD's loops on the calling thread while it lives: a host decides about threads, and
// results must not depend on their number.
class SerialSection {
  public:
#ifdef LISSOM_HAS_OPENMP
    SerialSection() : levels_(omp_get_max_active_levels()) {
        omp_set_max_active_levels(0);
    }
    ~SerialSection() {
        omp_set_max_active_levels(levels_);
    }

  private:
    int levels_;

  public:
#else
    SerialSection() = default;
#endif
    SerialSection(const SerialSection&) = delete;
    SerialSection& operator=(const SerialSection&) = delete;
};

// BLAS libraries without locks of their own, Debian's serial OpenBLAS among them, give wrong results
// where two threads factor at the same time.
std::mutex& factorization_mutex() {
    static std::mutex mutex;
    return mutex;
}

// CHOLMOD's settings and scratch memory.
class Workspace {
  public:
    Workspace() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_AMD;
        common_.postorder = 1;
    }
    ~Workspace() { cholmod_finish(&common_); }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    cholmod_common* get() { return &common_; }
    void require_memory() const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
            throw Error(ErrorCode::memory_limit,
                        "the factor of the linear system does not fit into memory; use a smaller "
                        "region or mesh");
        }
    }

  private:
    cholmod_common common_{};
};

// Least pivot relative to its diagonal entry, and the row it belongs to.
std::pair<double, Index> least_pivot(const cholmod_factor& factor, const SymmetricMatrix& matrix) {
    const auto* super = static_cast<const int*>(factor.super);
    const auto* rows = static_cast<const int*>(factor.pi);
    const auto* values = static_cast<const int*>(factor.px);
    const auto* x = static_cast<const double*>(factor.x);
    const auto* permutation = static_cast<const int*>(factor.Perm);
    std::pair<double, Index> least{1.0, 0};
    for (std::size_t s = 0; s < factor.nsuper; ++s) {
        const int height = rows[s + 1] - rows[s];
        for (int j = super[s]; j < super[s + 1]; ++j) {
            const double diagonal = x[values[s] + (j - super[s]) * (height + 1)];
            const Index row = permutation[j];
            const double ratio = diagonal * diagonal / matrix.value[matrix.begin[row]];
            if (!(ratio >= least.first)) least = {ratio, row};
        }
    }
    return least;
}

}  // namespace

struct SparseSystem::State {
    ~State() { cholmod_free_factor(&factor, workspace.get()); }

    Workspace workspace;
    cholmod_factor* factor = nullptr;
    std::vector<double> scratch;
    std::vector<Index> begin, row;
    bool factored = false;
    MemoryCharge charge;
    FactorStats stats;
};

SparseSystem::SparseSystem() : state_(std::make_unique<State>()) {}
SparseSystem::~SparseSystem() = default;
SparseSystem::SparseSystem(SparseSystem&&) noexcept = default;
SparseSystem& SparseSystem::operator=(SparseSystem&&) noexcept = default;

void SparseSystem::analyze(const SymmetricMatrix& matrix, const Context& context) {
    require_valid(matrix);
    context.checkpoint();
    const auto start = Clock::now();
    auto next = std::make_unique<State>();
    cholmod_sparse view = view_of(matrix);
    [[maybe_unused]] const SerialSection serial;
    next->factor = cholmod_analyze(&view, next->workspace.get());
    next->workspace.require_memory();
    if (!next->factor) throw Error(ErrorCode::internal, "CHOLMOD could not analyse the matrix");
    next->begin = matrix.begin;
    next->row = matrix.row;
    next->stats.factor_nonzeros = next->factor->xsize;
    next->stats.factor_bytes = next->factor->xsize * sizeof(double) +
                               next->factor->ssize * sizeof(int) +
                               4 * next->factor->n * sizeof(int);
    next->stats.analyze_seconds = seconds_since(start);
    state_ = std::move(next);
}

void SparseSystem::factor(const SymmetricMatrix& matrix, const Context& context) {
    State& state = *state_;
    require_pattern(matrix, state.begin, state.row);
    context.checkpoint();
    state.factored = false;
    state.charge = {};
    MemoryCharge charge = context.charge(state.stats.factor_bytes, "factoring the linear system");
    const auto start = Clock::now();
    cholmod_sparse view = view_of(matrix);
    {
        const std::lock_guard lock(factorization_mutex());
        [[maybe_unused]] const SerialSection serial;
        cholmod_factorize(&view, state.factor, state.workspace.get());
    }
    state.workspace.require_memory();
    if (state.workspace.get()->status == CHOLMOD_NOT_POSDEF) {
        refuse_pivot(matrix, static_cast<const int*>(state.factor->Perm)[state.factor->minor]);
    }
    if (const auto [ratio, row] = least_pivot(*state.factor, matrix);
        !(ratio > smallest_pivot(size()))) {
        refuse_pivot(matrix, row);
    }
    state.stats.factor_seconds = seconds_since(start);
    state.charge = std::move(charge);
    state.factored = true;
    context.checkpoint();
}

void SparseSystem::solve(std::span<const double> b, std::span<double> x, Index columns) const {
    require_factor(state_->factored);
    require_sizes(b, x, size(), columns);
    const auto rows = static_cast<std::size_t>(size());
    const SupernodalFactor factor = view_of(*state_->factor);
    for (Index first = 0; first < columns; first += kSolveWidth) {
        const std::size_t shift = static_cast<std::size_t>(first) * rows;
        solve_supernodal(factor, b.data() + shift, x.data() + shift,
                         std::min(kSolveWidth, columns - first), state_->scratch);
    }
}

SingleFactor SparseSystem::single_factor(const Context& context) const {
    require_factor(state_->factored);
    const cholmod_factor& factor = *state_->factor;
    const auto copy = [](const void* data, std::size_t count) {
        const auto* begin = static_cast<const Index*>(data);
        return std::vector<Index>(begin, begin + count);
    };
    SingleFactor::Supernodes nodes{
        copy(factor.super, factor.nsuper + 1), copy(factor.pi, factor.nsuper + 1),
        copy(factor.px, factor.nsuper + 1),    copy(factor.s, factor.ssize),
        std::vector<float>(factor.xsize),      0.0};
    const auto* value = static_cast<const double*>(factor.x);
    for (Index s = 0; s < nodes.count(); ++s) {
        for (Index j = 0; j < nodes.columns(s); ++j) {
            nodes.scale =
                std::max(nodes.scale, value[nodes.first_value[s] + j * (nodes.height(s) + 1)]);
        }
    }
    const double inverse = 1.0 / nodes.scale;
    std::transform(value, value + factor.xsize, nodes.value.begin(),
                   [&](double v) { return static_cast<float>(inverse * v); });
    return {std::move(nodes), copy(factor.Perm, factor.n), context};
}

Index SparseSystem::size() const {
    return state_->begin.empty() ? 0 : static_cast<Index>(state_->begin.size()) - 1;
}

bool SparseSystem::factored() const {
    return state_->factored;
}

const FactorStats& SparseSystem::stats() const {
    return state_->stats;
}

const char* sparse_backend() {
    return "cholmod";
}

}  // namespace lissom
