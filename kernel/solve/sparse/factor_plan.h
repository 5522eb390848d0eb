/// FactorPlan: the order of work of a supernodal factorisation; private to kernel/solve.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {

/// Schedule of a factorisation, beside the supernodes. It depends on the pattern alone, never on
/// the number of threads, so neither do results.
///
/// Columns are computed from the left: a block starts as entries of the matrix, has the products of
/// earlier blocks subtracted, and is then factored in place. Subtrees of the elimination tree are
/// independent of each other. The contribution of each to the supernodes above it is summed in a
/// block of its own, its extension; those are blocks count() + i of the plan.
struct FactorPlan {
    /// Rows [begin, end) of block `from`, counted within it, are columns of the block updated.
    struct Update {
        Index from = 0, begin = 0, end = 0;
    };
    /// Value `source` of the matrix starts entry `target` of the factor.
    struct Entry {
        Index source = 0, target = 0;
    };
    /// Supernodes [first, last), and the rows above them, which are those of their extension.
    struct Subtree {
        Index first = 0, last = 0;
        std::vector<Index> above;
        double work = 0.0;
    };

    /// Updates of block b, in their order: [first_update[b], first_update[b + 1]).
    std::vector<Index> first_update;
    std::vector<Update> updates;
    /// Entries of supernode s: [first_entry[s], first_entry[s + 1]).
    std::vector<Index> first_entry;
    std::vector<Entry> entries;
    std::vector<Subtree> subtrees;
    /// Subtrees of each unit of parallel work, and the supernodes above all subtrees, ascending.
    std::vector<std::vector<Index>> bins;
    std::vector<Index> top;
    /// Greatest number of rows of a block, and of columns of one above the subtrees.
    Index tallest = 0, widest = 0;

    /// Bytes of the plan itself, and of the extensions.
    std::size_t bytes() const;
    std::size_t extension_bytes() const;
};

/// Bytes that plan_factor takes at most, its result included.
std::size_t planning_bytes(const Supernodes& nodes, const SymmetricMatrix& pattern);

FactorPlan plan_factor(const Supernodes& nodes, const SymmetricMatrix& pattern);

}  // namespace lissom
