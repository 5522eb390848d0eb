#include "kernel/solve/sparse/supernodal_factor.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "kernel/core/large_pages.h"
#include "kernel/core/numbers/bits.h"

namespace lissom {
namespace {

// Columns of a block that are updated together.
constexpr Index kUpdateColumns = 32;
static_assert(kUpdateColumns <= kPanelColumns);

// Rows of a block that are computed together.
constexpr Index kRowGrain = 240;

// Entries of a block times its columns below which its panels are not worth sharing out.
constexpr double kMinShared = 1e6;

// One dense block: a supernode or an extension.
struct Block {
    const Index* row = nullptr;
    Index columns = 0, height = 0;
    double* value = nullptr;

    double* entry(Index r, Index c) const { return value + r + std::ptrdiff_t{c} * height; }
};

// Buffers of one chunk of work.
struct Scratch {
    explicit Scratch(Index tallest)
        : product(unfilled<double[]>(at(tallest) * kUpdateColumns)),
          packed(unfilled<double[]>(kPackedSize)),
          local(unfilled<Index[]>(at(tallest))) {}

    std::unique_ptr<double[]> product, packed;
    std::unique_ptr<Index[]> local;
};

// Executor of a block: the calling thread alone, or all threads of a context, chunk by chunk.
class BlockExecutor {
  public:
    BlockExecutor(Index size, Index tallest, std::size_t max_chunks, const Context* context)
        : position(unfilled<Index[]>(at(size))), context_(context) {
        for (std::size_t i = 0; i < max_chunks; ++i) scratch_.emplace_back(tallest);
    }

    template <typename Work>
    void run(Index chunks, bool share, const Work& work) {
        if (!context_ || !share || chunks == 1) {
            for (Index i = 0; i < chunks; ++i) work(i, scratch_.front());
            return;
        }
        context_->parallel_for(0, chunks, 1, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) work(i, scratch_[i]);
        });
    }

    // Position of each row of the factor in the current block.
    std::unique_ptr<Index[]> position;

  private:
    std::vector<Scratch> scratch_;
    const Context* context_;
};

Index chunks_of(Index count, Index grain) {
    return (count + grain - 1) / grain;
}

// Most chunks that a block above the subtrees is cut into.
std::size_t max_chunks(const FactorPlan& plan) {
    const Index chunks =
        std::max(chunks_of(plan.widest, kUpdateColumns), chunks_of(plan.tallest, kRowGrain));
    return std::max(chunks, Index{1});
}

class Factorization {
  public:
    Factorization(const FactorTask& task, Processor processor)
        : task_(task),
          nodes_(task.nodes),
          plan_(task.plan),
          value_(task.value),
          kernels_(dense_kernels(processor)) {
        std::size_t end = 0;
        for (const FactorPlan::Subtree& t : plan_.subtrees) {
            first_extension_.push_back(end);
            end += t.above.size() * t.above.size();
        }
        if (!task.extensions) own_extensions_ = large_array<double>(end);
        extensions_ = task.extensions ? task.extensions : own_extensions_.get();
    }

    Index run(const Context& context) {
        Index failed = factor_subtrees(context);
        if (failed != kNoIndex) return failed;
        BlockExecutor crew(nodes_.size(), plan_.tallest, max_chunks(plan_), &context);
        for (std::size_t i = 0; failed == kNoIndex && i < plan_.top.size(); ++i) {
            if (!is_changed(plan_.top[i])) continue;
            context.checkpoint();
            failed = factor_node(plan_.top[i], crew);
        }
        return failed;
    }

  private:
    bool is_changed(Index s) const { return !task_.changed || task_.changed[s]; }
    bool is_idle(Index s) const { return task_.idle && task_.idle[s]; }

