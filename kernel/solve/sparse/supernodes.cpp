#include "kernel/solve/sparse/supernodes.h"

namespace lissom {

std::vector<Index> Supernodes::nodes_of_columns() const {
    std::vector<Index> node_of(permutation.size());
    for (Index s = 0; s < count(); ++s) {
        for (Index c = super[s]; c < super[s + 1]; ++c) node_of[c] = s;
    }
    return node_of;
}

std::vector<Index> Supernodes::parents() const {
    const std::vector<Index> node_of = nodes_of_columns();
    std::vector<Index> parent(count(), count());
    for (Index s = 0; s < count(); ++s) {
        if (height(s) > columns(s)) parent[s] = node_of[row[first_row[s] + columns(s)]];
    }
    return parent;
}

}  // namespace lissom