    // Failures are compared after all bins have ended, so that the reported one does not depend on
    // their order.
    Index factor_subtrees(const Context& context) {
        std::vector<Index> failures(plan_.bins.size(), kNoIndex);
        context.parallel_for(0, count_of(plan_.bins), 1, [&](Index begin, Index end) {
            for (Index bin = begin; bin < end; ++bin) failures[bin] = factor_bin(bin, context);
        });
        Index failed = kNoIndex;
        for (const Index column : failures) {
            if (column != kNoIndex && (failed == kNoIndex || column < failed)) failed = column;
        }
        return failed;
    }

    Index factor_bin(Index bin, const Context& context) {
        BlockExecutor alone(nodes_.size(), plan_.tallest, 1, nullptr);
        for (const Index t : plan_.bins[bin]) {
            const FactorPlan::Subtree& subtree = plan_.subtrees[t];
            // Its root is above all others.
            if (!is_changed(subtree.last - 1)) continue;
            for (Index s = subtree.first; s < subtree.last; ++s) {
                if (!is_changed(s)) continue;
                context.checkpoint();
                const Index failed = factor_node(s, alone);
                if (failed != kNoIndex) return failed;
            }
            const Block extension = block(nodes_.count() + t);
            std::fill_n(extension.value, extension.entry(0, extension.columns) - extension.value,
                        0.0);
            update(nodes_.count() + t, extension, alone);
        }
        return kNoIndex;
    }

    Block block(Index b) const {
        if (b < nodes_.count()) {
            return {nodes_.row.data() + nodes_.first_row[b], nodes_.columns(b), nodes_.height(b),
                    value_ + nodes_.first_value[b]};
        }
        const std::size_t t = b - nodes_.count();
        const std::vector<Index>& above = plan_.subtrees[t].above;
        const auto size = count_of(above);
        return {above.data(), size, size, extensions_ + first_extension_[t]};
    }

    Index factor_node(Index s, BlockExecutor& crew) {
        if (is_idle(s)) return kNoIndex;
        const Block node = block(s);
        std::fill(node.value, node.entry(0, node.columns), 0.0);
        for (Index e = plan_.first_entry[s]; e < plan_.first_entry[s + 1]; ++e) {
            value_[plan_.entries[e].target] = task_.matrix[plan_.entries[e].source];
        }
        update(s, node, crew);
        const Index failed = eliminate(node, crew);
        return failed == kNoIndex ? kNoIndex : nodes_.super[s] + failed;
    }

    // Subtracts from block `b` the products of all blocks before it.
    void update(Index b, const Block& target, BlockExecutor& crew) const {
        if (plan_.first_update[b] == plan_.first_update[b + 1]) return;
        for (Index i = 0; i < target.height; ++i) crew.position[target.row[i]] = i;
        crew.run(chunks_of(target.columns, kUpdateColumns), true,
                 [&](Index chunk, Scratch& scratch) {
                     const Index begin = chunk * kUpdateColumns;
                     const Index end = std::min(begin + kUpdateColumns, target.columns);
                     for (Index u = plan_.first_update[b]; u < plan_.first_update[b + 1]; ++u) {
                         const Index from = plan_.updates[u].from;
                         if (from < nodes_.count() && is_idle(from)) continue;
                         update_columns(target, begin, end, plan_.updates[u], crew.position.get(),
                                        scratch);
                     }
                 });
    }

    // One update of the columns [begin, end) of a block.
    void update_columns(const Block& target, Index begin, Index end,
                        const FactorPlan::Update& update, const Index* position,
                        Scratch& scratch) const {
        const Block source = block(update.from);
        const Index *const row = source.row, *from = row + update.begin, *to = row + update.end;
        if (begin > 0) from = std::lower_bound(from, to, target.row[begin]);
        if (end < target.columns) to = std::lower_bound(from, to, target.row[end]);
        if (from == to) return;
        const auto first = index_of(from - row), columns = index_of(to - from);
        const Index rows = source.height - first;
        for (Index i = 0; i < rows; ++i) scratch.local[i] = position[from[i]];
        if (update.from >= nodes_.count()) {
            add(target, source.entry(first, first), source.height, columns, rows, scratch);
            return;
        }
        DenseProduct product;
        product.a = product.b = source.entry(first, 0);
        product.stride = source.height;
        product.rows = rows;
        product.columns = columns;
        product.depth = source.columns;
        product.above = first;
        product.packed = scratch.packed.get();
        product.accumulate = scratch.local[rows - 1] - scratch.local[0] == rows - 1;
        if (product.accumulate) {
            product.c = target.entry(scratch.local[0], scratch.local[0]);
            product.c_stride = target.height;
            kernels_.multiply(product);
            return;
        }
        product.c = scratch.product.get();
        product.c_stride = rows;
        kernels_.multiply(product);
        add(target, product.c, rows, columns, rows, scratch);
    }

    // Adds the part on and below the diagonal at the rows and columns that `scratch` tells.
    static void add(const Block& target, const double* values, Index stride, Index columns,
                    Index rows, const Scratch& scratch) {
        const Index* local = scratch.local.get();
        for (Index j = 0; j < columns; ++j, values += stride) {
            double* column = target.entry(0, local[j]);
            for (Index i = j; i < rows; ++i) column[local[i]] += values[i];
        }
    }

    // Factors a block in place, panel by panel.
    Index eliminate(const Block& node, BlockExecutor& crew) const {
        const double size = static_cast<double>(node.height) * node.columns * node.columns;
        const bool share = size >= kMinShared;
        for (Index first = 0; first < node.columns; first += kPanelColumns) {
            const Index columns = std::min(kPanelColumns, node.columns - first);
            if (first > 0) subtract_earlier(node, first, columns, share, crew);
            DensePanel panel{node.value, node.height, first, columns, nullptr};
            Index failed = kNoIndex;
            crew.run(1, false, [&](Index, Scratch& scratch) {
                panel.packed = scratch.packed.get();
                failed = kernels_.eliminate(panel);
            });
            if (failed != kNoIndex) return failed;
            solve_below(node, panel, share, crew);
        }
        for (Index j = 1; j < node.columns; ++j) std::fill_n(node.entry(0, j), j, 0.0);
        return kNoIndex;
    }

    // Subtracts from a panel the products of the columns before it in the same block.
    void subtract_earlier(const Block& node, Index first, Index columns, bool share,
                          BlockExecutor& crew) const {
        const Index rows = node.height - first;
        crew.run(chunks_of(rows, kRowGrain), share, [&](Index chunk, Scratch& scratch) {
            const Index begin = first + chunk * kRowGrain;
            kernels_.multiply({node.entry(begin, 0), node.entry(first, 0), node.entry(begin, first),
                               node.height, node.height, std::min(kRowGrain, node.height - begin),
                               columns, first, begin, true, scratch.packed.get()});
        });
    }

    void solve_below(const Block& node, const DensePanel& panel, bool share,
                     BlockExecutor& crew) const {
        const Index first = panel.first + panel.columns, rows = node.height - first;
        crew.run(chunks_of(rows, kRowGrain), share, [&](Index chunk, Scratch& scratch) {
            DensePanel own = panel;
            own.packed = scratch.packed.get();
            const Index begin = first + chunk * kRowGrain;
            kernels_.solve_rows(own, begin, std::min(begin + kRowGrain, node.height));
        });
    }

    const FactorTask& task_;
    const Supernodes& nodes_;
    const FactorPlan& plan_;
    double* value_;
    DenseKernels kernels_;
    std::vector<std::size_t> first_extension_;
    std::unique_ptr<double[]> own_extensions_;
    double* extensions_;
};

}  // namespace

std::size_t factoring_bytes(const Supernodes& nodes, const FactorPlan& plan) {
    const std::size_t size = nodes.permutation.size(), bins = plan.bins.size();
    const std::size_t chunk = (at(plan.tallest) * kUpdateColumns + kPackedSize) * sizeof(double);
    return plan.extension_bytes() + (bins + 1) * size * sizeof(Index) +
           (bins + max_chunks(plan)) * chunk;
}

Index factor_supernodes(const FactorTask& task, Processor processor, const Context& context) {
    return Factorization(task, processor).run(context);
}

}  // namespace lissom
